// test_src_overlay_text.c: tests that overlay texts are plain, valid UTF-8 and fit into the picture.
#include "check.h"
#include "view/overlay_text.h"

static void test_set_removes_control_sequences(void **state) {
    static const struct {
        const char *from;
        const char *wanted;
    } rows[] = {
        {"", ""},
        {"plain", "plain"},
        {"two\nlines\n\n", "two\nlines"},
        {"a\tb", "a b"},
        {"\033[1;31merror:\033[0m text", "error: text"},
        {"\033]0;title\a", "]0;title"},
        {"bell\a back\b del\177 cr\r", "bell back del cr"},
        {"Zelle \xC3\xA4 \xE2\x80\xA6 \xF0\x9F\x8C\x8D", "Zelle \xC3\xA4 \xE2\x80\xA6 \xF0\x9F\x8C\x8D"},
        {"\xC2\x9B"
         "31m",
         "31m"},                        // a control character of two bytes
        {"\xFF\xC3+\xE2\x82", "??+??"}, // invalid UTF-8
        {"\xED\xA0\x80 \xC0\x80 \xF4\x90\x80\x80", "???"
                                                   " ?? ?"
                                                   "???"}, // surrogate, overlong, beyond U+10FFFF
        {"\033", ""},
        {"\033[", ""},
        {"\033[31", ""},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        char text[100] = "before";
        assert_claim(rows[i].from, overlay_set(text, sizeof text, rows[i].from));
        assert_text(rows[i].from, text, rows[i].wanted);
        assert_claim(rows[i].from, !overlay_set(text, sizeof text, rows[i].from)); // unchanged text
    }
}

static void test_set_truncates_between_characters(void **state) {
    char text[8] = "";
    (void)state;
    assert_true(overlay_set(text, sizeof text, "0123456789"));
    assert_string_equal(text, "0123456");
    assert_true(overlay_set(text, sizeof text, "01234\xE2\x80\xA6 more")); // the text is not cut within a character
    assert_string_equal(text, "01234");
}

static void test_fit_wraps_and_truncates_lines(void **state) {
    static const struct {
        const char *text;
        int columns;
        const char *wanted;
    } rows[] = {
        {"", 10, ""},
        {"short", 10, "short"},
        {"exactly 10", 10, "exactly 10"},
        {"one two three four", 10, "one two\nthree four"},
        {"one two\nthree", 10, "one two\nthree"},
        {"unbreakableword", 10, "unbreakabl\neword"},
        {"    !rect size=100;100", 10, "    !rect…"},
        {"    ^~~~", 10, "    ^~~~"},
        {"a.fl:1:2: error: what\n    !rect size=100;100\n    ^", 10, "a.fl:1:2:\nerror:\nwhat\n    !rect…\n    ^"},
        {"\xC3\xA4\xC3\xB6\xC3\xBC \xC3\xA4\xC3\xB6\xC3\xBC", 5, "\xC3\xA4\xC3\xB6\xC3\xBC\n\xC3\xA4\xC3\xB6\xC3\xBC"},
        {"abc", -5, "ab\nc"}, // a width below 1
        {"a\n\nb", 10, "a\n\nb"},
    };
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        char out[200];
        overlay_fit(out, sizeof out, rows[i].text, rows[i].columns);
        assert_text(rows[i].text, out, rows[i].wanted);
    }
}

static void test_fit_never_exceeds_buffer(void **state) {
    (void)state;
    for (size_t size = 1; size < 40; size++) {
        char out[40];
        memset(out, '#', sizeof out);
        overlay_fit(out, size, "one two \xE2\x80\xA6 three\n    four five six seven", 9);
        assert_true(strlen(out) < size);
    }
}

static void test_lines_and_columns_are_counted(void **state) {
    (void)state;
    assert_int_equal(overlay_lines(""), 0);
    assert_int_equal(overlay_lines("a"), 1);
    assert_int_equal(overlay_lines("a\nb\n\nc"), 4);
    assert_int_equal(overlay_columns(""), 0);
    assert_int_equal(overlay_columns("a\n\xC3\xA4\xE2\x80\xA6 b\nc"), 4);
}

TEST_GROUP(src_overlay_text) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_set_removes_control_sequences), cmocka_unit_test(test_set_truncates_between_characters),
        cmocka_unit_test(test_fit_wraps_and_truncates_lines), cmocka_unit_test(test_fit_never_exceeds_buffer),
        cmocka_unit_test(test_lines_and_columns_are_counted),
    };
    return cmocka_run_group_tests_name("overlay_text", tests, NULL, NULL);
}
