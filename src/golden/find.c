// find.c: the tests in the operands; see suite.h.
#include "base/file.h"
#include "base/source.h"
#include "golden/suite.h"

#include <stdlib.h>
#include <string.h>

static void add_test(TestList *list, const TestKind *kind, const char *script, char *recorded) {
    if ((list->count & (list->count + 1)) == 0) // there is room for the next power of two
        list->items = memory_realloc(list->items, 2 * (list->count + 1) * sizeof *list->items);
    TestCase *test = &list->items[list->count++];
    *test = (TestCase){.kind = kind, .script = memory_strdup(script), .recorded = recorded};
    test->name = test->script + path_directory(str_from(test->script)).len;
    test->result.name = kind->own_name ? recorded : test->script;
    test->result.file = recorded;
}

// Adds a test file. If its script is missing, the test has failed: the script may have been renamed.
static void add_file(TestList *list, const TestKind *kind, const char *path) {
    SCOPED_STRING script = kind_path(path, ".fl");
    add_test(list, kind, script, memory_strdup(path));
    if (kind->names_script || file_exists(script))
        return;
    TestCase *test = &list->items[list->count - 1];
    test->result.name = test->recorded;
    test->done = true;
    text_add_format(&test->result.error_text, "no such script: %s; rename the test file like its script, or delete it",
                    script);
}

static void add_script(TestList *list, const char *script) {
    size_t before = list->count;
    for (const TestKind *kind = TEST_KINDS; kind->suffix; kind++) {
        char *file = kind_path(script, kind->suffix);
        if (file_exists(file))
            add_test(list, kind, script, file);
        else
            free(file);
    }
    list->untested += list->count == before ? 1 : 0;
}

static int compare_tests(const void *a, const void *b) {
    const TestCase *first = a;
    const TestCase *second = b;
    int order = strcmp(first->result.name, second->result.name);
    return order != 0 ? order : strcmp(first->recorded, second->recorded);
}

// Sorts the tests and removes those that are there twice: from a script and from its test file.
static void sort_tests(TestList *list) {
    size_t kept = 0;
    if (list->count > 0)
        qsort(list->items, list->count, sizeof *list->items, compare_tests);
    for (size_t i = 0; i < list->count; i++)
        if (kept > 0 && strcmp(list->items[i].recorded, list->items[kept - 1].recorded) == 0)
            test_free(&list->items[i]);
        else
            list->items[kept++] = list->items[i];
    list->count = kept;
}

TestList tests_find(const Options *options) {
    TestList list = {0};
    const char *filter = test_options(options)->filter;
    for (size_t i = 0; i < options->scripts.count; i++) {
        const Script *script = &options->scripts.items[i];
        const TestKind *kind = kind_of_file(script->path);
        if (filter && !strstr(script->path + script->relative_start, filter))
            continue;
        if (kind)
            add_file(&list, kind, script->path);
        else
            add_script(&list, script->path);
    }
    sort_tests(&list);
    return list;
}

void tests_free(TestList *list) {
    for (size_t i = 0; i < list->count; i++)
        test_free(&list->items[i]);
    free(list->items);
    *list = (TestList){0};
}
