// test.c: the command `petri test`, which runs scripts and compares their output with recorded output.
#include "base/clock.h"
#include "cli/memory.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "golden/report.h"
#include "golden/suite.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_CPUS = 256 };

typedef struct Suite {
    const CommandContext *host;
    const Options *options;
    TestList tests;
    size_t reported; // number of tests whose result was printed
    size_t causes;   // number of tests whose cause was sought
    Review review;
    Watch *watch; // NULL: the tests run once
    bool colour;
    Output output;
} Suite;

static ReportFormat format_of(const Suite *suite) {
    return (ReportFormat)test_options(suite->options)->format;
}

static TestCase *find_running(const Suite *suite, size_t started, pid_t pid) {
    for (size_t i = suite->reported; i < started; i++)
        if (!suite->tests.items[i].done && suite->tests.items[i].child.pid == pid)
            return &suite->tests.items[i];
    return NULL;
}

// Prints the result of a test. If its output differs, adds the cause and the command that accepts the output.
static void report_test(Suite *suite, TestCase *test) {
    enum { MAX_CAUSES = 5, PATIENCE = 2 }; // seconds for each cause
    if (test->result.differs) {
        if (suite->causes++ < MAX_CAUSES)
            cause_add(suite->host, test, PATIENCE);
        hint_add(suite->host, test);
    }
    report_result(&suite->output, format_of(suite), suite->reported, &test->result, suite->colour);
    if (test_options(suite->options)->review && test->result.differs)
        review_ask(&suite->review, &suite->output, test);
}

// Prints results in the order of the tests, up to the first test that is not done.
static void report_done(Suite *suite, size_t started) {
    while (suite->reported < started && suite->tests.items[suite->reported].done)
        report_test(suite, &suite->tests.items[suite->reported++]);
    output_flush(&suite->output);
}

// Returns false if no one reads the results: standard output is closed and there is no --junit.
static bool is_wanted(const Suite *suite) {
    return suite->output.error == 0 || test_options(suite->options)->junit;
}

static void run_tests(Suite *suite) {
    size_t started = 0, count = suite->tests.count;
    int64_t running = 0;
    while ((started < count && is_wanted(suite)) || running > 0) {
        if (started < count && running < test_options(suite->options)->jobs && is_wanted(suite)) {
            TestCase *test = &suite->tests.items[started++];
            if (!test->done)
                execute_start(suite->host, suite->options, test);
            running += test->done ? 0 : 1;
            continue;
        }
        int status = 0;
        pid_t pid = subprocess_wait(&status);
        TestCase *test = pid < 0 ? NULL : find_running(suite, started, pid);
        if (test) {
            execute_end(suite->options, test, status);
            running--;
        } else if (pid < 0) {
            message("cannot wait for a process: %s", strerror(errno));
            return;
        }
        report_done(suite, started);
    }
    report_done(suite, started);
}

// Writes JUnit XML to the file of --junit, and to standard output if this is the format. Returns false after a message.
static bool write_junit(Suite *suite) {
    const TestList *tests = &suite->tests;
    const char *file = test_options(suite->options)->junit;
    if (!file && format_of(suite) != REPORT_JUNIT)
        return true;
    const Result **results = memory_calloc(tests->count * sizeof *results);
    SCOPED_TEXT text = {0};
    for (size_t i = 0; i < tests->count; i++)
        results[i] = &tests->items[i].result;
    report_junit(&text, results, tests->count);
    free(results);
    if (format_of(suite) == REPORT_JUNIT)
        output_write(&suite->output, text.bytes, text.len);
    return !file || output_file(file, text_str(&text));
}

static void report_totals(Suite *suite, size_t passed) {
    size_t count = suite->tests.count, untested = suite->tests.untested;
    output_format(&suite->output, "%zu passed, %zu failed", passed, count - passed);
    if (untested > 0)
        output_format(&suite->output, ", %zu %s without a test", untested, untested == 1 ? "script" : "scripts");
    output_format(&suite->output, "\n");
}

