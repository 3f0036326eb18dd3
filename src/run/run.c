// run.c: `petri run`, which runs frames without drawing them and prints the requested results.
#include "base/clock.h"
#include "cli/archive.h"
#include "cli/helper_exec.h"
#include "cli/memory.h"
#include "cli/motion.h"
#include "cli/output.h"
#include "cli/parameters.h"
#include "cli/script.h"
#include "cli/words.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "petri-ranks.h"
#include "run/frames.h"
#include "run/options.h"
#include "run/stats.h"
#include "run/trajectory.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct Run {
    const CommandContext *host;
    Frames frames;
    bool to_terminal;    // true if standard output is a terminal
    size_t after_signal; // bytes printed since a signal
    bool truncated;      // true if the output of a frame is incomplete
    Stats stats;
    Trajectory trajectory;
    Archiving archiving; // the archive of the run
    Output output;
} Run;

static void report_frame(Run *run, const PetriFrame *frame, bool printed) {
    if (run->frames.options->verbosity < (printed ? LOG_DEBUG : LOG_TRACE))
        return;
    progress_erase(&run->frames.progress);
    message("frame %" PRId64 ": script %.3f ms, physics %.3f ms, %" PRIu64 " steps", frame->number,
            frame->evaluation_seconds * 1e3, frame->physics_seconds * 1e3, frame->physics_steps);
}

// Writes text to the output. On a terminal, erases the progress line first.
static bool write_text(void *host, const char *text, size_t length) {
    enum { MAX_AFTER_SIGNAL = 1 << 22 }; // bytes; after a signal, longer output is truncated
    Run *run = host;
    run->after_signal += frames_signal() != 0 ? length : 0;
    if (run->after_signal > MAX_AFTER_SIGNAL)
        return false;
    if (run->to_terminal)
        progress_erase(&run->frames.progress);
    return output_write(&run->output, text, length);
}

// Sets `truncated` if a frame's output is incomplete for another reason than a signal or a write error.
static void note_status(Run *run, PetriStatus status) {
    run->truncated = run->truncated || (status != PETRI_OK && run->output.error == 0 && frames_signal() == 0);
}

// Prints only logs and errors. Prints nothing for a frame that has neither (spec cli.md 3.3).
static void print_if_any(Run *run, unsigned sections) {
    SCOPED_TEXT text = {0};
    note_status(run, petri_print(run->frames.session, sections, text_collect, &text));
    const char *end = memchr(text.bytes, '\n', text.len); // end of the `@` line
    if (end + 1 < text.bytes + text.len)
        write_text(run, text.bytes, text.len);
}

// Prints the frame and adds it to the trajectory.
static void output_frame(Run *run) {
    double start = clock_seconds();
    unsigned sections = run_options(run->frames.options)->sections;
    if (sections != 0 && (sections & ~(unsigned)(PETRI_PRINT_LOG | PETRI_PRINT_ERROR)) == 0)
        print_if_any(run, sections);
    else if (sections != 0)
        note_status(run, petri_print(run->frames.session, sections, write_text, run));
    else
        note_status(run, petri_print_log(run->frames.session, write_text, run));
    if (run->to_terminal || run->frames.options->realtime)
        output_flush(&run->output);
    if (run->trajectory.open)
        trajectory_add(&run->trajectory, run->frames.session);
    run->stats.output_seconds += clock_seconds() - start;
}

static bool run_frame(Run *run) {
    if (!frames_step(&run->frames))
        return false;
    PetriFrame frame;
    petri_frame(run->frames.session, &frame, sizeof frame);
    stats_count(&run->stats, &frame, run_options(run->frames.options)->stats ? run->frames.session : NULL);
    bool printed = frame.number % run_options(run->frames.options)->every == 0;
    if (printed)
        output_frame(run);
    report_frame(run, &frame, printed);
    if (!run->truncated)
        frames_save_state(&run->frames);
    archiving_check(&run->archiving);
    return !run->truncated;
}

