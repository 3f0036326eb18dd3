// run_output.c: the output of a run, and the words that all runs have; see suite.h.
#include "golden/suite.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

void run_add_common(const Options *options, const TestCase *test, TextList *words) {
    const TestOptions *own = test_options(options);
    // `petri run` rejects invalid values.
    if (own->as_threads)
        texts_add_format(words, "--threads=%s", own->as_threads);
    if (own->as_neighbours)
        texts_add_format(words, "--neighbours=%s", own->as_neighbours);
    if (options->unsimplified)
        texts_add(words, "--nosimplify");
    if (options->no_batches && !test->golden.renders)
        texts_add(words, "--no-batches");
    texts_add(words, "--");
    texts_add(words, test->name);
}

bool run_is_complete(int status, const Text *errors) {
    static const char last[] = "petri: " BROKEN_MODULE_MESSAGE "\n";
    Str text = text_str(errors);
    return WIFEXITED(status) && (WEXITSTATUS(status) == STATUS_DONE ||
                                 (WEXITSTATUS(status) == STATUS_FAILED && str_ends_with(text, str_from(last))));
}

bool run_has_diverged(const Text *errors, Text *error_text) {
    const char *code = strstr(errors->bytes, " [divergence]\n"), *line = code;
    while (line && line > errors->bytes && line[-1] != '\n')
        line--;
    if (line)
        text_add_format(error_text, "%.*s", (int)(code - line), line);
    return line;
}

// Finds the next `NAME:LINE:` at or after *at, in the messages of a run. Returns LINE and moves *at to the colon after
// it. Returns 0 if there is none.
static long next_line(const char **at, const char *name) {
    size_t length = strlen(name);
    for (const char *found = strstr(*at, name); found; found = strstr(found + 1, name)) {
        char *end = NULL;
        long line = found[length] == ':' ? strtol(found + length + 1, &end, 10) : 0;
        if (line > 0 && *end == ':') {
            *at = end;
            return line;
        }
    }
    return 0;
}

long run_message_line(const char *name, const Text *errors, long wanted) {
    const char *at = errors->bytes;
    long first = next_line(&at, name), line = first;
    while (line != 0 && line != wanted)
        line = next_line(&at, name);
    return line == 0 ? first : line;
}

void run_describe(TestCase *test, const RunOutput *run) {
    test->result.file = test->script;
    test->result.line = (uint32_t)run_message_line(test->name, &run->errors, 0);
    subprocess_describe(run->status, &run->errors, &test->result.error_text);
}
