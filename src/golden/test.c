// test.c: the command `petri test`, which runs scripts and compares their output with goldens.
#include "base/clock.h"
#include "base/source.h"
#include "cli/memory.h"
#include "cli/option_groups.h"
#include "cli/options.h"
#include "cli/output.h"
#include "cli/subprocess.h"
#include "golden/golden.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    bool update;
    const char *filter;
    const char *junit;
    int64_t jobs;              // 0: not given
    const char *as_threads;    // overrides --threads of goldens; NULL: no override
    const char *as_neighbours; // overrides --neighbours of goldens; NULL: no override
} Own;

enum { MAX_CPUS = 256 };

// A test of one script.
typedef struct Case {
    Result result;
    char *script;      // path of the script
    char *name;        // file name of the script, without folders
    char *recorded;    // path of the golden or .err file
    bool is_rejection; // true if `recorded` is an .err file
    Golden golden;     // valid while the script runs
    Subprocess child;
    bool done;
} Case;

typedef struct Suite {
    const CommandContext *host;
    Options *options;
    Own *own;
    Case *cases;
    size_t count;
    size_t reported; // number of cases whose result was printed
    Output output;
} Suite;

// For a script NAME.fl, returns the path NAME plus `ending` if that file exists, else NULL. The caller frees the path.
static char *file_beside(const char *script, const char *ending) {
    size_t length = strlen(script);
    if (length > 3 && strcmp(script + length - 3, ".fl") == 0)
        length -= 3;
    Text path = {0};
    text_add_format(&path, "%.*s%s", (int)length, script, ending);
    if (access(path.bytes, F_OK) == 0)
        return path.bytes;
    text_free(&path);
    return NULL;
}

// Adds a golden whose script is missing, as a failed test: the script may have been renamed.
static void add_lost_golden(Suite *suite, const Script *golden) {
    Str name = str_from(golden->path);
    SCOPED_TEXT script = {0};
    text_add_format(&script, "%.*s.fl", (int)(name.len - strlen(".golden")), name.bytes);
    if (access(script.bytes, F_OK) == 0)
        return;
    Case *item = &suite->cases[suite->count++];
    *item = (Case){.script = golden->path, .name = golden->path, .result.name = golden->path, .done = true};
    text_add_format(&item->result.error_text, "no such script: %s; rename the golden like its script, or delete it",
                    script.bytes);
}

static void add_case(Suite *suite, const Script *script) {
    if (suite->own->filter && !strstr(script->path + script->relative_start, suite->own->filter))
        return;
    if (suite->options->scripts.goldens && str_ends_with(str_from(script->path), STR(".golden"))) {
        add_lost_golden(suite, script);
        return;
    }
    char *golden = file_beside(script->path, ".golden");
    char *rejection = !golden ? file_beside(script->path, ".err") : NULL;
    if (!golden && !rejection)
        return;
    suite->cases[suite->count++] = (Case){
        .script = script->path,
        .name = script->path + path_directory(str_from(script->path)).len,
        .result.name = script->path,
        .recorded = !golden ? rejection : golden,
        .is_rejection = !golden,
    };
}

// If `value` is not NULL, adds --NAME=VALUE, which overrides the same option in the golden. `petri run` rejects
// invalid values.
static void add_override(char **argv, int *argc, Text *text, const char *name, const char *value) {
    if (value) {
        text_add_format(text, "--%s=%s", name, value);
        argv[(*argc)++] = text->bytes;
    }
}

static void start_child(Suite *suite, Case *item) {
    SCOPED_STRING folder = memory_folder(item->script);
    const Golden *golden = &item->golden;
    char **argv = memory_calloc((golden->options.count + 11) * sizeof *argv);
    SCOPED_TEXT threads = {0};
    SCOPED_TEXT neighbours = {0};
    int argc = 0;
    argv[argc++] = "petri";
    argv[argc++] = "run";
    // One thread for each script, because the scripts already run in parallel. A golden can set another number of
    // threads. Results never depend on it.
    argv[argc++] = "--threads=1";
    if (item->is_rejection)
        argv[argc++] = "--frames=1";
    for (size_t i = 0; i < golden->options.count; i++)
        argv[argc++] = golden->options.items[i];
    add_override(argv, &argc, &threads, "threads", suite->own->as_threads);
    add_override(argv, &argc, &neighbours, "neighbours", suite->own->as_neighbours);
    if (suite->options->unsimplified)
        argv[argc++] = "--nosimplify";
    if (suite->options->no_batches)
        argv[argc++] = "--no-batches";
    argv[argc++] = "--";
    argv[argc++] = item->name;
    item->result.seconds = clock_seconds();
    if (!subprocess_start(&item->child, suite->host->program, folder, argv)) {
        text_add_format(&item->result.error_text, "cannot start a process: %s", strerror(errno));
        item->done = true;
    }
    free(argv);
}

