// run.c: `petri run`: runs frames without drawing them and prints what was asked for.
#include "cli/byte_buffer.h"
#include "cli/helper_exec.h"
#include "cli/output.h"
#include "cli/parameters.h"
#include "cli/script.h"
#include "run/frames.h"
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
    bool to_terminal;    // standard output is a terminal
    size_t after_signal; // bytes that were printed since
    bool truncated;      // what was printed of a frame is not all
    Stats stats;
    Trajectory trajectory;
    Output output;
} Run;

static void report_frame(Run *run, const PetriFrame *frame, bool printed) {
    if (run->frames.options->verbosity < (printed ? LOG_DEBUG : LOG_TRACE))
        return;
    progress_erase(&run->frames.progress);
    message("frame %" PRId64 ": script %.3f ms, physics %.3f ms, %" PRIu64 " steps", frame->number,
            frame->evaluation_seconds * 1e3, frame->physics_seconds * 1e3, frame->physics_steps);
}

// On a terminal the bar must make way before text comes, and come back below it.
static bool write_text(void *host, const char *text, size_t length) {
    enum { MAX_AFTER_SIGNAL = 1 << 22 }; // bytes: a frame's text is whole, unless that takes long
    Run *run = host;
    run->after_signal += frames_signal() != 0 ? length : 0;
    if (run->after_signal > MAX_AFTER_SIGNAL)
        return false;
    if (run->to_terminal)
        progress_erase(&run->frames.progress);
    return output_write(&run->output, text, length);
}

// A text that was cut is no result.
static void note_status(Run *run, PetriStatus status) {
    run->truncated = run->truncated || (status != PETRI_OK && run->output.error == 0 && frames_signal() == 0);
}

// Of logs and errors only: a frame that has none is left out (spec cli.md 3.3).
static void print_if_any(Run *run, unsigned sections) {
    SCOPED_BYTE_BUFFER text = {0};
    note_status(run, petri_print(run->frames.session, sections, byte_buffer_collect, &text));
    const char *end = memchr(text.data, '\n', text.length); // of the line that every frame has
    if (end + 1 < text.data + text.length)
        write_text(run, text.data, text.length);
}