static bool write_message(void *host, const char *text, size_t length) {
    (void)host;
    return fwrite(text, 1, length, stderr) == length;
}

static void report_profile(Run *run) {
    if (run->frames.options->profile && run->stats.frames > 0)
        petri_profile(run->frames.session, run->stats.output_seconds, write_message, NULL);
}

// Returns true if a person is likely to read the messages: on a terminal, or if --show could not show the picture.
static bool is_interactive(const Options *options) {
    return isatty(STDERR_FILENO) || run_options(options)->show;
}

// Suggests commands that show the picture.
static void report_pictures(const Run *run) {
    const Options *options = run->frames.options;
    if (options->verbosity != LOG_NORMAL || !is_interactive(options) || !petri_has_picture(run->frames.session) ||
        script_is_stdin(options->script))
        return;
    hint_pictures(run->host, options->script);
}

// Reports the systems and the digest of the state, if --show could not show the picture and no terminal is there
// either.
static void report_result(const Run *run) {
    enum { MAX_SYSTEMS = 4, DIGEST_BYTES = 16 };
    const Options *options = run->frames.options;
    if (options->verbosity != LOG_NORMAL || !run_options(options)->show || isatty(STDERR_FILENO))
        return;
    PetriSystem system;
    size_t count = 0;
    for (; petri_system(run->frames.session, count, &system, sizeof system); count++) {
        uint32_t moving = motion_count(&system);
        if (count < MAX_SYSTEMS)
            message("system %s: %" PRIu32 " particle%s", system.name, moving, moving == 1 ? "" : "s");
    }
    if (count > MAX_SYSTEMS)
        message("and %zu more systems", count - MAX_SYSTEMS);
    uint8_t digest[DIGEST_BYTES];
    if (petri_digest(run->frames.session, digest) != PETRI_OK)
        return;
    SCOPED_TEXT text = {0};
    text_add_hex(&text, digest, sizeof digest);
    message("digest of the state after frame %" PRId64 ": %s", petri_frame_number(run->frames.session), text.bytes);
}

static void report_summary(Run *run) {
    const Options *options = run->frames.options;
    Verbosity verbosity = options->verbosity;
    bool wanted = verbosity >= LOG_VERBOSE || (verbosity == LOG_NORMAL && is_interactive(options));
    if (!wanted || run->output.error != 0)
        return;
    double seconds = clock_seconds() - run->frames.start;
    message("%" PRId64 " frame%s in %.3f s (%.1f frames/s), %" PRIu64 " physics step%s", run->stats.frames,
            run->stats.frames == 1 ? "" : "s", seconds, seconds > 0 ? (double)run->stats.frames / seconds : 0,
            run->stats.physics_steps, run->stats.physics_steps == 1 ? "" : "s");
}

// Opens the trajectory. Must be called after the state was restored. If the state file is unreadable, an existing
// trajectory is not modified either. Returns false after a message.
static bool open_trajectory(Run *run) {
    Frames *frames = &run->frames;
    const Options *options = frames->options;
    const RunOptions *own = run_options(options);
    int64_t after = petri_frame_number(frames->session);
    Resume resume = {options->state_file, after, after < 0 ? -1 : after - after % own->every};
    if (!own->trajectory)
        return true;
    if (frames->state.unreadable && access(own->trajectory, F_OK) == 0) {
        message("'%s' is not changed either, and no trajectory is written", own->trajectory);
        return true;
    }
    frames->state.before = trajectory_sync;
    frames->state.context = &run->trajectory;
    return trajectory_open(&run->trajectory, own->trajectory, own->energies, &resume);
}