static void start_case(Suite *suite, Case *item) {
    if (!item->is_rejection && !golden_read(&item->golden, item->recorded, &item->result.error_text)) {
        golden_free(&item->golden);
        item->done = true;
        return;
    }
    start_child(suite, item);
}

// Returns true if a run computed all frames.
static bool is_complete(int status, const Text *errors) {
    static const char last[] = "petri: " BROKEN_MODULE_MESSAGE "\n";
    Str text = text_str(errors);
    return WIFEXITED(status) && (WEXITSTATUS(status) == STATUS_DONE ||
                                 (WEXITSTATUS(status) == STATUS_FAILED && str_ends_with(text, str_from(last))));
}

// Returns true if a run reported that its motion became meaningless, and adds this warning to error_text.
static bool has_diverged(const Text *errors, Text *error_text) {
    const char *code = strstr(errors->bytes, " [divergence]\n"), *line = code;
    while (line && line > errors->bytes && line[-1] != '\n')
        line--;
    if (line)
        text_add_format(error_text, "%.*s", (int)(code - line), line);
    return line;
}

static void check_case(const Suite *suite, Case *item, int status, const Text *output, const Text *errors) {
    Result *result = &item->result;
    if (item->is_rejection)
        result->passed = rejection_check(item->recorded, item->name, status, errors, &result->error_text);
    else if (!is_complete(status, errors))
        subprocess_describe(status, errors, &result->error_text);
    else if (has_diverged(errors, &result->error_text))
        result->passed = false;
    else if (suite->own->update)
        result->passed = golden_update(&item->golden, item->recorded, output, &result->updated, &result->error_text);
    else
        result->passed = golden_compare(&item->golden, output, &result->error_text);
}

static void end_case(const Suite *suite, Case *item, int status) {
    SCOPED_TEXT output = {0};
    SCOPED_TEXT errors = {0};
    item->result.seconds = clock_seconds() - item->result.seconds;
    const char *problem = subprocess_collect(&item->child, &output, &errors);
    if (problem)
        text_add_format(&item->result.error_text, "cannot read the output of the run: %s", problem);
    else
        check_case(suite, item, status, &output, &errors);
    golden_free(&item->golden);
    item->done = true;
}

static Case *find_running(Suite *suite, size_t started, pid_t pid) {
    for (size_t i = suite->reported; i < started; i++)
        if (!suite->cases[i].done && suite->cases[i].child.pid == pid)
            return &suite->cases[i];
    return NULL;
}

// Prints results in the order of the scripts, up to the first script that is not done.
static void report_done(Suite *suite, size_t started) {
    while (suite->reported < started && suite->cases[suite->reported].done)
        report_result(&suite->output, &suite->cases[suite->reported++].result);
    output_flush(&suite->output);
}

// Returns false if no one reads the results: standard output is closed and there is no --junit.
static bool is_wanted(const Suite *suite) {
    return suite->output.error == 0 || suite->own->junit;
}

static void run_cases(Suite *suite) {
    size_t started = 0;
    int64_t running = 0;
    while ((started < suite->count && is_wanted(suite)) || running > 0) {
        if (started < suite->count && running < suite->own->jobs && is_wanted(suite)) {
            Case *item = &suite->cases[started++];
            if (!item->done)
                start_case(suite, item);
            running += item->done ? 0 : 1;
            continue;
        }
        int status = 0;
        pid_t pid = subprocess_wait(&status);
        Case *item = pid < 0 ? NULL : find_running(suite, started, pid);
        if (item) {
            end_case(suite, item, status);
            running--;
        } else if (pid < 0) {
            message("cannot wait for a process: %s", strerror(errno));
            return;
        }
        report_done(suite, started);
    }
    report_done(suite, started);
}

