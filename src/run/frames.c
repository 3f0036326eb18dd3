// frames.c: the loop over a script's frames.
#include "run/frames.h"

#include "base/clock.h"
#include "cli/parameters.h"
#include "cli/script.h"
#include "cli/signal_cleanup.h"
#include "petri-ranks.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// Signals within this many seconds count as one signal, because timeout(1) sends its signal twice.
static const double SAME_SIGNAL = 0.2;

// Globals, because the signal handler needs them.
static volatile sig_atomic_t interrupted; // number of the first signal; 0: none
static PetriSession *volatile working;    // session to interrupt; NULL: none is computing a frame
static void (*leave_ranks)(void);         // stops waiting for the other ranks; NULL: a single process

static pthread_t main_thread;

// Sends output to /dev/null from now on if it goes to a terminal that is stopped (Ctrl-S): a write would block until
// the terminal resumes. Safe in a signal handler.
static void leave_stopped_terminal(int fd) {
    enum { PATIENCE = 200 }; // milliseconds in which a busy terminal accepts something
    struct pollfd place = {.fd = fd, .events = POLLOUT};
    if (!isatty(fd) || poll(&place, 1, PATIENCE) != 0)
        return;
    int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
        dup2(nowhere, fd);
        close(nowhere);
    }
}

static void on_signal(int number) {
    static const char note[] = "\r\033[Kpetri: stopping; Ctrl-C again stops at once\n";
    static double first;
    if (!pthread_equal(pthread_self(), main_thread)) {
        pthread_kill(main_thread, number); // the handler must run in the main thread only
        return;
    }
    if (interrupted) {
        if (clock_seconds() - first > SAME_SIGNAL) {
            signal_cleanup_run();
            signal(number, SIG_DFL);
            raise(number);
        }
        return;
    }
    int error = errno;
    first = clock_seconds();
    interrupted = number;
    if (working)
        petri_interrupt(working);
    if (leave_ranks)
        leave_ranks();
    leave_stopped_terminal(STDOUT_FILENO);
    leave_stopped_terminal(STDERR_FILENO);
    if (number == SIGINT && isatty(STDERR_FILENO)) {
        ssize_t ignored = write(STDERR_FILENO, note, sizeof note - 1);
        (void)ignored;
    }
    errno = error;
}

// Catches SIGINT, SIGTERM and, unless it is ignored as under nohup, SIGHUP. The first signal aborts the current frame
// and ends the run. The state after the previous frame is then saved, and frames drawn so far are kept. A second signal
// ends the process at once.
static void catch_signals(void) {
    main_thread = pthread_self();
    signal_catch(SIGINT, on_signal, 0);
    signal_catch(SIGTERM, on_signal, 0);
    signal_catch(SIGHUP, on_signal, 0);
}

static bool should_print_diagnostic(Frames *frames, PetriLevel level) {
    // A note belongs to the diagnostic before it, and is shown only if that diagnostic was shown.
    if (level != PETRI_NOTE)
        frames->shown_last = level == PETRI_ERROR || frames->options->verbosity > LOG_QUIET;
    return frames->shown_last;
}

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Frames *frames = host;
    if (diagnostic->level == PETRI_ERROR)
        frames->memory_exceeded = diagnostic->code && strcmp(diagnostic->code, "memory-limit") == 0;
    if (diagnostic->level == PETRI_ERROR && (frames->done == 0 || frames->options->keep_modules))
        frames->broken = frames->broken || (diagnostic->code && strcmp(diagnostic->code, "syntax") == 0);
    frames->invalid_definition = frames->invalid_definition || is_invalid_definition(diagnostic);
    if (should_print_diagnostic(frames, diagnostic->level)) {
        progress_erase(&frames->progress);
        fputs(diagnostic->rendered, stderr);
    }
}

int frames_open(Frames *frames, const CommandContext *host, Options *options) {
    frames->options = options;
    frames->ranks = host->ranks;
    leave_ranks = host->leave_ranks;
    // The result of a run in lockstep must not depend on when a file is saved. A replay repeats changes of files.
    options->keep_modules = !options->realtime && !options->replayed;
    return options_open(options, host, on_diagnostic, frames, &frames->session);
}

bool frames_load(Frames *frames) {
    return options_load(frames->options, frames->session) == PETRI_OK;
}

