// test_src_golden.c: tests of the comparison of recorded output: src/golden/golden_line.c and golden_compare.c.
#include "check.h"
#include "golden/golden.h"

static bool same(const char *expected, const char *got, double tolerance) {
    LineDifference where;
    return line_same(str_from(expected), str_from(got), tolerance, &where);
}

static void test_lines_are_compared_by_token(void **state) {
    (void)state;
    assert_true(same("!a x=1", "!a x=1", 0));
    assert_true(same("!a  x = 1", "!a x=1", 0));  // blanks between tokens do not matter
    assert_false(same("  !a x=1", " !a x=1", 0)); // the indentation does
    assert_true(same("!a x=1.50", "!a x=1.5", 0));
    assert_true(same("!a x=-0", "!a x=0", 0));
    assert_true(same("!a x=nan y=inf", "!a x=nan  y=inf", 0));
    assert_false(same("!a x=nan", "!a x=1", 0));
    assert_false(same("!a x=inf", "!a x=-inf", 0));
    assert_false(same("!a x=0x10", "!a x=16", 0)); // a form that petri does not print is a word
    assert_false(same("!a x=1", "!a x=1 y=2", 0));
    assert_false(same("!a x=1", "!b x=1", 0));
    assert_false(same("!a x=1", "!a x='1'", 0));
}

static void test_strings_are_compared_by_contents(void **state) {
    (void)state;
    assert_true(same("'red'", "\"red\"", 0));
    assert_true(same("'it\\'s'", "\"it's\"", 0));
    assert_true(same("'\\n\\t\\r'", "\"\\x0a\\x09\\x0d\"", 0));
    assert_true(same("'\\u00e4\\U0001f600'", "'ä😀'", 0));
    assert_false(same("'red'", "'rot'", 0));
    assert_false(same("'unclosed", "'unclosed'x", 0));
}

static void test_tolerance_is_relative_to_the_largest_number(void **state) {
    (void)state;
    assert_true(same("x=1000;1", "x=1000;1.0009", 1e-6));
    assert_false(same("x=1000;1", "x=1000;1.0011", 1e-6));
    assert_true(same("x=0", "x=1e-7", 1e-6)); // at least relative to 1
    assert_false(same("x=0", "x=1e-7", 0));
    assert_false(same("x=nan", "x=0", 1));
    assert_false(same("$(:c;1) = 2", "$(:c;1.0000001) = 2", 1e-6)); // keys are exact
    assert_true(same("$(:c;1) = 2", "$(:c;1) = 2.0000001", 1e-6));
    assert_false(same("= 1e99", "= 1.0e99", 1)); // hashes are text
    LineDifference where;
    assert_false(line_same(str_from("a=1 b=5 c=2"), str_from("a=1.1 b=7 c=2"), 1e-3, &where));
    assert_int_equal(where.expected_at, 6); // the largest difference
    assert_int_equal(where.got_at, 8);
}

// Compares output with a golden of the given tolerance and limits. Returns the error text, "" if they agree.
static const char *compare(Golden *golden, const char *recorded, const char *output) {
    static char text[600];
    Text got = {0};
    Result result = {0};
    text_add_c(&golden->text, recorded);
    text_add_c(&got, output);
    golden->body_line = 1;
    bool agree = golden_compare(golden, &got, &result);
    assert_int_equal(agree, result.error_text.len == 0);
    text[0] = '\0';
    if (!agree)
        snprintf(text, sizeof text, "line %u: %s", (unsigned)result.line, result.error_text.bytes);
    text_free(&golden->text);
    text_free(&got);
    text_free(&result.error_text);
    text_free(&result.details);
    return text;
}

