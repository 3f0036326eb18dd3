// test_base_diag.c: storage and formatting of diagnostics (cli.md 3.5).
#include "base/diag.h"
#include "check.h"

static Arena arena;
static DiagSink sink;

static int setup(void **state) {
    (void)state;
    arena_init(&arena, "test", SIZE_MAX);
    sink = diag_sink_new(&arena, 100);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    diag_sink_free(&sink);
    arena_free(&arena);
    return 0;
}

#define DIAG_TEST(function) cmocka_unit_test_setup_teardown(function, setup, teardown)

static const Source *source_of(const char *text) {
    return source_new(&arena, STR("a.fl"), STR("a.fl"), str_from(text));
}

static const char *formatted(const Diag *diag, bool colour) {
    Text text = text_new(&arena);
    diag_format(&text, diag, colour);
    return str_to_c(&arena, text_str(&text));
}

static void test_caret_marks_span(void **state) {
    (void)state;
    static const struct {
        const char *text;
        Span span;
        const char *wanted;
    } rows[] = {
        {"let x=1", {4, 5}, "a.fl:1:5: error: bad\n    let x=1\n        ^\n"},
        {"let abc=1", {4, 7}, "a.fl:1:5: error: bad\n    let abc=1\n        ^~~\n"},
        {"x\n  yy\n", {4, 6}, "a.fl:2:3: error: bad\n      yy\n      ^~\n"},
        {"é😀ab", {6, 8}, "a.fl:1:3: error: bad\n    é😀ab\n      ^~\n"},       // columns count characters, not bytes
        {"\t\tab", {2, 4}, "a.fl:1:3: error: bad\n    \t\tab\n    \t\t^~\n"}, // tabs are copied to the caret line
        {"x\ty", {2, 3}, "a.fl:1:3: error: bad\n    x\ty\n     \t^\n"},
        {"ab\ncd", {1, 5}, "a.fl:1:2: error: bad\n    ab\n     ^\n"}, // only the first line is marked
        {"ab\n", {2, 3}, "a.fl:1:3: error: bad\n    ab\n      ^\n"},  // a range that starts at the line break
        {"ab\n", {3, 3}, "a.fl:1:3: error: bad\n    ab\n      ^\n"},  // an empty range at the end of the file
        {"", {0, 0}, "a.fl:1:1: error: bad\n    \n    ^\n"},
        {"a\x1b[31m\x7f\xff", {1, 2}, "a.fl:1:2: error: bad\n    a?[31m??\n     ^\n"}, // control characters
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Diag diag = {.at = {source_of(rows[i].text), rows[i].span}, .text = STR("bad")};
        assert_text(rows[i].text, formatted(&diag, false), rows[i].wanted);
    }
}

// A message may contain any string of the script, and a file name may come from a shared link.
static void test_control_characters_are_replaced(void **state) {
    (void)state;
    const Source *source = source_new(&arena, STR("a\x1b[1m.fl"), STR("a.fl"), str_from("ab"));
    Diag diag = {.at = {source, {1, 2}}, .text = STR("no '\x1b]0;x\x07'"), .hint = STR("did you mean '\xc2\x9b\x7f'?")};
    assert_text("name, text, line and hint", formatted(&diag, false),
                "a?[1m.fl:1:2: error: no '?]0;x?'\n    ab\n     ^\n    did you mean '\?\?'?\n");
}

static void test_level_code_and_hint_are_printed(void **state) {
    (void)state;
    Diag diag = {.level = DIAG_WARNING, .text = STR("odd")};
    assert_text("no location", formatted(&diag, false), "warning: odd\n");
    diag.code = "some-code";
    assert_text("code", formatted(&diag, false), "warning: odd [some-code]\n");
    diag.level = DIAG_NOTE;
    diag.at.source = source_of("x");
    diag.hint = STR("try y");
    assert_text("hint", formatted(&diag, false), "a.fl:1:1: note: odd [some-code]\n    x\n    ^\n    try y\n");
    const char *coloured = formatted(&diag, true);
    assert_non_null(strstr(coloured, "\033[1;36mnote:\033[0m odd"));
    assert_string_equal(coloured + strlen(coloured) - strlen("    try y\n"), "    try y\n");
}

