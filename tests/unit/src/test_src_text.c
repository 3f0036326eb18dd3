// test_src_text.c: tests of messages and tables: src/cli/message.c and text_table.c.
#include "captured.h"
#include "cli/cli.h"
#include "cli/text_table.h"

static void test_messages_contain_no_control_characters(void **state) {
    (void)state;
    Captured captured;
    captured_begin(&captured, STDERR_FILENO);
    message("bad \x1b[31mname\x7f\t\xc2\x9b ä\xff");
    captured_end(&captured);
    assert_string_equal(captured.text, "petri: bad ?[31mname?\t? ä?\n");
}

static void test_long_messages_are_one_shortened_line(void **state) {
    (void)state;
    Captured captured;
    char text[3000];
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    captured_begin(&captured, STDERR_FILENO);
    message("%s", text);
    message("next");
    captured_end(&captured);
    const char *end = strchr(captured.text, '\n');
    assert_in_range(end - captured.text, 900, 1023);
    assert_string_equal(end, "\npetri: next\n");
}

static void test_columns_are_as_wide_as_their_cells(void **state) {
    (void)state;
    SCOPED_TEXT_TABLE table = text_table_new(3);
    SCOPED_TEXT text = {0};
    static const char *const cells[] = {"a", "ä€", "x", "long", "", "y"};
    for (size_t i = 0; i < COUNT_OF(cells); i++)
        text_table_add(&table, cells[i]);
    table_text(&table, &text);
    assert_string_equal(text.bytes, "a     ä€  x\nlong      y\n");
}

TEST_GROUP(src_text) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_messages_contain_no_control_characters),
        cmocka_unit_test(test_long_messages_are_one_shortened_line),
        cmocka_unit_test(test_columns_are_as_wide_as_their_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