static void test_logs_are_compared_as_sets(void **state) {
    (void)state;
    Golden golden = {.horizon = INT64_MAX, .strict = INT64_MAX};
    assert_string_equal(compare(&golden, "@0\n!a\n> one\n> two\n", "@0\n> two\n> one\n!a\n"), "");
    assert_string_equal(compare(&golden, "@0\n> one\n", "@0\n> one\n> one\n"),
                        "line 3: frame 0: expected nothing more, got > one");
    assert_string_equal(compare(&golden, "@3\n> one\n> two\n", "@3\n> two\n"),
                        "line 2: frame 3: expected > one, got nothing");
    assert_string_equal(compare(&golden, "> one\n  more\n", "> one\n  less\n"),
                        "line 1: frame 0: expected > one\\n  more, got > one\\n  less");
}

static void test_errors_are_compared_only_if_recorded(void **state) {
    (void)state;
    Golden golden = {.horizon = INT64_MAX, .strict = INT64_MAX};
    assert_string_equal(compare(&golden, "@0\n!a\n", "@0\n!a\n? error\n"), "");
    assert_string_equal(compare(&golden, "@0\n? one\n", "@0\n? two\n"), "line 2: frame 0: expected ? one, got ? two");
}

static void test_frames_after_the_horizon_are_not_compared(void **state) {
    (void)state;
    Golden golden = {.tolerance = 1e-9, .strict = 1, .horizon = 2};
    static const char recorded[] = "@1\nx=1\n@2\nx=1\n@3\nx=1\n";
    assert_string_equal(compare(&golden, recorded, "@1\nx=1\n@2\nx=1.00005\n@3\nx=9\n"), "");
    assert_string_equal(compare(&golden, recorded, "@1\nx=1.00005\n@2\nx=1\n@3\nx=1\n"),
                        "line 2: frame 1: expected x=1, got x=1.00005");
    assert_string_equal(compare(&golden, recorded, "@1\nx=1\n@2\nx=1.001\n@3\nx=1\n"),
                        "line 4: frame 2: expected x=1, got x=1.001");
    golden = (Golden){.strict = 1, .horizon = 2}; // without a tolerance, the horizon does not matter
    assert_string_equal(compare(&golden, recorded, "@1\nx=1\n@2\nx=1\n@3\nx=9\n"),
                        "line 6: frame 3: expected x=1, got x=9");
    assert_string_equal(compare(&golden, recorded, "@1\nx=1\n@2\nx=1\n"), "line 5: frame 3: expected @3, got nothing");
}

static void test_long_lines_are_shortened_at_characters(void **state) {
    (void)state;
    Golden golden = {.horizon = INT64_MAX, .strict = INT64_MAX};
    char expected[400] = "", got[400] = "";
    for (int i = 0; i < 60; i++) {
        strcat(expected, i == 50 ? "a" : "ä");
        strcat(got, i == 50 ? "b" : "ä");
    }
    strcat(expected, " x\n");
    strcat(got, " x\n");
    assert_string_equal(compare(&golden, expected, got) + strlen("line 1: frame 0: "),
                        "expected ääääääääääääääääääääääääääääääääääääääääääääääääää..., got "
                        "ääääääääääääääääääääääääääääääääääääääääääääääääää...");
    snprintf(expected, sizeof expected, "%s%060d\n", "ääääääääääääääääääää 1;2;3;4;5;", 7);
    snprintf(got, sizeof got, "%s%060d\n", "ääääääääääääääääääää 1;2;3;4;5;", 8);
    const char *text = compare(&golden, expected, got);
    assert_non_null(strstr(text, "expected ...ää"));
    assert_non_null(strstr(text, "007, got ...ää"));
}

TEST_GROUP(src_golden) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines_are_compared_by_token),
        cmocka_unit_test(test_strings_are_compared_by_contents),
        cmocka_unit_test(test_tolerance_is_relative_to_the_largest_number),
        cmocka_unit_test(test_logs_are_compared_as_sets),
        cmocka_unit_test(test_errors_are_compared_only_if_recorded),
        cmocka_unit_test(test_frames_after_the_horizon_are_not_compared),
        cmocka_unit_test(test_long_lines_are_shortened_at_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