double frames_fps(const Frames *frames) {
    PetriFrame frame;
    return petri_frame(frames->session, &frame, sizeof frame) && frame.fps > 0 ? frame.fps : frames->options->fps;
}

static void save_state(Frames *frames, bool at_once) {
    const char *news = state_file_save(&frames->state, frames->session, at_once);
    if (news) {
        progress_erase(&frames->progress);
        message("%s", news);
    }
}

static int64_t expected_frames(const Frames *frames) {
    double by_time = frames->options->run_time * frames_fps(frames);
    if (!isnan(by_time) && by_time < (double)frames->options->frames)
        return (int64_t)ceil(by_time);
    return frames->options->frames;
}

// Waits until all ranks have called this function.
static void rank_barrier(const PetriRanks *ranks) {
    for (int rank = 1; ranks && rank < ranks->rank_count; rank++) {
        double nothing = 0;
        ranks->broadcast(ranks->user_data, rank, &nothing, 1, 1, 1);
    }
}

// Restores the state on all ranks. Only rank 0 saves the state, and only after all other ranks have read the file.
static void restore_state(Frames *frames) {
    bool first = !frames->ranks || frames->ranks->rank == 0;
    if (first)
        rank_barrier(frames->ranks);
    bool restored = state_file_restore(&frames->state, frames->session, frames->options->state_file);
    if (!first) {
        rank_barrier(frames->ranks);
        frames->state.name = NULL;
    } else if (restored) {
        save_state(frames, true); // at once, to find out early if the file cannot be written
    }
}

void frames_begin(Frames *frames) {
    restore_state(frames);
    catch_signals();
    bool shows_progress = frames->options->verbosity > LOG_QUIET && progress_possible();
    progress_start(&frames->progress, shows_progress, expected_frames(frames));
    frames->start = clock_seconds();
}

bool frames_due(const Frames *frames) {
    return !interrupted &&
           options_due(frames->options, frames->done - frames->before_first_picture, frames->start, frames_fps(frames));
}

void frames_set_interruptible(Frames *frames, bool begins) {
    working = begins ? frames->session : NULL;
    if (!begins)
        petri_clear_interrupt(frames->session); // an interrupt that arrived after the frame must not stop the next one
}

// Reports that a frame exceeded a limit. How much it needs is not known.
static void report_limit(const Frames *frames, int64_t number) {
    uint64_t limit =
        frames->memory_exceeded ? options_memory_limit(frames->options) : options_work_limit(frames->options);
    uint64_t more = (limit >> 20) * 4;
    more = more > 0 ? more : 4;
    bool in_g = more > 1024;
    message("stopped in frame %" PRId64 "; to allow four times as much, use %s %" PRIu64 "%s", number,
            frames->memory_exceeded ? "--memory" : "--work", in_g ? (more + 1023) / 1024 : more, in_g ? "G" : "M");
}

bool frames_step(Frames *frames) {
    progress_update(&frames->progress, frames->done - frames->before_first_picture);
    int64_t number = petri_frame_number(frames->session) + 1; // read before the step, because the step can fail
    frames_set_interruptible(frames, true);
    PetriStatus status = interrupted ? PETRI_INTERRUPTED : petri_step(frames->session);
    frames_set_interruptible(frames, false);
    frames->abandoned = status == PETRI_INTERRUPTED;
    if (frames->abandoned)
        return false;
    if (status != PETRI_OK) {
        progress_erase(&frames->progress);
        if (status == PETRI_LIMIT_EXCEEDED)
            report_limit(frames, number);
        else
            message("stopped in frame %" PRId64 "%s", number, status == PETRI_OUT_OF_MEMORY ? ": out of memory" : "");
        return false;
    }
    frames->done++;
    return true;
}

void frames_save_state(Frames *frames) {
    int64_t every = frames->options->save_every, number = petri_frame_number(frames->session);
    save_state(frames, every > 0 && (number + 1) % every == 0);
}

void frames_end(Frames *frames, bool going) {
    progress_erase(&frames->progress);
    if (going)
        save_state(frames, true);
    if (interrupted && frames->ranks) {
        message("stopped by signal %d: a rank has died or the run was cancelled; %s%s", (int)interrupted,
                !frames->state.name ? "no state is saved without --state" : "the last complete frame is in ",
                !frames->state.name ? "" : frames->state.name);
    }
}

int frames_signal(void) {
    return (int)interrupted;
}
