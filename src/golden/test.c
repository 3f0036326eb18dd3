// test.c: `petri test`: runs scripts and compares what they print with what was recorded.
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/args.h"
#include "cli/child.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/script.h"
#include "cli/scripts.h"
#include "golden/golden.h"
#include "golden/rejection.h"
#include "golden/report.h"

enum { OPT_UPDATE = 1, OPT_FILTER, OPT_JUNIT, OPT_JOBS, OPT_THREADS, OPT_NEIGHBOURS, OPT_NOSIMPLIFY };

enum { MOST_JOBS = 256 };

static const OptionSpec OPTIONS[] = {
    {"update", 0, OPT_UPDATE, NULL, "record what the scripts print now in their goldens"},
    {"filter", 0, OPT_FILTER, "TEXT", "only scripts with TEXT in their path below PATH"},
    {"junit", 0, OPT_JUNIT, "FILE", "also write the results to FILE, in the form that CI systems read"},
    {"jobs", 0, OPT_JOBS, "N", "run N scripts at a time (as many as CPUs)"},
    {"threads", 0, OPT_THREADS, "N", "as with run, for all scripts"},
    {"neighbours", 0, OPT_NEIGHBOURS, "WHEN", "as with run, for all scripts"},
    {"nosimplify", 0, OPT_NOSIMPLIFY, NULL, "evaluate everything in every frame; results never depend on it"},
    {0},
};

// A script, what it is compared with while it runs, and the verdict.
typedef struct Case {
    Result result;
    char *script;   // path
    char *recorded; // path of the golden, or of the .err
    bool is_rejection;
    Golden golden;
    Child child;
    bool done;
} Case;

typedef struct Suite {
    const Host *host;
    ScriptList scripts;
    Case *cases;
    size_t count;
    const char *filter;
    const char *junit;
    int64_t jobs;
    bool update;
    const char *threads;    // NULL: what the goldens ask for
    const char *neighbours; // likewise
    bool nosimplify;
    bool unreadable; // some path could not be read
    size_t reported; // cases whose result was printed
    Output output;
} Suite;

// NAME.fl with another ending, if there is such a file, else NULL.
static char *file_beside(const char *script, const char *ending) {
    size_t length = strlen(script);
    if (length > 3 && strcmp(script + length - 3, ".fl") == 0) {
        length -= 3;
    }
    Bytes path = {0};
    bytes_format(&path, "%.*s%s", (int)length, script, ending);
    if (access(path.data, F_OK) == 0) {
        return path.data;
    }
    bytes_free(&path);
    return NULL;
}

static void add_case(Suite *suite, const Script *script) {
    if (suite->filter != NULL && strstr(script->path + script->below, suite->filter) == NULL) {
        return;
    }
    char *golden = file_beside(script->path, ".golden");
    char *rejection = golden == NULL ? file_beside(script->path, ".err") : NULL;
    if (golden == NULL && rejection == NULL) {
        return;
    }
    suite->cases[suite->count++] = (Case){
        .script = script->path,
        .result.name = script->path,
        .recorded = golden == NULL ? rejection : golden,
        .is_rejection = golden == NULL,
    };
}

// An option that overrides the golden's; what is wrong with its value, `petri run` will say.
static void add_override(char **argv, int *argc, Bytes *text, const char *name, const char *value) {
    if (value != NULL) {
        bytes_format(text, "--%s=%s", name, value);
        argv[(*argc)++] = text->data;
    }
}

