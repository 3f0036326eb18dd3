// kinds.c: the kinds of tests; see suite.h.
#include "golden/suite.h"

#include <string.h>

// --- goldens: their first line says which command they record

static bool golden_begin(const Options *options, TestCase *test, TextList *words) {
    if (!golden_read(&test->golden, test->recorded, &test->result.error_text))
        return false;
    return test->golden.renders ? pictures_begin(options, test, words) : run_kind_begin(options, test, words);
}

static void golden_end(const Options *options, TestCase *test, const RunOutput *run) {
    if (test->golden.renders)
        pictures_end(options, test, run);
    else
        run_kind_end(options, test, run);
}

// --- all kinds

// In the order of execution for one script.
const TestKind TEST_KINDS[] = {
    {.suffix = ".golden",
     .begin = golden_begin,
     .end = golden_end,
     .follows_runs = true,
     .show = pictures_show,
     .discard = pictures_discard},
    {.suffix = ".err", .begin = rejection_begin, .end = rejection_end},
    {.suffix = ".session", .own_name = true, .names_script = true, .begin = session_begin, .end = session_end},
    {.suffix = ".properties", .own_name = true, .begin = properties_begin, .end = properties_end},
    {.suffix = NULL},
};
const char *const TEST_SUFFIXES[] = {".golden", ".err", ".session", ".properties", NULL};

const TestKind *kind_of_file(const char *path) {
    for (const TestKind *kind = TEST_KINDS; kind->suffix; kind++)
        if (str_ends_with(str_from(path), str_from(kind->suffix)))
            return kind;
    return NULL;
}

char *kind_path(const char *path, const char *suffix) {
    const TestKind *kind = kind_of_file(path);
    const char *old = kind ? kind->suffix : ".fl";
    size_t length = strlen(path);
    if (length > strlen(old) && str_ends_with(str_from(path), str_from(old)))
        length -= strlen(old);
    Text result = {0};
    text_add_format(&result, "%.*s%s", (int)length, path, suffix);
    return result.bytes;
}
