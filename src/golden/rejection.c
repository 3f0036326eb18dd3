// rejection.c: tests of scripts that must be rejected; see suite.h.
//
// NAME.err begins with `line N`, or `line *` for any line. The messages of the run follow, which are also compared if
// there are any.
#include "base/file.h"
#include "golden/line_diff.h"
#include "golden/suite.h"

#include <stdio.h>
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
    long line = run_message_line(name, errors, NO_LINE);
    if (line != NO_LINE)
        add_contents(&text, line, errors);
    return text;
}

bool rejection_begin(const Options *options, TestCase *test, TextList *words) {
    texts_add(words, "run");
    texts_add(words, "--threads=1");
    texts_add(words, "--frames=1");
    run_add_common(options, test, words);
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

// Compares the messages with the recorded ones.
static void compare_messages(TestCase *test, Str recorded, const Text *errors) {
    Result *result = &test->result;
    LineDiff diff = {0};
    result->passed = recorded.len == 0 || str_equal(recorded, text_str(errors));
    if (result->passed)
        return;
    line_diff_add(&diff, recorded, text_str(errors), 0, -1);
    line_diff_print(&diff, 2, "messages", &result->details);
    text_add_format(&result->error_text, "the messages differ, but the error is in the same line");
    result->line = 2;
    result->differs = true;
}

static void check(const Options *options, TestCase *test, const Rejection *recorded, const RunOutput *run) {
    Text *error_text = &test->result.error_text;
    long line = WIFEXITED(run->status) ? run_message_line(test->name, &run->errors, recorded->line) : NO_LINE;
    if (!WIFEXITED(run->status)) {
        subprocess_describe(run->status, &run->errors, error_text);
    } else if (WEXITSTATUS(run->status) != 0 && line != NO_LINE && test_options(options)->update) {
        record(test, recorded, line, &run->errors);
    } else if (WEXITSTATUS(run->status) != 0 && line != NO_LINE &&
               (recorded->line == ANY_LINE || line == recorded->line)) {
        compare_messages(test, recorded->messages, &run->errors);
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
        test->result.differs = WEXITSTATUS(run->status) != 0 && line != NO_LINE;
    }
}

void rejection_end(const Options *options, TestCase *test, const RunOutput *run) {
    Rejection recorded = read_rejection(test->recorded, &test->result.error_text);
    if (recorded.line != NO_LINE)
        check(options, test, &recorded, run);
    text_free(&recorded.text);
}