static bool write_junit(const Suite *suite) {
    Result **results = memory_calloc(suite->count * sizeof *results);
    for (size_t i = 0; i < suite->count; i++)
        results[i] = &suite->cases[i].result;
    bool done = report_junit(suite->own->junit, results, suite->count);
    free(results);
    return done;
}

static int run_suite(Suite *suite) {
    if (suite->options->scripts.count == 0 && suite->options->unreadable.count > 0)
        return STATUS_FAILED;
    suite->cases = memory_calloc(suite->options->scripts.count * sizeof *suite->cases);
    for (size_t i = 0; i < suite->options->scripts.count; i++)
        add_case(suite, &suite->options->scripts.items[i]);
    if (suite->count == 0) {
        message("no script found with a .golden or .err file%s",
                !suite->own->filter ? "; see 'petri help test' for how to create one" : " that matches --filter");
        return STATUS_FAILED;
    }
    run_cases(suite);
    size_t passed = 0;
    for (size_t i = 0; i < suite->count; i++)
        passed += suite->cases[i].result.passed ? 1 : 0;
    output_format(&suite->output, "%zu passed, %zu failed\n", passed, suite->count - passed);
    bool reported = !suite->own->junit || write_junit(suite);
    return passed == suite->count && reported && suite->options->unreadable.count == 0 ? STATUS_DONE : STATUS_FAILED;
}

static void free_suite(Suite *suite) {
    for (size_t i = 0; i < suite->count; i++) {
        free(suite->cases[i].recorded);
        text_free(&suite->cases[i].result.error_text);
    }
    free(suite->cases);
}

static int test_run(const CommandContext *context, Options *options) {
    Own *own = options->own;
    Suite suite = {.host = context, .options = options, .own = own, .output.fd = STDOUT_FILENO};
    if (own->jobs == 0) {
        int jobs = subprocess_default_jobs();
        own->jobs = jobs > MAX_CPUS ? MAX_CPUS : jobs;
    }
    int status = output_finish(&suite.output, run_suite(&suite));
    free_suite(&suite);
    return status;
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("update", 0, NULL, option_flag, update, "update goldens to the current output")
    OWN("filter", 0, "TEXT", option_text, filter, "run only scripts whose path relative to PATH contains TEXT")
    OWN("junit", 0, "FILE", option_text, junit, "also write the results to FILE as JUnit XML, for CI")
    OWN("jobs", 0, "N", WHOLE(1, 256), jobs, "run N scripts at a time (default: number of CPUs)")
    OWN("threads", 0, "N", option_text, as_threads, "run all scripts with --threads N")
    OWN("neighbours", 0, "WHEN", option_text, as_neighbours, "run all scripts with --neighbours WHEN")
    NOSIMPLIFY_OPTION NO_BATCHES_OPTION NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable TEST_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command TEST_COMMAND = {
    .name = "test",
    .operands = "PATH...",
    .summary = "run scripts and compare the output with goldens",
    .details =
        "Runs each NAME.fl that has a NAME.golden beside it and compares the output. The first line of a golden\n"
        "contains the options of the run: '# run --frames 61 --every 20 --print state'. If there is a NAME.err with\n"
        "'line N', the script must be rejected with an error in that line. Each script runs in its folder.\n\n"
        "To create a golden, write its first line and let petri write the rest:\n\n"
        "  echo '# run --frames 61 --every 20 --print state' >dish.golden\n"
        "  petri test --update dish.fl\n\n"
        "With --print hash, a golden has one line per frame: the SHA-256 of the state.",
    .examples = "  petri test .                                    test all scripts in this folder\n"
                "  petri test --update dish.fl                     write the current output to its golden\n",
    .missing_operand = "no script or folder given",
    .no_stdin = "cannot test standard input: it has no golden; give files or folders",
    .options = &TEST_OPTIONS,
    .accepts_many = true,
    .accepts_goldens = true,
    .run = test_run,
};