static void start_child(Suite *suite, Case *item) {
    const char *slash = strrchr(item->script, '/');
    size_t length = slash == NULL ? 0 : (size_t)(slash - item->script) + 1;
    char *folder = slash == NULL ? memory_copied(".", 1) : memory_copied(item->script, length);
    const Golden *golden = &item->golden;
    char **argv = memory_zeroed(((size_t)golden->option_count + 10) * sizeof *argv);
    Bytes threads = {0};
    Bytes neighbours = {0};
    int argc = 0;
    argv[argc++] = "petri";
    argv[argc++] = "run";
    // Scripts run side by side already. Results never depend on the number of threads, and the golden may ask for more.
    argv[argc++] = "--threads=1";
    if (item->is_rejection) {
        argv[argc++] = "--frames=1";
    }
    for (int i = 0; i < golden->option_count; i++) {
        argv[argc++] = golden->options[i];
    }
    add_override(argv, &argc, &threads, "threads", suite->threads);
    add_override(argv, &argc, &neighbours, "neighbours", suite->neighbours);
    if (suite->nosimplify) {
        argv[argc++] = "--nosimplify";
    }
    argv[argc++] = "--";
    argv[argc++] = item->script + length;
    item->result.seconds = clock_seconds();
    if (!child_start(&item->child, suite->host->program, folder, argv)) {
        bytes_format(&item->result.trouble, "cannot start a process: %s", strerror(errno));
        item->done = true;
    }
    bytes_free(&threads);
    bytes_free(&neighbours);
    free(argv);
    free(folder);
}

static void start_case(Suite *suite, Case *item) {
    if (!item->is_rejection && !golden_read(&item->golden, item->recorded, &item->result.trouble)) {
        golden_free(&item->golden);
        item->done = true;
        return;
    }
    start_child(suite, item);
}

static void judge(const Suite *suite, Case *item, int status, const Bytes *output, const Bytes *errors) {
    Result *result = &item->result;
    const char *slash = strrchr(item->script, '/');
    if (item->is_rejection) {
        const char *name = slash == NULL ? item->script : slash + 1;
        result->passed = rejection_check(item->recorded, name, status, errors, &result->trouble);
    } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        child_describe(status, errors, &result->trouble);
    } else if (suite->update) {
        result->passed = golden_update(&item->golden, item->recorded, output, &result->updated, &result->trouble);
    } else {
        result->passed = golden_compare(&item->golden, output, &result->trouble);
    }
}

static void end_case(const Suite *suite, Case *item, int status) {
    Bytes output = {0};
    Bytes errors = {0};
    item->result.seconds = clock_seconds() - item->result.seconds;
    child_collect(&item->child, &output, &errors);
    judge(suite, item, status, &output, &errors);
    bytes_free(&output);
    bytes_free(&errors);
    golden_free(&item->golden);
    item->done = true;
}

static Case *find_running(Suite *suite, size_t started, pid_t pid) {
    for (size_t i = suite->reported; i < started; i++) {
        if (!suite->cases[i].done && suite->cases[i].child.pid == pid) {
            return &suite->cases[i];
        }
    }
    return NULL;
}

// Results are printed in the order of the scripts, each as soon as those before it are there.
static void report_done(Suite *suite, size_t started) {
    while (suite->reported < started && suite->cases[suite->reported].done) {
        report_result(&suite->output, &suite->cases[suite->reported++].result);
    }
    output_flush(&suite->output);
}

// Nobody waits for results that nobody reads.
static bool is_wanted(const Suite *suite) {
    return suite->output.error == 0 || suite->junit != NULL;
}

static void run_cases(Suite *suite) {
    size_t started = 0;
    int64_t running = 0;
    while ((started < suite->count && is_wanted(suite)) || running > 0) {
        if (started < suite->count && running < suite->jobs && is_wanted(suite)) {
            Case *item = &suite->cases[started++];
            start_case(suite, item);
            running += item->done ? 0 : 1;
            continue;
        }
        int status = 0;
        pid_t pid = child_wait(&status);
        Case *item = pid < 0 ? NULL : find_running(suite, started, pid);
        if (item != NULL) {
            end_case(suite, item, status);
            running--;
        } else if (pid < 0) {
            message("lost a process: %s", strerror(errno));
            return;
        }
        report_done(suite, started);
    }
    report_done(suite, started);
}

static bool write_junit(const Suite *suite) {
    Result **results = memory_zeroed(suite->count * sizeof *results);
    for (size_t i = 0; i < suite->count; i++) {
        results[i] = &suite->cases[i].result;
    }
    bool done = report_junit(suite->junit, results, suite->count);
    free(results);
    return done;
}

