// execute.c: execution of one test; see suite.h.
#include "base/clock.h"
#include "golden/suite.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

void execute_start(const CommandContext *host, const Options *options, TestCase *test) {
    SCOPED_STRING folder = memory_folder(test->script);
    TextList words = {0};
    test->host = host;
    texts_add(&words, "petri");
    test->result.seconds = clock_seconds();
    test->done = !test->kind->begin(options, test, &words);
    if (!test->done && !subprocess_start(&test->child, host->program, folder, words.items, SUBPROCESS_MAX_SECONDS)) {
        text_add_format(&test->result.error_text, "cannot start a process: %s", strerror(errno));
        test->done = true;
    }
    if (test->done)
        golden_free(&test->golden);
    texts_free(&words);
}

void execute_end(const Options *options, TestCase *test, int status) {
    RunOutput run = {.status = status};
    test->result.seconds = clock_seconds() - test->result.seconds;
    const char *problem = subprocess_collect(&test->child, &run.output, &run.errors);
    if (problem)
        text_add_format(&test->result.error_text, "cannot read the output of the run: %s", problem);
    else
        test->kind->end(options, test, &run);
    text_free(&run.output);
    text_free(&run.errors);
    golden_free(&test->golden);
    test->done = true;
}

void execute_again(const CommandContext *host, const Options *options, TestCase *test) {
    Result *result = &test->result;
    text_free(&result->error_text);
    text_free(&result->details);
    *result = (Result){.name = result->name, .file = test->recorded};
    execute_start(host, options, test);
    if (!test->done)
        execute_end(options, test, subprocess_wait_for(test->child.pid));
}

void test_free(TestCase *test) {
    free(test->script);
    free(test->recorded);
    text_free(&test->result.error_text);
    text_free(&test->result.details);
}
