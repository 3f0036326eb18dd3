// frames.c: the loop over a script's frames.
#include "run/frames.h"

#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include "cli/parameters.h"
#include "cli/script.h"
#include "cli/unfinished.h"

enum { SECONDS_BETWEEN_SAVES = 5 };
// Seconds: timeout(1) sends its signal twice, which is no second wish.
static const double SAME_SIGNAL = 0.2;

// A signal handler can reach nothing but a global.
static volatile sig_atomic_t interrupted;

static void on_interrupt(int signal_number) {
    static const char note[] = "\r\033[Kpetri: stopping after this frame; Ctrl-C again stops at once\n";
    static double first;
    if (interrupted) {
        if (clock_seconds() - first > SAME_SIGNAL) {
            unfinished_abandon();
            signal(signal_number, SIG_DFL);
            raise(signal_number);
        }
        return;
    }
    first = clock_seconds();
    interrupted = signal_number;
    if (signal_number == SIGINT && isatty(STDERR_FILENO)) {
        ssize_t ignored = write(STDERR_FILENO, note, sizeof note - 1);
        (void)ignored;
    }
}

// The first Ctrl-C (or SIGTERM) ends the run after the frame at hand, with its state saved and what was drawn kept; a
// second one ends the process, should that take too long.
static void catch_interrupt(void) {
    struct sigaction action = {.sa_handler = on_interrupt};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static bool wants_diagnostic(Frames *frames, PetriLevel level) {
    // Notes belong to the diagnostic before them.
    if (level != PETRI_NOTE) {
        frames->shown_last = level == PETRI_ERROR || frames->options->verbosity > LOG_QUIET;
    }
    return frames->shown_last;
}

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Frames *frames = host;
    frames->wrong_definition = frames->wrong_definition || is_wrong_definition(diagnostic);
    if (wants_diagnostic(frames, diagnostic->level)) {
        progress_erase(&frames->progress);
        fputs(diagnostic->rendered, stderr);
    }
}

int frames_open(Frames *frames, const Host *host, Options *options) {
    frames->options = options;
    return options_open(options, host, on_diagnostic, frames, &frames->session);
}

bool frames_load(Frames *frames) {
    PetriStatus status = script_load(frames->session, frames->options->script);
    if (status == PETRI_MEMORY) {
        message("out of memory");
    }
    return status == PETRI_OK;
}

double frames_fps(const Frames *frames) {
    double fps = petri_frame(frames->session).fps;
    return fps > 0 ? fps : frames->options->fps;
}

// A file that could not be read is left alone: it may be all that is left of something.
static void save_state(Frames *frames) {
    if (frames->options->state_file != NULL && !frames->state_lost) {
        int unfinished = unfinished_begin(frames->options->state_file);
        frames->state_lost = petri_save(frames->session, frames->options->state_file) != PETRI_OK;
        unfinished_end(unfinished);
        frames->saved = clock_seconds();
    }
}

static void restore_state(Frames *frames) {
    const char *file = frames->options->state_file;
    frames->state_lost = petri_restore(frames->session, file) != PETRI_OK;
    if (frames->state_lost) {
        message("the run starts afresh; '%s' is left alone and nothing is saved", file);
    }
    save_state(frames); // now, so that a file that cannot be written is known before the work is done
}

static int64_t expected_frames(const Frames *frames) {
    double by_time = frames->options->run_time * frames_fps(frames);
    if (!isnan(by_time) && by_time < (double)frames->options->frames) {
        return (int64_t)ceil(by_time);
    }
    return frames->options->frames;
}

void frames_begin(Frames *frames) {
    if (frames->options->state_file != NULL) {
        restore_state(frames);
    }
    catch_interrupt();
    bool shows_progress = frames->options->verbosity > LOG_QUIET && progress_possible();
    progress_start(&frames->progress, shows_progress, expected_frames(frames));
    frames->start = frames->saved = clock_seconds();
}

bool frames_due(const Frames *frames) {
    int64_t counted = frames->done - frames->early;
    if (interrupted || counted >= frames->options->frames) {
        return false;
    }
    if (isnan(frames->options->run_time)) {
        return true;
    }
    double time = frames->options->realtime ? clock_seconds() - frames->start : (double)counted / frames_fps(frames);
    return time < frames->options->run_time;
}

bool frames_step(Frames *frames) {
    progress_update(&frames->progress, frames->done - frames->early);
    PetriStatus status = petri_step(frames->session);
    if (status != PETRI_OK) {
        progress_erase(&frames->progress);
        message("stopped in frame %" PRId64 "%s", petri_frame(frames->session).number,
                status == PETRI_MEMORY ? ": out of memory" : "");
        return false;
    }
    frames->done++;
    if (clock_seconds() - frames->saved > SECONDS_BETWEEN_SAVES) {
        save_state(frames);
    }
    return true;
}

void frames_end(Frames *frames, bool going) {
    progress_erase(&frames->progress);
    if (going) {
        save_state(frames);
    }
}

int frames_signal(void) {
    return (int)interrupted;
}