static int run_suite(Suite *suite) {
    scripts_sort(&suite->scripts);
    suite->cases = memory_zeroed(suite->scripts.count * sizeof *suite->cases);
    for (size_t i = 0; i < suite->scripts.count; i++) {
        add_case(suite, &suite->scripts.items[i]);
    }
    if (suite->count == 0) {
        message("no script found that has a .golden or a .err beside it%s",
                suite->filter == NULL ? "; 'petri help test' tells how to make one" : " and fits the filter");
        return STATUS_FAILED;
    }
    run_cases(suite);
    size_t passed = 0;
    for (size_t i = 0; i < suite->count; i++) {
        passed += suite->cases[i].result.passed ? 1 : 0;
    }
    output_format(&suite->output, "%zu passed, %zu failed\n", passed, suite->count - passed);
    bool reported = suite->junit == NULL || write_junit(suite);
    return passed == suite->count && reported && !suite->unreadable ? STATUS_DONE : STATUS_FAILED;
}

static bool apply(Suite *suite, const Args *args, int id) {
    switch (id) {
    case ARG_OPERAND:
        if (script_is_stdin(args->value)) {
            message("standard input has no golden beside it: petri test takes files and folders");
            return false;
        }
        suite->unreadable = !scripts_find(&suite->scripts, args->value) || suite->unreadable;
        return true;
    case OPT_UPDATE:
        suite->update = true;
        return true;
    case OPT_FILTER:
        suite->filter = args->value;
        return true;
    case OPT_JUNIT:
        suite->junit = args->value;
        return true;
    case OPT_JOBS:
        return args_integer(args, 1, MOST_JOBS, &suite->jobs);
    case OPT_THREADS:
        suite->threads = args->value;
        return true;
    case OPT_NEIGHBOURS:
        suite->neighbours = args->value;
        return true;
    case OPT_NOSIMPLIFY:
        suite->nosimplify = true;
        return true;
    default:
        return false;
    }
}

static int read_and_run(Suite *suite, Args *args) {
    bool has_path = false;
    for (int id = args_next(args); id != ARG_END; id = args_next(args)) {
        if (id == ARG_HELP) {
            return args_help(args);
        }
        if (id == ARG_WRONG || !apply(suite, args, id)) {
            return STATUS_USAGE;
        }
        has_path = has_path || id == ARG_OPERAND;
    }
    if (!has_path) {
        message("nothing to test; usage: petri test [options] PATH...");
        return STATUS_USAGE;
    }
    if (suite->scripts.count == 0 && suite->unreadable) {
        return STATUS_FAILED;
    }
    return run_suite(suite);
}

static void free_suite(Suite *suite) {
    for (size_t i = 0; i < suite->count; i++) {
        free(suite->cases[i].recorded);
        bytes_free(&suite->cases[i].result.trouble);
    }
    free(suite->cases);
    scripts_free(&suite->scripts);
    free(suite);
}

static int test_run(const Host *host, int argc, char **argv) {
    Suite *suite = memory_zeroed(sizeof *suite);
    suite->host = host;
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    suite->jobs = processors < 1 ? 1 : processors > MOST_JOBS ? MOST_JOBS : processors;
    output_start(&suite->output, STDOUT_FILENO);
    Args args = args_start(&TEST_COMMAND, argc, argv);
    int status = output_finish(&suite->output, read_and_run(suite, &args));
    free_suite(suite);
    return status;
}

const Command TEST_COMMAND = {
    .name = "test",
    .operands = "PATH...",
    .summary = "compare what scripts print with what was recorded",
    .details =
        "Runs each NAME.fl that has a NAME.golden beside it and compares its output with the golden, whose first\n"
        "line holds the options: '# run --frames 61 --every 20 --print state'. A NAME.err holds 'line N': the\n"
        "script must be rejected with an error in that line. Each script runs in the folder that it is in.\n\n"
        "To make a golden, write its first line and let petri write the rest:\n\n"
        "  echo '# run --frames 61 --every 20 --print state' >dish.golden\n"
        "  petri test --update dish.fl",
    .examples = "  petri test .                                    all scripts here that have a golden\n"
                "  petri test --update dish.fl                     its golden becomes what it prints now\n",
    .options = OPTIONS,
    .run = test_run,
};