static int run_frames(Run *run) {
    Frames *frames = &run->frames;
    frames_begin(frames);
    bool going = true;
    if (!open_trajectory(run)) {
        progress_erase(&frames->progress);
        return frames_signal() != 0 ? STATUS_SIGNAL + frames_signal() : STATUS_FAILED;
    }
    while (going && run->output.error == 0 && !run->trajectory.failed && frames_due(frames))
        going = run_frame(run) || frames->abandoned;
    progress_erase(&frames->progress);
    output_flush(&run->output);
    frames_end(frames, going);
    bool recorded = trajectory_close(&run->trajectory, going);
    report_profile(run);
    report_summary(run);
    if (run_options(frames->options)->stats)
        stats_print(&run->stats, frames->session, clock_seconds() - frames->start, going ? frames->ranks : NULL);
    if (frames_signal() != 0 && !frames->state.outdated && recorded)
        return STATUS_SIGNAL + frames_signal();
    if (frames_signal() != 0 || !going || !recorded || state_file_failed(&frames->state))
        return STATUS_FAILED;
    report_result(run);
    report_pictures(run);
    if (frames->broken)
        message("%s", BROKEN_MODULE_MESSAGE);
    return frames->broken ? STATUS_FAILED : STATUS_DONE;
}

static int list_parameters(Run *run) {
    uint64_t errors = petri_diagnostic_count(run->frames.session, PETRI_ERROR);
    if (parameters_list(run->frames.session, &run->output) == 0 && run->frames.options->verbosity > LOG_QUIET) {
        message("%s has no parameters; to add one, write `let SIZE=SIZE or 20 -- 1..100 how large`",
                script_display_name(run->frames.options->script));
    }
    // If the memory limit truncated the list, an error was reported, and the command fails.
    return petri_diagnostic_count(run->frames.session, PETRI_ERROR) == errors ? STATUS_DONE : STATUS_FAILED;
}

static int run_session(Run *run) {
    const Options *options = run->frames.options;
    const RunOptions *own = run_options(options);
    if (!archiving_begin(&run->archiving, options, "run", run->frames.session))
        return STATUS_FAILED;
    if (!frames_load(&run->frames))
        return run->frames.invalid_definition ? STATUS_USAGE : STATUS_FAILED;
    if (own->parameters)
        return list_parameters(run);
    if (own->dump >= 0) {
        PetriStatus status = petri_dump(run->frames.session, (PetriDump)own->dump, output_write, &run->output);
        return status == PETRI_OK || run->output.error != 0 ? STATUS_DONE : STATUS_FAILED;
    }
    return run_frames(run);
}

// Returns true for an option that `petri view` accepts, for --show, and for a word that is not an option. All other
// options request text or files.
static bool is_view_option(const char *word) {
    for (const OptionSpec *spec = RUN_OPTIONS.rows; spec->name; spec++)
        if (spec->ends_show && word_is_option(word, spec->name))
            return false;
    return true;
}

// Returns true if the picture must be shown. This is the case if --show was given, input and output are terminals, and
// no option such as --print requests text or files.
static bool should_show(const Options *options) {
#ifdef HAVE_CHAFA
    bool at_terminal = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO) && progress_possible();
#else
    bool at_terminal = false;
#endif
    for (int i = 0; i < options->argc; i++)
        if (!is_view_option(options->argv[i]))
            return false;
    return run_options(options)->show && at_terminal && !script_is_stdin(options->script) &&
           (options->verbosity == LOG_NORMAL || options->verbosity == LOG_VERBOSE);
}

// Ignores diagnostics, because the later run or view reports them.
static void ignore_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    (void)context;
    (void)diagnostic;
}

// Computes the first frame to find out if the script has a picture.
static bool is_drawable(const Options *options, const CommandContext *host) {
    PetriSession *session = NULL;
    if (options_open(options, host, ignore_diagnostic, NULL, &session) != OPTIONS_READ)
        return false;
    bool drawable =
        options_load(options, session) == PETRI_OK && petri_step(session) == PETRI_OK && petri_has_picture(session);
    petri_close(&session);
    return drawable;
}

