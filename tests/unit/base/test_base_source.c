// test_base_source.c: line ends, positions and paths.
#include "base/source.h"
#include "check.h"

static Arena arena;

static int setup(void **state) {
    (void)state;
    arena_init(&arena, "test", SIZE_MAX);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    arena_free(&arena);
    return 0;
}

static const Source *source_of(Str text) {
    return source_new(&arena, STR("some/dir/a.fl"), STR("/abs/some/dir/a.fl"), text);
}

static void test_line_ends_are_unified(void **state) {
    (void)state;
    static const struct {
        Str text;
        const char *normal;
        uint32_t lines;
    } rows[] = {
        {{"", 0}, "\n", 1},
        {{NULL, 0}, "\n", 1},
        {{"a", 1}, "a\n", 1},
        {{"a\n", 2}, "a\n", 1},
        {{"a\nb", 3}, "a\nb\n", 2},
        {{"a\r\nb\r\n", 6}, "a\nb\n", 2},
        {{"a\rb\r", 4}, "a\nb\n", 2},
        {{"a\r\r\nb", 5}, "a\n\nb\n", 3},
        {{"a\n\rb", 4}, "a\n\nb\n", 3},
        {{"\r", 1}, "\n", 1},
        {{"\n\n\n", 3}, "\n\n\n", 3},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        const Source *source = source_of(rows[i].text);
        assert_string_equal(source->text.bytes, rows[i].normal); // the text is NUL-terminated
        assert_int_equal(source->text.len, strlen(rows[i].normal));
        assert_int_equal(source->line_count, rows[i].lines);
    }
}

static void test_offsets_are_located(void **state) {
    (void)state;
    const Source *source = source_of(STR("let é=1\n\n\t😀x\nlast"));
    static const struct {
        uint32_t offset, line, column;
        const char *text;
    } rows[] = {
        {0, 1, 1, "let é=1"},       {4, 1, 5, "let é=1"}, {6, 1, 6, "let é=1"},
        {8, 1, 8, "let é=1"},       {9, 2, 1, ""},        {10, 3, 1, "\t😀x"},
        {11, 3, 2, "\t😀x"},         {15, 3, 3, "\t😀x"},   {16, 3, 4, "\t😀x"},
        {17, 4, 1, "last"},         {20, 4, 4, "last"},   {21, 4, 5, "last"},
        {22, 4, 5, "last"}, // an offset after the end is treated as the end
        {4000000000, 4, 5, "last"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        SourcePosition place = source_locate(source, rows[i].offset);
        assert_int_equal(place.line, rows[i].line);
        assert_int_equal(place.column, rows[i].column);
        assert_text("line", str_to_c(&arena, place.text), rows[i].text);
    }
}

// Compares the position of every offset in a text of many lines with the result of counting.
static void test_positions_match_counting(void **state) {
    (void)state;
    Text text = text_new(&arena);
    for (int i = 0; i < 300; i++) {
        for (int k = 0; k < i % 7; k++)
            text_add_char(&text, 'x');
        text_add_char(&text, '\n');
    }
    const Source *source = source_of(text_str(&text));
    uint32_t line = 1, column = 1;
    for (uint32_t at = 0; at < source->text.len; at++) {
        SourcePosition place = source_locate(source, at);
        assert_int_equal(place.line, line);
        assert_int_equal(place.column, column);
        column = source->text.bytes[at] == '\n' ? 1 : column + 1;
        line += source->text.bytes[at] == '\n';
    }
}

static void test_names_are_copied(void **state) {
    (void)state;
    char name[] = "some/dir/a.fl", text[] = "a\n";
    const Source *source = source_new(&arena, str_from(name), str_from(name), str_from(text));
    memset(name, 'x', sizeof name - 1); // the source must have copied its name and text
    memset(text, 'x', sizeof text - 1);
    assert_true(str_equal(source->name, STR("some/dir/a.fl")));
    assert_true(str_equal(source->directory, STR("some/dir/")));
    assert_true(str_equal(source->text, STR("a\n")));
}

static void test_paths_are_split_and_joined(void **state) {
    (void)state;
    static const struct {
        const char *path, *directory;
    } directories[] = {{"a.fl", ""}, {"x/a.fl", "x/"}, {"/a.fl", "/"}, {"x/y/", "x/y/"}, {"", ""}};
    for (size_t i = 0; i < COUNT_OF(directories); i++)
        assert_text(directories[i].path, str_to_c(&arena, path_directory(str_from(directories[i].path))),
                    directories[i].directory);
    static const struct {
        const char *directory, *path, *joined;
    } joins[] = {
        {"", "a.fl", "a.fl"},           {"x/", "a.fl", "x/a.fl"}, {"x", "a.fl", "x/a.fl"},
        {"x/", "/a.fl", "/a.fl"},       {"/", "a.fl", "/a.fl"},   {"x/", "../a.fl", "x/../a.fl"},
        {"", "/abs/a.fl", "/abs/a.fl"},
    };
    for (size_t i = 0; i < COUNT_OF(joins); i++)
        assert_text(joins[i].path,
                    str_to_c(&arena, path_join(&arena, str_from(joins[i].directory), str_from(joins[i].path))),
                    joins[i].joined);
}

TEST_GROUP(base_source) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_line_ends_are_unified, setup, teardown),
        cmocka_unit_test_setup_teardown(test_offsets_are_located, setup, teardown),
        cmocka_unit_test_setup_teardown(test_positions_match_counting, setup, teardown),
        cmocka_unit_test_setup_teardown(test_names_are_copied, setup, teardown),
        cmocka_unit_test_setup_teardown(test_paths_are_split_and_joined, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