static int run_suite(Suite *suite) {
    const Options *options = suite->options;
    const TestOptions *own = test_options(options);
    if (options->scripts.count == 0 && options->unreadable.count > 0)
        return STATUS_FAILED;
    suite->tests = tests_find(options);
    if (suite->watch)
        watch_select(suite->watch, &suite->tests);
    if (suite->tests.count == 0 && !suite->watch) {
        const char *script = options->scripts.count == 1 ? options->scripts.items[0].path : "SCRIPT";
        message("no script found with a .golden, .err or .properties file%s%s",
                !own->filter ? "; to create a golden, run: petri test --new " : " that matches --filter",
                !own->filter ? script : "");
        return STATUS_FAILED;
    }
    report_begin(&suite->output, format_of(suite), suite->tests.count);
    run_tests(suite);
    size_t passed = 0, count = suite->tests.count;
    for (size_t i = 0; i < count; i++)
        passed += suite->tests.items[i].result.passed ? 1 : 0;
    if (own->review)
        review_report(&suite->review, &suite->output);
    if (format_of(suite) == REPORT_TEXT || format_of(suite) == REPORT_GITHUB)
        report_totals(suite, passed);
    bool reported = write_junit(suite);
    return passed == count && reported && options->unreadable.count == 0 ? STATUS_DONE : STATUS_FAILED;
}

// Runs tests again when their files change, until a signal ends the process.
static void watch_tests(Suite *suite) {
    suite->watch = watch_new(&suite->tests);
    while (suite->output.error == 0) {
        output_flush(&suite->output);
        message("waiting for changes; Ctrl-C ends");
        watch_wait(suite->watch);
        tests_free(&suite->tests);
        suite->reported = suite->causes = 0;
        run_suite(suite);
    }
    watch_free(suite->watch);
}

static bool check_options(const TestOptions *own) {
    const char *problem = own->review && own->update   ? "--review and --update exclude each other"
                          : own->review && own->watch  ? "--review and --watch exclude each other"
                          : own->review && own->format ? "--review needs --format text"
                                                       : NULL;
    if (problem)
        message("%s", problem);
    return !problem;
}

static int test_run(const CommandContext *context, Options *options) {
    TestOptions *own = test_options(options);
    Suite suite = {.host = context,
                   .options = options,
                   .output.fd = STDOUT_FILENO,
                   .review = {.host = context, .options = options}};
    suite.colour = own->colour == ALWAYS || (own->colour == AUTO && isatty(STDOUT_FILENO) && option_default_colour());
    if (!check_options(own))
        return STATUS_USAGE;
    if (own->jobs == 0) {
        int jobs = subprocess_default_jobs();
        own->jobs = jobs > MAX_CPUS ? MAX_CPUS : jobs;
    }
    int status = run_suite(&suite);
    if (own->watch && suite.tests.count > 0)
        watch_tests(&suite);
    status = output_finish(&suite.output, status);
    tests_free(&suite.tests);
    return status;
}

const Command TEST_COMMAND = {
    .name = "test",
    .operands = "PATH...",
    .summary = "run scripts and compare the output with goldens",
    .details =
        "Runs each NAME.fl that has a NAME.golden beside it and compares the output. The first line of a golden\n"
        "contains the options of the run: '# run --frames 61 --every 20 --print state'. If there is a NAME.err, the\n"
        "script must be rejected with an error in the line that it names, and with the messages below that line, if\n"
        "there are any. NAME.session is a transcript of 'petri repl', whose inputs are repeated. The properties in\n"
        "NAME.properties must hold for many values of the script's parameters. Each script runs in its folder. A\n"
        "test file without its script fails.\n\n"
        "To create a golden, or an .err file for a script with an error, give the script and options of the run:\n\n"
        "  petri test --new dish.fl --frames 61 --every 20 --print state\n\n"
        "PATH can also be a golden or another test file. With --print hash, a golden has one line per frame: the\n"
        "SHA-256 of the state.",
    .examples = "  petri test .                                    test all scripts in this folder\n"
                "  petri test --update dish.fl                     write the current output to its golden\n",
    .missing_operand = "no script or folder given",
    .no_stdin = "cannot test standard input: it has no golden; give files or folders",
    .options = &TEST_OPTIONS,
    .accepts_many = true,
    .suffixes = TEST_SUFFIXES,
    .parts = (const Command *const[]){&TEST_NEW_COMMAND, NULL},
    .run = test_run,
};
