// properties.c: NAME.properties, statements about all runs of a script; see suite.h and src/property.
#include "golden/suite.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

bool properties_begin(const Options *options, TestCase *test, TextList *words) {
    const char *file = test->recorded + (test->name - test->script);
    texts_add(words, "--check-properties");
    texts_add(words, file);
    texts_add_format(words, "%" PRId64, test_options(options)->jobs);
    texts_add(words, test->script);
    return true;
}

// Reads the report: `LINE REASON`, then details.
static void read_report(TestCase *test, const Text *output) {
    Result *result = &test->result;
    char *end = NULL;
    result->line = (uint32_t)strtoul(output->bytes, &end, 10);
    size_t length = strcspn(end, "\n");
    end += end[0] == ' ' ? 1 : 0;
    text_add(&result->error_text, (Str){end, strcspn(end, "\n")});
    text_add_c(&result->error_text, "");
    end += length > 0 ? strcspn(end, "\n") : 0;
    text_add_c(&result->details, end[0] == '\n' ? end + 1 : end);
}

void properties_end(const Options *options, TestCase *test, const RunOutput *run) {
    Result *result = &test->result;
    (void)options;
    int status = WIFEXITED(run->status) ? WEXITSTATUS(run->status) : -1;
    result->passed = status == 0;
    if (status == 1) {
        read_report(test, &run->output);
    } else if (status != 0) {
        // The message has a position: `petri: FILE:LINE: error: ...`.
        const char *name = test->recorded + (test->name - test->script);
        result->line = (uint32_t)run_message_line(name, &run->errors, 0);
        const char *reason = strstr(run->errors.bytes, " error: ");
        if (WIFEXITED(run->status) && reason)
            text_add(&result->error_text, (Str){reason + 8, strcspn(reason + 8, "\n")});
        else
            subprocess_describe(run->status, &run->errors, &result->error_text);
        text_add_c(&result->error_text, "");
    }
}
