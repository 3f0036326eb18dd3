// run_kind.c: goldens of `petri run`; see suite.h.
#include "golden/suite.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

void run_kind_add_common(const Options *options, const TestCase *test, TextList *words) {
    const TestOptions *own = test_options(options);
    // `petri run` rejects invalid values.
    if (own->as_threads)
        texts_add_format(words, "--threads=%s", own->as_threads);
    if (own->as_neighbours)
        texts_add_format(words, "--neighbours=%s", own->as_neighbours);
    if (options->unsimplified)
        texts_add(words, "--nosimplify");
    if (options->no_batches)
        texts_add(words, "--no-batches");
    texts_add(words, "--");
    texts_add(words, test->name);
}

bool run_kind_begin(const Options *options, TestCase *test, TextList *words) {
    if (!golden_read(&test->golden, test->recorded, &test->result.error_text))
        return false;
    texts_add(words, "run");
    // One thread for each script, because the scripts already run in parallel. A golden can set another number of
    // threads. Results never depend on it.
    texts_add(words, "--threads=1");
    for (size_t i = 0; i < test->golden.options.count; i++)
        texts_add(words, test->golden.options.items[i]);
    run_kind_add_common(options, test, words);
    return true;
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

void run_kind_describe(TestCase *test, const RunOutput *run) {
    test->result.file = test->script;
    test->result.line = (uint32_t)run_message_line(test->name, &run->errors, 0);
    subprocess_describe(run->status, &run->errors, &test->result.error_text);
}

void run_kind_end(const Options *options, TestCase *test, const RunOutput *run) {
    Result *result = &test->result;
    if (!run_is_complete(run->status, &run->errors))
        run_kind_describe(test, run);
    else if (run_has_diverged(&run->errors, &result->error_text))
        result->passed = false;
    else if (test_options(options)->update)
        result->passed =
            golden_update(&test->golden, test->recorded, &run->output, &result->updated, &result->error_text);
    else
        result->passed = golden_compare(&test->golden, &run->output, result);
    result->differs = !result->passed && result->details.len > 0;
}
