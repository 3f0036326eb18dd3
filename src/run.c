// run.c: `petri run`: runs frames without drawing them and prints what was asked for.
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "args.h"
#include "output.h"
#include "petri.h"
#include "progress.h"
#include "run_options.h"
#include "stats.h"
#include "trajectory.h"

enum { SECONDS_BETWEEN_SAVES = 5 };

// A signal handler can reach nothing but a global.
static volatile sig_atomic_t interrupted;

static void on_interrupt(int signal_number) {
    static const char note[] = "\r\033[Kpetri: stopping after this frame; Ctrl-C again stops at once\n";
    interrupted = signal_number;
    if (signal_number == SIGINT && isatty(STDERR_FILENO)) {
        ssize_t ignored = write(STDERR_FILENO, note, sizeof note - 1);
        (void)ignored;
    }
}

// The first Ctrl-C (or SIGTERM) ends the run after the frame at hand, with its state saved; a second one ends the
// process, should that frame not end.
static void catch_interrupt(void) {
    struct sigaction action = {.sa_handler = on_interrupt, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

typedef struct Run {
    RunOptions options;
    PetriSession *session;
    Progress progress;
    double start;
    bool to_terminal; // standard output is a terminal
    bool shown_last;  // the last diagnostic that was no note was shown
    bool state_lost;  // the state file could not be read or written
    double saved;     // when the state was saved last
    Stats stats;
    Trajectory trajectory;
    Output output;
} Run;

static bool wants_diagnostic(Run *run, PetriLevel level) {
    // Notes belong to the diagnostic before them.
    if (level != PETRI_NOTE) {
        run->shown_last = level == PETRI_ERROR || run->options.verbosity > LOG_QUIET;
    }
    return run->shown_last;
}

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Run *run = host;
    if (wants_diagnostic(run, diagnostic->level)) {
        progress_erase(&run->progress);
        fputs(diagnostic->rendered, stderr);
    }
}

static double current_fps(const Run *run) {
    double fps = petri_frame(run->session).fps;
    return fps > 0 ? fps : run->options.fps;
}

static bool frame_is_due(const Run *run) {
    if (interrupted || run->output.error != 0 || run->trajectory.failed || run->stats.frames >= run->options.frames) {
        return false;
    }
    if (isnan(run->options.run_time)) {
        return true;
    }
    double time = run->options.realtime ? clock_seconds() - run->start : (double)run->stats.frames / current_fps(run);
    return time < run->options.run_time;
}

static void report_frame(Run *run, const PetriFrame *frame, bool printed) {
    if (run->options.verbosity < (printed ? LOG_DEBUG : LOG_TRACE)) {
        return;
    }
    progress_erase(&run->progress);
    message("frame %" PRId64 ": script %.3f ms, physics %.3f ms, %" PRIu64 " steps", frame->number,
            frame->evaluation_seconds * 1e3, frame->physics_seconds * 1e3, frame->physics_steps);
}

// On a terminal the bar must make way before text comes, and come back below it.
static bool write_text(void *host, const char *text, size_t length) {
    Run *run = host;
    if (run->to_terminal) {
        progress_erase(&run->progress);
    }
    return output_write(&run->output, text, length);
}

// What is printed and recorded of a frame.
static void output_frame(Run *run) {
    double start = clock_seconds();
    if (run->options.sections != 0) {
        petri_print(run->session, run->options.sections, write_text, run);
    } else {
        petri_print_log(run->session, write_text, run);
    }
    if (run->to_terminal || run->options.realtime) {
        output_flush(&run->output);
    }
    if (run->trajectory.beside != NULL) {
        trajectory_add(&run->trajectory, run->session);
    }
    run->stats.output_seconds += clock_seconds() - start;
}

// A file that could not be read is left alone: it may be all that is left of something.
static void save_state(Run *run) {
    if (run->options.state_file != NULL && !run->state_lost) {
        run->state_lost = petri_save(run->session, run->options.state_file) != PETRI_OK;
        run->saved = clock_seconds();
    }
}

// One frame; false if there is no going on: a limit that one frame has reached, the next will reach as well.
static bool run_frame(Run *run) {
    PetriStatus status = petri_step(run->session);
    PetriFrame frame = petri_frame(run->session);
    if (status != PETRI_OK) {
        progress_erase(&run->progress);
        message("stopped in frame %" PRId64 "%s", frame.number, status == PETRI_MEMORY ? ": out of memory" : "");
        return false;
    }
    if (clock_seconds() - run->saved > SECONDS_BETWEEN_SAVES) {
        save_state(run);
    }
    stats_count(&run->stats, run->session);
    bool printed = frame.number % run->options.every == 0;
    if (printed) {
        output_frame(run);
    }
    report_frame(run, &frame, printed);
    return true;
}

static void report_summary(Run *run) {
    Verbosity verbosity = run->options.verbosity;
    bool wanted = verbosity >= LOG_VERBOSE || (verbosity == LOG_NORMAL && isatty(STDERR_FILENO));
    if (!wanted || run->output.error != 0) {
        return;
    }
    double seconds = clock_seconds() - run->start;
    message("%" PRId64 " frame%s in %.3f s (%.1f frames/s), %" PRIu64 " physics step%s", run->stats.frames,
            run->stats.frames == 1 ? "" : "s", seconds, seconds > 0 ? (double)run->stats.frames / seconds : 0,
            run->stats.physics_steps, run->stats.physics_steps == 1 ? "" : "s");
}

static int64_t expected_frames(const Run *run) {
    double by_time = run->options.run_time * current_fps(run);
    if (!isnan(by_time) && by_time < (double)run->options.frames) {
        return (int64_t)ceil(by_time);
    }
    return run->options.frames;
}

static int run_frames(Run *run) {
    catch_interrupt();
    bool shows_progress = run->options.verbosity > LOG_QUIET && progress_possible();
    progress_start(&run->progress, shows_progress, expected_frames(run));
    run->start = run->saved = clock_seconds();
    bool going = true;
    while (going && frame_is_due(run)) {
        progress_update(&run->progress, run->stats.frames);
        going = run_frame(run);
    }
    progress_erase(&run->progress);
    output_flush(&run->output);
    if (going) {
        save_state(run);
    }
    bool recorded = trajectory_close(&run->trajectory);
    report_summary(run);
    if (run->options.stats) {
        stats_print(&run->stats, run->session, clock_seconds() - run->start);
    }
    int status = !going || !recorded || run->state_lost ? STATUS_FAILED : STATUS_DONE;
    return interrupted ? STATUS_SIGNAL + interrupted : status;
}

static int run_session(Run *run) {
    PetriStatus status = petri_load(run->session, run->options.script);
    if (status == PETRI_MEMORY) {
        message("out of memory");
    }
    if (status != PETRI_OK) {
        return STATUS_FAILED;
    }
    if (run->options.dump >= 0) {
        status = petri_dump(run->session, (PetriDump)run->options.dump, output_write, &run->output);
        return status == PETRI_OK || run->output.error != 0 ? STATUS_DONE : STATUS_FAILED;
    }
    if (run->options.state_file != NULL) {
        run->state_lost = petri_restore(run->session, run->options.state_file) != PETRI_OK;
        if (run->state_lost) {
            message("the run starts afresh; '%s' is left alone and nothing is saved", run->options.state_file);
        }
        save_state(run); // now, so that a file that cannot be written is known before the work is done
    }
    if (run->options.trajectory != NULL && !trajectory_open(&run->trajectory, run->options.trajectory)) {
        return STATUS_FAILED;
    }
    return run_frames(run);
}

static int run_run(const Host *host, int argc, char **argv) {
    Run *run = calloc(1, sizeof *run);
    if (run == NULL) {
        message("out of memory");
        return STATUS_FAILED;
    }
    output_start(&run->output, STDOUT_FILENO);
    run->to_terminal = isatty(STDOUT_FILENO);
    int status = run_options_read(&run->options, &RUN_COMMAND, argc, argv);
    if (status == RUN_OPTIONS_OK) {
        status = run_options_open(&run->options, host, on_diagnostic, run, &run->session);
    }
    if (status == RUN_OPTIONS_OK) {
        status = run_session(run);
        petri_close(&run->session);
        status = output_finish(&run->output, status);
    }
    run_options_free(&run->options);
    free(run);
    return status;
}

const Command RUN_COMMAND = {
    .name = "run",
    .operands = "SCRIPT.fl",
    .summary = "run a script's frames and print what they hold",
    .details =
        "Runs frames without drawing them. What is asked for goes to standard output, all else to standard error.\n"
        "Ctrl-C ends the run after the frame at hand, a second Ctrl-C at once.",
    .options = RUN_OPTION_SPECS,
    .run = run_run,
};
