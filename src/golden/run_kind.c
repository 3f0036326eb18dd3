// run_kind.c: goldens of `petri run`; see suite.h.
#include "golden/suite.h"

bool run_kind_begin(const Options *options, TestCase *test, TextList *words) {
    texts_add(words, "run");
    // One thread for each script, because the scripts already run in parallel. A golden can set another number of
    // threads. Results never depend on it.
    texts_add(words, "--threads=1");
    for (size_t i = 0; i < test->golden.options.count; i++)
        texts_add(words, test->golden.options.items[i]);
    run_add_common(options, test, words);
    return true;
}

void run_kind_end(const Options *options, TestCase *test, const RunOutput *run) {
    Result *result = &test->result;
    if (!run_is_complete(run->status, &run->errors))
        run_describe(test, run);
    else if (run_has_diverged(&run->errors, &result->error_text))
        result->passed = false;
    else if (test_options(options)->update)
        result->passed =
            golden_update(&test->golden, test->recorded, &run->output, &result->updated, &result->error_text);
    else
        result->passed = golden_compare(&test->golden, &run->output, result);
    result->differs = !result->passed && result->details.len > 0;
}