// What is printed and recorded of a frame.
static void output_frame(Run *run) {
    double start = clock_seconds();
    unsigned sections = run->frames.options->sections;
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
    PetriFrame frame = petri_frame(run->frames.session);
    stats_count(&run->stats, run->frames.session);
    bool printed = frame.number % run->frames.options->every == 0;
    if (printed)
        output_frame(run);
    report_frame(run, &frame, printed);
    if (!run->truncated)
        frames_save_state(&run->frames);
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

// What there is to see is told to a person who watches, and to nobody else.
static void report_pictures(const Run *run) {
    const Options *options = run->frames.options;
    if (options->verbosity != LOG_NORMAL || !isatty(STDERR_FILENO) || !petri_has_picture(run->frames.session) ||
        script_is_stdin(options->script))
        return;
    hint_pictures(run->host, options->script);
}

static void report_summary(Run *run) {
    Verbosity verbosity = run->frames.options->verbosity;
    bool wanted = verbosity >= LOG_VERBOSE || (verbosity == LOG_NORMAL && isatty(STDERR_FILENO));
    if (!wanted || run->output.error != 0)
        return;
    double seconds = clock_seconds() - run->frames.start;
    message("%" PRId64 " frame%s in %.3f s (%.1f frames/s), %" PRIu64 " physics step%s", run->stats.frames,
            run->stats.frames == 1 ? "" : "s", seconds, seconds > 0 ? (double)run->stats.frames / seconds : 0,
            run->stats.physics_steps, run->stats.physics_steps == 1 ? "" : "s");
}

// Once the state is there that the run goes on from. What belongs to a state that cannot be read is left alone as that
// is.
static bool open_trajectory(Run *run) {
    Frames *frames = &run->frames;
    const Options *options = frames->options;
    int64_t after = petri_frame(frames->session).number;
    Resume resume = {options->state_file, after, after < 0 ? -1 : after - after % options->every};
    if (!options->trajectory)
        return true;
    if (frames->state.unreadable && access(options->trajectory, F_OK) == 0) {
        message("'%s' is left alone, too", options->trajectory);
        return true;
    }
    frames->state.before = trajectory_sync;
    frames->state.context = &run->trajectory;
    return trajectory_open(&run->trajectory, options->trajectory, &resume);
}

static int run_frames(Run *run) {
    Frames *frames = &run->frames;
    frames_begin(frames);
    bool going = true;
    if (!open_trajectory(run)) {
        progress_erase(&frames->progress);
        return STATUS_FAILED;
    }
    while (going && run->output.error == 0 && !run->trajectory.failed && frames_due(frames))
        going = run_frame(run) || frames->abandoned;
    progress_erase(&frames->progress);
    output_flush(&run->output);
    frames_end(frames, going);
    bool recorded = trajectory_close(&run->trajectory, going);
    report_profile(run);
    report_summary(run);
    if (frames->options->stats)
        stats_print(&run->stats, frames->session, clock_seconds() - frames->start, going ? frames->ranks : NULL);
    if (frames_signal() != 0 && !frames->state.outdated && recorded)
        return STATUS_SIGNAL + frames_signal();
    if (frames_signal() != 0 || !going || !recorded || state_file_failed(&frames->state))
        return STATUS_FAILED;
    report_pictures(run);
    return STATUS_DONE;
}

static int list_parameters(Run *run) {
    uint64_t errors = petri_diagnostic_count(run->frames.session, PETRI_ERROR);
    if (parameters_list(run->frames.session, &run->output) == 0 && run->frames.options->verbosity > LOG_QUIET) {
        message("%s has no parameters; a line such as `let SIZE=SIZE or 20 -- 1..100 how large` makes one",
                script_display_name(run->frames.options->script));
    }
    // A list that memory has cut is no result.
    return petri_diagnostic_count(run->frames.session, PETRI_ERROR) == errors ? STATUS_DONE : STATUS_FAILED;
}

static int run_session(Run *run) {
    const Options *options = run->frames.options;
    if (!frames_load(&run->frames))
        return run->frames.invalid_definition ? STATUS_USAGE : STATUS_FAILED;
    if (options->parameters)
        return list_parameters(run);
    if (options->dump >= 0) {
        PetriStatus status = petri_dump(run->frames.session, (PetriDump)options->dump, output_write, &run->output);
        return status == PETRI_OK || run->output.error != 0 ? STATUS_DONE : STATUS_FAILED;
    }
    return run_frames(run);
}

static bool is_named(const char *word, const char *name) {
    size_t length = strlen(name);
    return strncmp(word, "--", 2) == 0 && strncmp(word + 2, name, length) == 0 && strchr("=", word[2 + length]);
}

// What `petri view` does not know asks for text or files.
static bool is_view_option(const char *word) {
    for (const OptionSpec *spec = OPTIONS; spec->name; spec++)
        if (spec->commands & FOR_VIEW && is_named(word, spec->name))
            return true;
    return strncmp(word, "--", 2) != 0 || is_named(word, "show");
}

// Whether the picture is to be shown: --show was given, a person sits at the terminal, and the command line asks for
// nothing that a picture does not give, such as --print.
static bool should_show(const Options *options) {
#ifdef HAVE_CHAFA
    bool at_terminal = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO) && progress_possible();
#else
    bool at_terminal = false;
#endif
    for (int i = 0; i < options->argc; i++)
        if (!is_view_option(options->argv[i]))
            return false;
    return options->show && at_terminal && !script_is_stdin(options->script) &&
           (options->verbosity == LOG_NORMAL || options->verbosity == LOG_VERBOSE);
}

