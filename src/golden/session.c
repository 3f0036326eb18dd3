// session.c: NAME.session, transcripts of `petri repl`; see suite.h and repl/transcript.c.
#include "base/file.h"
#include "base/source.h"
#include "golden/line_diff.h"
#include "golden/suite.h"

#include <string.h>
#include <sys/wait.h>

bool session_begin(const Options *options, TestCase *test, TextList *words) {
    (void)options;
    texts_add(words, "repl");
    texts_add(words, "--");
    texts_add(words, test->recorded + path_directory(str_from(test->recorded)).len);
    return true;
}

// Returns the length of a measured time such as `147 us` at the start of a text, or 0.
static size_t time_length(Str text) {
    static const char *const units[] = {" s", " ms", " us", " ns"};
    size_t at = 0;
    while (at < text.len && text.bytes[at] && strchr("0123456789.e+-", text.bytes[at]))
        at++;
    Str rest = {text.bytes + at, text.len - at};
    for (size_t i = 0; at > 0 && i < sizeof units / sizeof units[0]; i++) {
        size_t end = strlen(units[i]);
        if (str_starts_with(rest, str_from(units[i])) && (rest.len == end || strchr(",\n", rest.bytes[end])))
            return at + end;
    }
    return 0;
}

// Adds a transcript to `out`, in which each measured time of `.time` is TIME, without blanks at the ends of lines,
// which editors remove.
static void add_comparable(Str text, Text *out) {
    while (text.len > 0) {
        const char *end = memchr(text.bytes, '\n', text.len);
        size_t length = end ? (size_t)(end - text.bytes) : text.len, time = 0;
        Str line = {text.bytes, length};
        while (line.len > 0 && line.bytes[line.len - 1] == ' ')
            line.len--;
        if (str_starts_with(line, STR("-- ")))
            time = time_length((Str){line.bytes + 3, line.len - 3});
        text_add(out, (Str){line.bytes, time > 0 ? 3 : line.len});
        if (time > 0) {
            text_add_c(out, "TIME");
            text_add(out, (Str){line.bytes + 3 + time, line.len - 3 - time});
        }
        text_add_c(out, "\n");
        length += end != NULL;
        text = (Str){text.bytes + length, text.len - length};
    }
}

static void record(TestCase *test, const RunOutput *run) {
    const char *problem = file_replace(test->recorded, text_str(&run->output), 0);
    if (problem)
        text_add_format(&test->result.error_text, "cannot write %s: %s", test->recorded, problem);
    test->result.passed = test->result.updated = !problem;
}

// Returns the start of the last line.
static size_t last_line(const Text *text) {
    size_t start = text->len > 0 ? text->len - 1 : 0;
    while (start > 0 && text->bytes[start - 1] != '\n')
        start--;
    return start;
}

static bool ends_with_prompt(const Text *text) {
    return str_ends_with(text_str(text), STR(">\n"));
}

// Removes the last lines of a new transcript that the recorded one, which was typed, need not have: the exit status and
// the empty prompt before it.
static void drop_end(Text *now, const Text *recorded) {
    static const char status[] = "# exit status ";
    if (recorded->len > 0 && strncmp(recorded->bytes + last_line(recorded), status, strlen(status)) == 0)
        return;
    if (now->len > 0 && strncmp(now->bytes + last_line(now), status, strlen(status)) == 0)
        now->len = last_line(now);
    if (ends_with_prompt(now) && !ends_with_prompt(recorded))
        now->len = last_line(now);
}

static void compare(TestCase *test, const Text *recorded, const Text *now) {
    LineDiff diff = {0};
    line_diff_add(&diff, text_str(recorded), text_str(now), 0, -1);
    line_diff_print(&diff, 1, "transcript", &test->result.details);
    text_add_c(&test->result.error_text, "the answers differ");
    test->result.differs = true;
}

void session_end(const Options *options, TestCase *test, const RunOutput *run) {
    SCOPED_TEXT text = {0};
    SCOPED_TEXT recorded = {0};
    SCOPED_TEXT now = {0};
    if (!golden_read_text(&text, test->recorded, &test->result.error_text))
        return;
    add_comparable(text_str(&text), &recorded);
    add_comparable(text_str(&run->output), &now);
    drop_end(&now, &recorded);
    if (!WIFEXITED(run->status) || run->errors.len > 0)
        subprocess_describe(run->status, &run->errors, &test->result.error_text);
    else if (str_equal(text_str(&recorded), text_str(&now)))
        test->result.passed = true;
    else if (test_options(options)->update)
        record(test, run);
    else
        compare(test, &recorded, &now);
}
