// test_syntax_layout.c: indentation, newlines, comments and continuation (language.md L2.3, L2.10, L2.11).
#include "parsing.h"

#define SUITE_B "(append (node a) (suite (node b)))"
#define TWO "(node a) (node b)"

static void test_indentation_makes_blocks(void **state) {
    World *world = *state;
    static const char *const rows[][2] = {
        {"", ""},
        {"\n\n", ""},
        {"-- only a comment", ""},
        {"   \t  \n\t\n", ""},
        {"!a\n!b", TWO},
        {"!a\r\n!b\r", TWO},
        // A tab counts as eight columns wherever it is; there are no tab stops.
        {"!a\n\t!b\n", SUITE_B},
        {"!a\n \t!b\n         !b\n", "(append (node a) (suite (node b) (node b)))"},
        {"!a\n  \t!b\n          !b\n", "(append (node a) (suite (node b) (node b)))"},
        {"!a\n\t  !b\n  \t!b\n", "(append (node a) (suite (node b) (node b)))"},
        {"!a\n !b\n\t!c\n", "(append (node a) (suite (append (node b) (suite (node c)))))"},
        // Blank lines and comments may have any indentation.
        {"!a\n\n      \n-- c\n        -- d\n    !b\n", SUITE_B},
        {"!a\n    !b\n-- c\n    !c\n", "(append (node a) (suite (node b) (node c)))"},
        {"!a -- c\n!b -- d", TWO},
        {"!a\n    !b\n        !c\n!d\n", "(append (node a) (suite (append (node b) (suite (node c))))) (node d)"},
        // The indentation of a line must match that of an enclosing line.
        {"!a\n    !b\n  !c\n", "rejected"},
        {"!a\n\t!b\n    !c\n", "rejected"},
        {"3\n    !b\n", "(append 3 (suite (node b)))"},
        {"let x=1\n!a\n    !b\n  !c\n", "rejected"},
        // The first line may be indented by any amount, unless a blank or comment line precedes it.
        {"   !a\n!b\n", TWO},
        {"\n   !a\n", "rejected"},
        {"-- c\n !a\n", "rejected"},
        // Newlines are ignored in round parentheses, but not elsewhere.
        {"(!a\n  ;\n!b)\n", "(compose (node a) (node b))"},
        {"f(1,\n -- c\n2)\n", "(call f 1 2)"},
        {"v[(1\n)]\n", "(index v 1)"},
        {"(v[\n1])\n", "(index v 1)"},
        {"v[\n1]\n", "rejected"},
        {"v[1\n]\n", "rejected"},
        {"!a x=(1\n2)\n", "rejected"},
        // A backslash at the end of a line joins it with the next.
        {"!a x=1+\\\n2\n", "(decorate (node a) (attr x (+ 1 2)))"},
        {"!a \\\n    x=1\n", "(decorate (node a) (attr x 1))"},
        {"!a \\ \n", "rejected"},
        {"\\\n!a\n", "(node a)"},
        // Two dashes start a comment, except in strings.
        {"5--3\n", "5"},
        {"5- -3\n", "(- 5 (neg 3))"},
        {"'--'\n", "'--'"},
        // A hashbang is recognised only at the start of the script.
        {"#!/usr/bin/env petri\n!a\n", "(node a)"},
        {"  #! x\n    !a\n!b\n", TWO},
        {"#!only", ""},
        {"  #!only", ""},
        {"!a\n#!b\n", "rejected"},
        {"-- c\n#!b\n", "rejected"},
        // Form feeds and no-break spaces are not white space.
        {"!a\f\n", "rejected"},
        {"!a\u00a0x=1\n", "rejected"},
        // Statements across lines.
        {"!a <<\n!b\n", "(append (node a) (node b))"},
        {"!a <<\n    !b\n", "rejected"},
        {"!a <<\n", "rejected"},
        {"!a << !b\n    !c\n", "(append (node a) (append (node b) (suite (node c))))"},
        {"if x\n    !a\n\nelse\n    !b\n", "(if x (suite (node a)) (suite (node b)))"},
        {"let x=1\n    y=2 z=3\n    w=4\n",
         "(let (binding (names x) 1) (binding (names y) 2) (binding (names z) 3) (binding (names w) 4))"},
        {"let x=1\n    y=2\n  z=3\n", "rejected"},
        {"let x=\n    1\n    2\n", "(let (binding (names x) (suite 1 2)))"},
        {"let x=1\n    !a\n", "rejected"},
        {"if x\n!a\n", "rejected"},
        {"func f()\n", "rejected"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_text(rows[i][0], shape(world, rows[i][0]), rows[i][1]);
}

// A NUL byte is an invalid token. The scanner never reads beyond the end of the text.
static void test_nul_bytes_are_rejected(void **state) {
    World *world = *state;
    static const Str rejected[] = {{"\0", 1}, {"!a\0\n", 4}, {"#!\0\n!a\n", 7}, {"#!a\0", 4}, {"!a -- \0\n\0", 9}};
    assert_false(accepts_str(world, rejected[0]));
    assert_false(accepts_str(world, rejected[1]));
    assert_true(accepts_str(world, rejected[2])); // valid, because the rest of a hashbang line is ignored
    assert_true(accepts_str(world, rejected[3]));
    assert_false(accepts_str(world, rejected[4]));
    assert_true(accepts_str(world, STR("-- \0 comment\n!a\n")));
    assert_true(accepts_str(world, STR("'a\0b'\n")));
}

static void nested(Text *text, const char *open, int count, const char *close) {
    text->len = 0;
    for (int i = 0; i < count; i++)
        text_add_c(text, open);
    text_add_c(text, "1");
    for (int i = 0; i < count; i++)
        text_add_c(text, close);
    text_add_c(text, "\n");
}

static void test_deep_parentheses_are_rejected(void **state) {
    World *world = *state;
    Text text = text_new(&world->arena);
    nested(&text, "(", 1000, ")");
    assert_true(accepts_str(world, text_str(&text)));
    nested(&text, "(", 1001, ")");
    assert_text("1001", complaints(world, text_str(&text)), "1:1001: parentheses nested too deeply: the limit is 1000");
    nested(&text, "(", 100000, ")");
    assert_text("100000", complaints(world, text_str(&text)),
                "1:1001: parentheses nested too deeply: the limit is 1000");
    nested(&text, "(", 100000, "");
    assert_text("unclosed", complaints(world, text_str(&text)),
                "1:1001: parentheses nested too deeply: the limit is 1000");
}

static void indented(Text *text, int levels) {
    text->len = 0;
    for (int level = 0; level <= levels; level++) {
        for (int i = 0; i < level; i++)
            text_add_char(text, ' ');
        text_add_c(text, "!a\n");
    }
}

static void test_deep_indentation_is_rejected(void **state) {
    World *world = *state;
    Text text = text_new(&world->arena);
    indented(&text, 999);
    const char *found = complaints(world, text_str(&text));
    // 1000 nested suites give a tree of height 2000.
    assert_text("999", found, "");
    indented(&text, 5000);
    found = complaints(world, text_str(&text));
    assert_null(strchr(found, '\n')); // only one error is reported
    assert_non_null(strstr(found, "the limit is"));
}

// Other nesting is limited by the height of the tree. Exceeding the limit gives an error, never a crash.
static void test_high_trees_are_rejected(void **state) {
    World *world = *state;
    static const char *const rows[][2] = {{"- ", ""},  {"not ", ""},     {"$", ""},
                                          {"v[", "]"}, {"func(x) ", ""}, {"x if ", ""}};
    Text text = text_new(&world->arena);
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        nested(&text, rows[i][0], i == 5 ? 1 : 900, rows[i][1]);
        assert_claim(rows[i][0], accepts_str(world, text_str(&text)));
        if (i == 5)
            continue;
        nested(&text, rows[i][0], 250000, rows[i][1]);
        const char *found = complaints(world, text_str(&text));
        assert_claim(rows[i][0], strstr(found, "nested too deeply: the limit is 2000 levels") != NULL);
        assert_claim(rows[i][0], strchr(found, '\n') == NULL);
    }
    // The error is at the innermost expression that is too high: 2000 signs and a number have height 2001.
    nested(&text, "+", 3000, "");
    assert_text("3000 signs", complaints(world, text_str(&text)),
                "1:1001: nested too deeply: the limit is 2000 levels");
    // A long vector gives a low tree; a long sum gives a high one.
    text.len = 0;
    for (int i = 0; i < 50000; i++)
        text_add_c(&text, "1;");
    text_add_c(&text, "1\n");
    assert_true(accepts_str(world, text_str(&text)));
    for (size_t i = 0; i < text.len; i++)
        if (text.bytes[i] == ';')
            text.bytes[i] = '+';
    assert_non_null(strstr(complaints(world, text_str(&text)), "nested too deeply"));
}

TEST_GROUP(syntax_layout) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_indentation_makes_blocks),     WORLD_TEST(test_deep_parentheses_are_rejected),
        WORLD_TEST(test_deep_indentation_is_rejected), WORLD_TEST(test_high_trees_are_rejected),
        WORLD_TEST(test_nul_bytes_are_rejected), // runs last, because the tested bug was a read out of bounds
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