// Whether the command line says when to stop.
static bool has_end(const Options *options) {
    bool has = false;
    for (int i = 0; i < options->argc; i++)
        has = has || is_named(options->argv[i], "frames") || is_named(options->argv[i], "runtime");
    return has;
}

// What is wrong is told by the run, or the view, to come.
static void ignore_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    (void)context;
    (void)diagnostic;
}

// The first frame tells.
static bool is_drawable(const Options *options, const CommandContext *host) {
    PetriSession *session = NULL;
    if (options_open(options, host, ignore_diagnostic, NULL, &session) != OPTIONS_READ)
        return false;
    bool drawable = petri_load(session, options->script) == PETRI_OK && petri_step(session) == PETRI_OK &&
                    petri_has_picture(session);
    petri_close(&session);
    return drawable;
}

// Becomes `petri view` in the terminal, with the same options, for ten seconds unless they say how long.
// Returns if there is nothing to see, or no way to show it.
static void exec_view(const Options *options, const CommandContext *host) {
    if (!is_drawable(options, host))
        return;
    char **words = memory_calloc(((size_t)options->argc + 6) * sizeof *words);
    char called[] = "view", terminal[] = "--terminal", verbose[] = "--verbose", runtime[] = "--runtime=10";
    SCOPED_TEXT program = memory_strdup(host->invoked_as);
    char *const first[] = {program, called, terminal, verbose, runtime};
    int count = (int)(sizeof first / sizeof first[0]) - (has_end(options) ? 1 : 0);
    memcpy(words, first, (size_t)count * sizeof *first);
    for (int i = 0; i < options->argc; i++)
        if (!is_named(options->argv[i], "show"))
            words[count++] = options->argv[i];
    fflush(NULL);
    helper_exec_pictures(words);
    free(words);
}

// What several processes cannot do together. False after a message.
static bool check_rank_options(const PetriRanks *ranks, Options *options) {
    if (!ranks)
        return true;
    if (options->realtime || script_is_stdin(options->script)) {
        message("under mpirun petri takes %s", options->realtime
                                                   ? "no --realtime: each rank has a clock of its own"
                                                   : "no script on standard input: the ranks do not share it");
        return false;
    }
    if (ranks->rank > 0) { // what rank 0 writes is not to be made by all
        options->trajectory = NULL;
        options->sections = 0;
    }
    return true;
}

static int run_run(const CommandContext *host, Options *options) {
    if (options->save_every > 0 && !options->state_file) {
        message("--save-every needs a file to keep the state in: add --state FILE");
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
    petri_close(&run.frames.session);
    return status;
}

const Command RUN_COMMAND = {
    .name = "run",
    .operands = "SCRIPT.fl",
    .summary = "run a script's frames and print what they hold",
    .details =
        "Runs frames without drawing them. What is asked for goes to standard output, all else to standard error.\n"
        "Ctrl-C gives the frame at hand up and ends the run, a second Ctrl-C at once.\n"
        "\n"
        "A script has parameters where it says, at its top level, `let CELLS=CELLS or 200 -- 1..500 how many`:\n"
        "'petri run --parameters SCRIPT.fl' lists them, '-D CELLS=50' sets one. The range is optional; a value "
        "outside\n"
        "is a warning, and so is a name that the script does not take. Numbers may have suffixes (1k, 20m), vectors\n"
        "are 1;2;3, symbols :name; 0 is as good as none, for it is false. Modules see none of this.",
    .examples = "  petri run dish.fl --stats                       how fast it is, and the energy at the end\n"
                "  petri run dish.fl --print state --every 60      where everything is, once a second\n"
                "  petri run dish.fl -D DROPS=50 --frames 100      another number of drops\n"
                "  petri run dish.fl --trajectory dish.csv         all ways as a table\n",
    .missing_operand = "no script was given",
    .options = FOR_RUN,
    .run = run_run,
};
