// check.c: the command `petri check`, which reports errors in scripts without running them.
#include "check/meshes.h"
#include "check/report.h"
#include "cli/archive.h"
#include "cli/option_groups.h"
#include "cli/options.h"
#include "cli/script.h"
#include "cli/words.h"
#include "petri.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

// Options that no other command has.
typedef struct Own {
    bool stats;
    int report; // ReportForm
    bool werror;
} Own;

typedef struct Check {
    Options *options;
    bool shown_last; // true if the last error or warning was shown; its notes are then shown as well
    Report report;
} Check;

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    Check *check = host;
    // A note is shown if the error or warning before it was shown, or if there is none before it.
    if (diagnostic->level != PETRI_NOTE)
        check->shown_last = diagnostic->level == PETRI_ERROR || check->options->verbosity != LOG_QUIET;
    if (check->shown_last && check->report.form != REPORT_TEXT)
        report_add(&check->report, diagnostic);
    else if (check->shown_last)
        fputs(diagnostic->rendered, stderr);
}

typedef struct Counts {
    size_t rejected;
    uint64_t errors;
    uint64_t warnings;
} Counts;

// Checks scripts `first` to `end` - 1 with one session, which reads the files of an archive if `options` has one.
static int check_scripts(Check *check, const CommandContext *host, const Options *options, size_t first, size_t end,
                         Counts *counts) {
    const Own *own = options->own;
    PetriSession *session = NULL;
    int status = options_open(options, host, on_diagnostic, check, &session);
    if (status != OPTIONS_READ)
        return status;
    for (size_t i = first; i < end; i++) {
        const char *path = options->scripts.items[i].path;
        check->report.script = path;
        if (options->replayed)
            counts->rejected += replay_check(options, session) != PETRI_OK;
        else if (!petri_archive_is(path)) // check_archives checks archives
            counts->rejected += script_check(session, path) != PETRI_OK;
        if (own->stats && (options->replayed || !petri_archive_is(path)))
            check_print_meshes(host, options, path);
    }
    check->report.script = NULL;
    counts->errors += petri_diagnostic_count(session, PETRI_ERROR);
    counts->warnings += petri_diagnostic_count(session, PETRI_WARNING);
    petri_close(&session);
    return status;
}

// Checks the scripts in archives.
static int check_archives(Check *check, const CommandContext *host, Counts *counts) {
    int status = OPTIONS_READ;
    Options options = *check->options;
    for (size_t i = 0; i < options.scripts.count && status == OPTIONS_READ; i++) {
        const char *path = options.scripts.items[i].path;
        if (!petri_archive_is(path))
            continue;
        options.replayed = replay_archive(&options, path);
        bool opened = !archive_report_problem(options.replayed, path);
        if (opened)
            status = check_scripts(check, host, &options, i, i + 1, counts);
        counts->rejected += !opened || archive_report_problem(options.replayed, path);
        petri_archive_close(&options.replayed);
    }
    return status;
}

// Adds paths that could not be read to the report. Messages on standard error have already named them.
static void report_unreadable(Check *check) {
    const TextList *unreadable = &check->options->unreadable;
    check->report.incomplete = unreadable->count > 0;
    for (size_t i = 0; check->report.form != REPORT_TEXT && i < unreadable->count; i++)
        report_add(&check->report, &(PetriDiagnostic){.level = PETRI_ERROR,
                                                      .file = unreadable->items[i],
                                                      .line = 1,
                                                      .column = 1,
                                                      .text = "cannot read this file or folder",
                                                      .code = "cannot-read",
                                                      .hint = "",
                                                      .end_line = 1,
                                                      .end_column = 1});
}

static int check_all(Check *check, const CommandContext *host) {
    const Options *options = check->options;
    const Own *own = options->own;
    Counts counts = {0};
    int status = check_scripts(check, host, options, 0, options->scripts.count, &counts);
    if (status == OPTIONS_READ)
        status = check_archives(check, host, &counts);
    if (status != OPTIONS_READ)
        return status;
    uint64_t errors = counts.errors, warnings = counts.warnings;
    if (options->scripts.count > 0)
        message("%zu file%s checked: %" PRIu64 " error%s, %" PRIu64 " warning%s", options->scripts.count,
                options->scripts.count == 1 ? "" : "s", errors, errors == 1 ? "" : "s", warnings,
                warnings == 1 ? "" : "s");
    report_unreadable(check);
    bool clean =
        counts.rejected == 0 && errors == 0 && options->unreadable.count == 0 && !(own->werror && warnings > 0);
    int result = clean ? STATUS_DONE : STATUS_FAILED;
    return check->report.form == REPORT_TEXT ? result : report_end(&check->report, result);
}

static int check_run(const CommandContext *host, Options *options) {
    const Own *own = options->own;
    if (options->scripts.count > 0 || options->unreadable.count > 0)
        return check_all(&(Check){.options = options,
                                  .shown_last = options->verbosity != LOG_QUIET,
                                  .report = {.form = (ReportForm)own->report}},
                         host);
    message("no script found: no file is named *.fl");
    return STATUS_FAILED;
}

static bool check_needs_pictures(char *const *words) {
    return words_have_option(words, "stats") || words_name_archive(words);
}

// clang-format off
static const OptionSpec ROWS[] = {
    DEFINE_NAME_OPTION FILE_OPTIONS LIMIT_OPTIONS
    OWN("stats", 0, NULL, option_flag, stats, "print how many triangles the solids, distance fields and models of the first frame have")
    QUIET_OPTION COLOUR_OPTION
    OWN("format", 0, "F", ONE_OF(option_choice, "text", "gcc", "json", "sarif"), report, "output format: text (stderr); gcc, json, sarif (stdout)")
    OWN("werror", 0, NULL, option_flag, werror, "treat warnings as errors")
    NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable CHECK_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command CHECK_COMMAND = {
    .name = "check",
    .operands = "PATH...",
    .summary = "check scripts for errors; evaluates only the first frame",
    .details = "Checks scripts, or all *.fl files below a folder: unbound or unused names, wrong argument counts,\n"
               "unknown pragmas, unreachable branches, misspelled nodes and attributes. Evaluates the first frame\n"
               "without drawing, printing or storing anything. Exits with 1 if there are errors.",
    .examples = "  petri check dish.fl\n"
                "  petri check --werror .                          all scripts in this folder, for CI\n"
                "  petri check --stats solids.fl                   also count the triangles of solids\n"
                "  petri check --format=sarif . >petri.sarif       a report for code hosting sites\n",
    .missing_operand = "nothing to check",
    .options = &CHECK_OPTIONS,
    .needs_pictures = check_needs_pictures,
    .accepts_many = true,
    .run = check_run,
};