// A very long line is printed only near the caret.
static void test_long_lines_are_shortened(void **state) {
    (void)state;
    static const uint32_t places[] = {0, 10, 59, 60, 61, 5000, 999998};
    enum { LENGTH = 1000000 };
    char *line = arena_alloc(&arena, LENGTH + 1);
    line[LENGTH] = 0;
    for (size_t i = 0; i < COUNT_OF(places); i++) {
        memset(line, 'x', LENGTH);
        line[places[i]] = '?';
        Diag diag = {.at = {source_of(line), {places[i], places[i] + 1}}, .text = STR("bad")};
        const char *text = formatted(&diag, false);
        assert_true(strlen(text) < 500);
        char place[40];
        snprintf(place, sizeof place, "a.fl:1:%u: ", places[i] + 1);
        assert_memory_equal(text, place, strlen(place));
        const char *shown = strchr(text, '\n') + 1, *carets = strchr(shown, '\n') + 1;
        assert_int_equal(shown[strchr(carets, '^') - carets], '?');
    }
}

static bool report_at(const Source *source, uint32_t start, const char *text) {
    return diag_report(&sink, &(Diag){.level = DIAG_ERROR, .at = {source, {start, start + 1}}, .text = str_from(text)});
}

static void test_duplicates_are_stored_once(void **state) {
    (void)state;
    const Source *a = source_of("aaaa"), *b = source_of("bbbb");
    assert_true(report_at(a, 0, "x"));
    assert_false(report_at(a, 0, "x"));
    assert_true(report_at(a, 1, "x"));
    assert_true(report_at(a, 0, "y"));
    assert_true(report_at(b, 0, "x"));
    assert_true(report_at(NULL, 0, "x"));
    for (int i = 0; i < 10; i++)
        assert_false(report_at(b, 0, "x"));
    assert_int_equal(sink.count, 5);
    assert_int_equal(sink.error_count, 5);
    assert_true(str_equal(sink.items[2].text, STR("y"))); // diagnostics are stored in the order of reporting
}

static void test_texts_are_copied(void **state) {
    (void)state;
    char text[] = "text", hint[] = "hint";
    diag_report(&sink, &(Diag){.level = DIAG_WARNING, .text = str_from(text), .hint = str_from(hint)});
    text[0] = hint[0] = 'X';
    assert_true(str_equal(sink.items[0].text, STR("text")));
    assert_true(str_equal(sink.items[0].hint, STR("hint")));
    assert_int_equal(sink.error_count, 0);
}

static void test_diagnostics_beyond_limit_are_counted(void **state) {
    (void)state;
    char text[20];
    for (int i = 0; i < 250; i++) {
        snprintf(text, sizeof text, "text %d", i);
        assert_true(report_at(NULL, 0, text) == (i < 100));
    }
    assert_int_equal(sink.count, 100);
    assert_int_equal(sink.dropped, 150);
}

static void test_one_line_form_names_location(void **state) {
    (void)state;
    Diag diag = {.text = STR("bad")};
    assert_text("no location", str_to_c(&arena, diag_one_line(&arena, &diag)), "bad");
    diag.at.source = source_of("a\nb\n");
    diag.at.span = (Span){2, 3};
    assert_text("location", str_to_c(&arena, diag_one_line(&arena, &diag)), "bad (a.fl:2)");
}

TEST_GROUP(base_diag) {
    const struct CMUnitTest tests[] = {
        DIAG_TEST(test_caret_marks_span),
        DIAG_TEST(test_control_characters_are_replaced),
        DIAG_TEST(test_level_code_and_hint_are_printed),
        DIAG_TEST(test_long_lines_are_shortened),
        DIAG_TEST(test_duplicates_are_stored_once),
        DIAG_TEST(test_texts_are_copied),
        DIAG_TEST(test_diagnostics_beyond_limit_are_counted),
        DIAG_TEST(test_one_line_form_names_location),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