// Replaces the process with `petri view --terminal` and passes the same options. The view lasts ten seconds unless the
// options set its duration. Returns only if the script has no picture or petri-pictures cannot be started.
static void exec_view(const Options *options, const CommandContext *host) {
    if (!is_drawable(options, host))
        return;
    char **words = memory_calloc(((size_t)options->argc + 6) * sizeof *words);
    bool has_end = words_have_option(options->argv, "frames") || words_have_option(options->argv, "runtime");
    char called[] = "view", terminal[] = "--terminal", verbose[] = "--verbose", runtime[] = "--runtime=10";
    SCOPED_STRING program = memory_strdup(host->invoked_as);
    char *const first[] = {program, called, terminal, verbose, runtime};
    int count = (int)(sizeof first / sizeof first[0]) - (has_end ? 1 : 0);
    memcpy(words, first, (size_t)count * sizeof *first);
    for (int i = 0; i < options->argc; i++)
        if (!word_is_option(options->argv[i], "show"))
            words[count++] = options->argv[i];
    fflush(NULL);
    helper_exec_pictures(words);
    free(words);
}

// Checks the options of a run under MPI. Returns false after a message.
static bool check_rank_options(const PetriRanks *ranks, Options *options) {
    RunOptions *own = run_options(options);
    if (!ranks)
        return true;
    if (options->realtime || script_is_stdin(options->script)) {
        message("cannot use %s under mpirun: %s", options->realtime ? "--realtime" : "a script on standard input",
                options->realtime ? "each rank has its own clock" : "the ranks do not share it");
        return false;
    }
    if (ranks->rank > 0) { // only rank 0 writes output
        own->trajectory = options->archive = NULL;
        own->sections = 0;
        own->show = false;
    }
    return true;
}

static int run_run(const CommandContext *host, Options *options) {
    if (options->save_every > 0 && !options->state_file) {
        message("option '--save-every' needs --state FILE");
        return STATUS_USAGE;
    }
    if (!check_rank_options(host->ranks, options))
        return STATUS_USAGE;
    Run run = {.host = host, .output.fd = STDOUT_FILENO, .to_terminal = isatty(STDOUT_FILENO)};
    int status = frames_open(&run.frames, host, options);
    if (status == OPTIONS_READ && should_show(options))
        exec_view(options, host);
    if (status == OPTIONS_READ)
        status = output_finish(&run.output, run_session(&run));
    if (!archiving_end(&run.archiving) && status == STATUS_DONE)
        status = STATUS_FAILED;
    petri_close(&run.frames.session);
    return status;
}

const Command RUN_COMMAND = {
    .name = "run",
    .operands = "SCRIPT.fl",
    .summary = "run a script without drawing and print results",
    .details =
        "Runs frames without drawing. Prints the requested results to standard output, messages to standard error.\n"
        "Ctrl-C aborts the current frame and ends the run; a second Ctrl-C ends it at once.\n"
        "'petri help run LINK' explains how to run the script of a link.\n"
        "\n"
        "A top-level line such as `let CELLS=CELLS or 200 -- 1..500 how many` declares a parameter. 'petri run\n"
        "--parameters SCRIPT.fl' lists parameters, '-D CELLS=50' sets one. The range is optional; a value outside it\n"
        "and an unknown name cause warnings. Numbers may have suffixes (1k, 20m), vectors are 1;2;3, symbols are\n"
        ":name. 0 is false, so `or` would use the default: `let CELLS=CELLS if CELLS != null else 200` accepts 0. -D\n"
        "does not affect modules.",
    .examples = "  petri run dish.fl --stats                       print speed and final energy\n"
                "  petri run dish.fl --print state --every 60      print the state once a second\n"
                "  petri run dish.fl -D DROPS=50 --frames 100      set a parameter\n"
                "  petri run dish.fl --trajectory dish.csv         write all positions as a table\n",
    .missing_operand = "no script given",
    .options = &RUN_OPTIONS,
    .needs_pictures = words_name_archive,
    .run = run_run,
};
