// review.c: `petri test --review`, which asks what to do with each difference; see suite.h.
#include "golden/report.h"
#include "golden/suite.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

enum { PATIENCE = 60 }; // seconds for the search of a cause

static void accept_output(Review *review, Output *output, TestCase *test) {
    TestOptions *own = test_options(review->options);
    own->update = true;
    execute_again(review->host, review->options, test);
    own->update = false;
    review->accepted += test->result.passed ? 1 : 0;
    report_result(output, REPORT_TEXT, 0, &test->result, false);
}

static void show_cause(const Review *review, Output *output, TestCase *test) {
    Text details = test->result.details;
    test->result.details = (Text){0};
    if (!cause_add(review->host, test, PATIENCE))
        text_add_c(&test->result.details, "no cause found: git has no script with other frames\n");
    output_write(output, test->result.details.bytes, test->result.details.len);
    text_free(&test->result.details);
    test->result.details = details;
}

static void show_pictures(Output *output, TestCase *test) {
    if (!test->kind->show || !test->kind->show(output, test))
        output_format(output, "this test has no pictures\n");
}

// Carries out one answer. Returns true if the next difference can be shown.
static bool answer(Review *review, Output *output, TestCase *test, char letter) {
    switch (letter) {
    case 'a':
        accept_output(review, output, test);
        return true;
    case 'r':
        review->rejected++;
        if (test->kind->discard)
            test->kind->discard(test);
        return true;
    case 'q':
        review->ended = true;
        return true;
    case 's':
        return true;
    case 'c':
        show_cause(review, output, test);
        return false;
    case 'p':
        show_pictures(output, test);
        return false;
    default:
        output_format(output,
                      "a: record this output; r: reject it; s: decide later; c: show why it differs; p: show both "
                      "pictures; q: end the review\n");
        return false;
    }
}

static void print_question(Output *output) {
    output_format(output, "accept, reject, skip, cause, pictures or quit? [a/r/s/c/p/q] ");
    output_flush(output);
}

// Asks on a terminal, reads a key and shows it. Ctrl-C and Ctrl-D end the review, so that the terminal's settings
// return. They have changed before the question, so that no answer comes too early.
static char read_key(Output *output, const struct termios *settings) {
    struct termios raw = *settings;
    char key = '\n';
    raw.c_lflag &= ~(tcflag_t)(ICANON | ECHO | ISIG);
    raw.c_cc[VMIN] = 1;
    raw.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSADRAIN, &raw);
    print_question(output);
    while (key == '\n' || key == '\r') { // of an answer with Enter
        ssize_t count = read(STDIN_FILENO, &key, 1);
        if (count == 0 || (count < 0 && errno != EINTR))
            key = 'q';
    }
    tcsetattr(STDIN_FILENO, TCSADRAIN, settings);
    key = key == '\003' || key == '\004' ? 'q' : key;
    output_format(output, "%c\n", key >= ' ' && key <= '~' ? key : '?');
    return key;
}

// Asks, and reads an answer: a key on a terminal, otherwise the first character of a line. Returns false at the end of
// the input.
static bool read_answer(Output *output, char *letter) {
    struct termios settings;
    char line[80] = "";
    if (isatty(STDIN_FILENO) && tcgetattr(STDIN_FILENO, &settings) == 0) {
        *letter = read_key(output, &settings);
        return true;
    }
    print_question(output);
    bool good = fgets(line, sizeof line, stdin);
    *letter = line[0];
    return good;
}

void review_ask(Review *review, Output *output, TestCase *test) {
    char letter;
    bool decided = review->ended;
    while (!decided) {
        if (!read_answer(output, &letter)) {
            output_format(output, "\n");
            review->ended = decided = true;
        } else {
            decided = answer(review, output, test, letter);
        }
    }
    review->asked++;
}

void review_report(const Review *review, Output *output) {
    size_t skipped = review->asked - review->accepted - review->rejected;
    output_format(output, "%zu accepted, %zu rejected, %zu left\n", review->accepted, review->rejected, skipped);
}
