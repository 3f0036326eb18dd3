// test_src_terminal_keys.c: tests that the byte sequences of terminals are decoded to events.
#include "check.h"
#include "petri-live.h"
#include "view/terminal_keys.h"

#include <time.h>
#include <unistd.h>

// Sends bytes through a pipe.
static void send(TerminalInput *input, const char *text, size_t length) {
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], text, length), length);
    assert_int_equal(close(ends[1]), 0);
    terminal_input_read(input, ends[0]);
    assert_int_equal(close(ends[0]), 0);
}

static void send_text(TerminalInput *input, const char *text) {
    send(input, text, strlen(text));
}

static void check_tap(const char *row, const Event *event, const char *key, bool control) {
    assert_claim(row, event->kind == EVENT_KEY_TAP);
    assert_text(row, event->key, key);
    assert_claim(row, event->control == control);
}

static void test_sequence_gives_key(void **state) {
    static const struct {
        const char *text;
        const char *key;
        bool control;
    } rows[] = {
        {"a", "a", false},
        {"Z", "z", false},
        {"7", "7", false},
        {" ", "space", false},
        {".", "period", false},
        {"\r", "enter", false},
        {"\t", "tab", false},
        {"\177", "backspace", false},
        {"\021", "q", true},
        {"\033[A", "up", false},
        {"\033[D", "left", false},
        {"\033OC", "right", false},
        {"\033OP", "f1", false},
        {"\033[15~", "f5", false},
        {"\033[24~", "f12", false},
        {"\033[3~", "delete", false},
        {"\033[6~", "page_down", false},
        {"\033[1;5A", "up", false},
        {"\033[H", "home", false},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        TerminalInput input = {0};
        send_text(&input, rows[i].text);
        Event event = terminal_input_next(&input);
        check_tap(rows[i].text, &event, rows[i].key, rows[i].control);
        assert_int_equal(terminal_input_next(&input).kind, EVENT_NONE);
        assert_int_equal(input.count, 0);
    }
}

static void test_unknown_sequence_is_ignored(void **state) {
    static const char *const rows[] = {"\xC3\xA4", "\001\033[99~", "\033[1;2Y", "\033[?1;2c", "\033OZ", "!"};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        TerminalInput input = {0};
        send_text(&input, rows[i] + (i == 1));
        assert_claim(rows[i], terminal_input_next(&input).kind == EVENT_NONE);
        send_text(&input, "q");
        Event event = terminal_input_next(&input);
        check_tap(rows[i], &event, "q", false);
    }
}

// An escape byte is the Escape key if no further bytes arrive for a while.
static void test_lone_escape_is_a_key(void **state) {
    TerminalInput input = {0};
    (void)state;
    send_text(&input, "\033");
    assert_int_equal(terminal_input_next(&input).kind, EVENT_NONE);
    nanosleep(&(struct timespec){.tv_nsec = 200000000}, NULL);
    Event event = terminal_input_next(&input);
    check_tap("escape", &event, "escape", false);
}

static void test_split_sequence_is_decoded(void **state) {
    static const char text[] = "\033[<0;12;5M";
    TerminalInput input = {0};
    (void)state;
    for (size_t i = 0; i + 2 < sizeof text; i++) {
        send(&input, text + i, 1);
        assert_int_equal(terminal_input_next(&input).kind, EVENT_NONE);
    }
    send(&input, "M", 1);
    assert_int_equal(terminal_input_next(&input).kind, EVENT_POINTER);
}

static void check_pointer(TerminalInput *input, const char *text, double x, double y, unsigned buttons) {
    send_text(input, text);
    Event event = terminal_input_next(input);
    assert_claim(text, event.kind == EVENT_POINTER && event.inside);
    assert_number(text, event.x, x);
    assert_number(text, event.y, y);
    assert_claim(text, event.buttons == buttons);
}

static void test_mouse_sequences_give_pointer(void **state) {
    TerminalInput input = {0};
    (void)state;
    check_pointer(&input, "\033[<35;1;1M", 0.5, 0.5, 0); // pointer motion without a button
    check_pointer(&input, "\033[<0;80;24M", 79.5, 23.5, PETRI_BUTTON_LEFT);
    check_pointer(&input, "\033[<32;10;4M", 9.5, 3.5, PETRI_BUTTON_LEFT); // pointer motion with a button
    check_pointer(&input, "\033[<2;10;4M", 9.5, 3.5, PETRI_BUTTON_LEFT | PETRI_BUTTON_RIGHT);
    check_pointer(&input, "\033[<0;10;4m", 9.5, 3.5, PETRI_BUTTON_RIGHT);
    check_pointer(&input, "\033[<18;10;4m", 9.5, 3.5, 0); // button release with Control
    send_text(&input, "\033[<64;10;4M\033[<0;0;0M\033[<M\033[<99999999999999999999;1;1M");
    assert_int_equal(terminal_input_next(&input).kind, EVENT_NONE); // the wheel and invalid sequences are ignored
    send_text(&input, "\033[<1;2;3M\033[O");
    assert_int_equal(terminal_input_next(&input).buttons, PETRI_BUTTON_MIDDLE);
    assert_int_equal(terminal_input_next(&input).kind, EVENT_FOCUS_LOST);
    check_pointer(&input, "\033[<35;2;3M", 1.5, 2.5, 0);
}

// A sequence without a final byte does not overflow the buffer, and later keys are decoded.
static void test_endless_sequence_is_bounded(void **state) {
    char text[200];
    TerminalInput input = {0};
    (void)state;
    memset(text, ';', sizeof text);
    send_text(&input, "\033[");
    for (int i = 0; i < 10; i++) {
        send(&input, text, sizeof text);
        assert_true(input.count <= sizeof input.bytes);
        if (i == 0)
            assert_int_equal(terminal_input_next(&input).kind, EVENT_NONE);
    }
    while (terminal_input_next(&input).kind != EVENT_NONE)
        ;
    send_text(&input, "q");
    Event event = terminal_input_next(&input);
    check_tap("key after the sequence", &event, "q", false);
}

static void test_end_of_input_closes(void **state) {
    TerminalInput input = {0};
    (void)state;
    send(&input, "", 0);
    assert_true(input.closed);
}

TEST_GROUP(src_terminal_keys) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sequence_gives_key),           cmocka_unit_test(test_unknown_sequence_is_ignored),
        cmocka_unit_test(test_lone_escape_is_a_key),         cmocka_unit_test(test_split_sequence_is_decoded),
        cmocka_unit_test(test_mouse_sequences_give_pointer), cmocka_unit_test(test_endless_sequence_is_bounded),
        cmocka_unit_test(test_end_of_input_closes),
    };
    return cmocka_run_group_tests_name("terminal_keys", tests, NULL, NULL);
}
