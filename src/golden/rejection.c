// rejection.c: tests of scripts that must be rejected; see suite.h.
//
// NAME.err begins with `line N`, or `line *` for any line. The messages of the run follow, which are also compared if
// there are any.
#include "base/file.h"
#include "golden/suite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

enum { ANY_LINE = -1, NO_LINE = 0 };

typedef struct Rejection {
    Text text;    // the file
    long line;    // that has the error, ANY_LINE, or NO_LINE if the file cannot be read
    Str messages; // part of `text`; empty: not compared
} Rejection;

// Reads a file. On failure, adds the reason to error_text and sets the line to NO_LINE.
static Rejection read_rejection(const char *path, Text *error_text) {
    Rejection found = {.line = NO_LINE};
    if (!golden_read_text(&found.text, path, error_text))
        return found;
    text_add_c(&found.text, "");
    size_t at = strcspn(found.text.bytes, "\n");
    SCOPED_STRING first = memory_strndup(found.text.bytes, at);
    char rest = '\0';
    if (strncmp(first, "line *", 6) == 0 && sscanf(first + 6, " %c", &rest) != 1)
        found.line = ANY_LINE;
    else if (sscanf(first, "line %ld %c", &found.line, &rest) != 1 || found.line < 1)
        found.line = NO_LINE;
    if (found.line == NO_LINE)
        text_add_format(error_text, "cannot read %s: expected 'line N' or 'line *'", path);
    at += found.text.bytes[at] == '\n' ? 1 : 0;
    found.messages = (Str){found.text.bytes + at, found.text.len - at};
    return found;
}

// Finds the next `NAME:LINE:` at or after *at, in the error messages of a run. Returns LINE and moves *at to the colon
// after it. Returns NO_LINE if there is none.
static long next_reported_line(const char **at, const char *name) {
    size_t length = strlen(name);
    for (const char *found = strstr(*at, name); found; found = strstr(found + 1, name)) {
        char *end = NULL;
        long line = found[length] == ':' ? strtol(found + length + 1, &end, 10) : NO_LINE;
        if (line > 0 && *end == ':') {
            *at = end;
            return line;
        }
    }
    return NO_LINE;
}

// Returns the first line with an error, or `wanted` if that line also has one; NO_LINE: none has.
static long reported_line(const char *name, const Text *errors, long wanted) {
    const char *at = errors->bytes;
    long first = next_reported_line(&at, name), line = first;
    while (line != NO_LINE && line != wanted)
        line = next_reported_line(&at, name);
    return line == NO_LINE ? first : line;
}

static void add_place(Text *text, long line) {
    if (line == ANY_LINE)
        text_add_c(text, "line *");
    else
        text_add_format(text, "line %ld", line);
}

static void add_contents(Text *text, long line, const Text *errors) {
    add_place(text, line);
    text_add_c(text, "\n");
    text_add(text, text_str(errors));
}

Text rejection_text(const char *name, const Text *errors) {
    Text text = {0};
    long line = reported_line(name, errors, NO_LINE);
    if (line != NO_LINE)
        add_contents(&text, line, errors);
    return text;
}

bool rejection_begin(const Options *options, TestCase *test, TextList *words) {
    texts_add(words, "run");
    texts_add(words, "--threads=1");
    texts_add(words, "--frames=1");
    run_kind_add_common(options, test, words);
    return true;
}

// Replaces the file if it has other contents. `line *` is kept.
static void record(TestCase *test, const Rejection *recorded, long line, const Text *errors) {
    SCOPED_TEXT text = {0};
    add_contents(&text, recorded->line == ANY_LINE ? ANY_LINE : line, errors);
    test->result.updated = !str_equal(text_str(&text), text_str(&recorded->text));
    const char *problem = test->result.updated ? file_replace(test->recorded, text_str(&text), 0) : NULL;
    if (problem)
        text_add_format(&test->result.error_text, "cannot write %s: %s", test->recorded, problem);
    test->result.passed = !problem;
}

// Compares the messages line by line.
static bool compare_messages(Str recorded, const Text *errors, Text *error_text) {
    const Text first = {.bytes = (char *)recorded.bytes, .len = recorded.len};
    size_t a = 0, b = 0;
    for (long number = 2;; number++) {
        Str expected = {0}, got = {0};
        bool more_expected = text_next_line(&first, &a, &expected), more_got = text_next_line(errors, &b, &got);
        if (!more_expected && !more_got)
            return true;
        if (more_expected && more_got && str_equal(expected, got))
            continue;
        text_add_format(error_text, "line %ld of the .err file: expected %.*s, got %.*s", number,
                        STR_ARGS(more_expected ? expected : STR("the end")), STR_ARGS(more_got ? got : STR("the end")));
        return false;
    }
}

static void check(const Options *options, TestCase *test, const Rejection *recorded, const RunOutput *run) {
    Text *error_text = &test->result.error_text;
    long line = WIFEXITED(run->status) ? reported_line(test->name, &run->errors, recorded->line) : NO_LINE;
    if (!WIFEXITED(run->status)) {
        subprocess_describe(run->status, &run->errors, error_text);
    } else if (WEXITSTATUS(run->status) != 0 && line != NO_LINE && test_options(options)->update) {
        record(test, recorded, line, &run->errors);
    } else if (WEXITSTATUS(run->status) != 0 && line != NO_LINE &&
               (recorded->line == ANY_LINE || line == recorded->line)) {
        test->result.passed =
            recorded->messages.len == 0 || compare_messages(recorded->messages, &run->errors, error_text);
    } else {
        text_add_c(error_text, "expected an error in ");
        if (recorded->line == ANY_LINE)
            text_add_c(error_text, "any line");
        else
            add_place(error_text, recorded->line);
        text_add_c(error_text, ", got ");
        if (WEXITSTATUS(run->status) == 0)
            text_add_c(error_text, "none");
        else if (line == NO_LINE)
            subprocess_describe(run->status, &run->errors, error_text);
        else
            text_add_format(error_text, "one in line %ld", line);
    }
}

void rejection_end(const Options *options, TestCase *test, const RunOutput *run) {
    Rejection recorded = read_rejection(test->recorded, &test->result.error_text);
    if (recorded.line != NO_LINE)
        check(options, test, &recorded, run);
    text_free(&recorded.text);
}
