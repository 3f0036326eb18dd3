// test_value_format.c: conversion of values and trees to text (language.md L18).
#include "value/node.h"
#include "values.h"

static void test_values_are_printed(void **state) {
    World *world = *state;
    static const struct {
        const char *v, *wanted;
    } rows[] = {
        {"null", "null"},
        {"uniform:1", "null"},
        {"1.5;:foo;'hi';!q", "1.5;:foo;'hi';(!q)"},
        {"-0;1e16;1e-5;nan;-inf", "-0;1e+16;1e-05;nan;-inf"},
        {"''", "''"},
        {"'it's'", "\"it's\""},
        {"'say \"x\"'", "'say \"x\"'"},
        {"'it's \"x\"'", "'it\\'s \"x\"'"},
        {"'a\\b'", "'a\\\\b'"},
        {"'\n\r\t\a\x7f'", "'\\n\\r\\t\\x07\\x7f'"},
        {"'é😀'", "'é😀'"},
        {"'\u00a0\u00ad\u2028\ufeff'", "'\\xa0\\xad\\u2028\\ufeff'"},
        {"'\U000e0001'", "'\\U000e0001'"},
        {"'\u0378'", "'\\u0378'"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_text(rows[i].wanted, show(world, read_value(world, rows[i].v)), rows[i].wanted);
    assert_text("NUL", show(world, value_string(&world->arena, STR("a\0b"))), "'a\\x00b'");
    static const Function named = {.name = {"fib", 3}}, anonymous = {.name = {"<anon>", 6}};
    assert_text("function", show(world, value_function(&world->arena, &named)), "(fib)");
    assert_text("function", show(world, value_function(&world->arena, &anonymous)), "(<anon>)");
}

// A number equal to a symbol's value is printed as the symbol only if the symbol is registered.
static void test_registered_symbols_are_printed(void **state) {
    World *world = *state;
    Value v = value_number(symbol_number(STR("later")));
    assert_text("not registered", show(world, v)[0] == '-' ? "number" : "symbol", "number");
    symbol_register(&world->symbols, STR("later"));
    assert_text("registered", show(world, v), ":later");
}

static const Node *sample_node(World *world) {
    Arena *arena = &world->arena;
    const Node *b = node_add_tag(arena, node_new(arena, name_of(world, "b")), name_of(world, "z"));
    b = node_add_tag(arena, b, name_of(world, "b"));
    b = node_set_attrs(arena, b, &(Attr){name_of(world, "n"), read_value(world, "1e22;0.1")}, 1);
    const Node *a = node_new(arena, name_of(world, "a"));
    Attr attrs[] = {{name_of(world, "x"), read_value(world, "1;:k")}, {name_of(world, "q"), read_value(world, "!q")}};
    a = node_set_attrs(arena, a, attrs, 2);
    a = node_append(arena, a, value_node(arena, b));
    return node_append(arena, a, value_node(arena, a));
}

static void test_trees_are_printed(void **state) {
    World *world = *state;
    Text text = text_new(&world->arena);
    format_tree(&text, &world->symbols, sample_node(world), 0, NULL, NULL);
    assert_text("tree", text_c(&text),
                "!a x=1;:k q=(!q)\n"
                "    !b #b #z n=1e+22;0.1\n"
                "    !a x=1;:k q=(!q)\n"
                "        !b #b #z n=1e+22;0.1\n");
    text.len = 0;
    format_tree(&text, &world->symbols, node_new(&world->arena, name_of(world, "c")), 2, NULL, NULL);
    assert_text("depth", text_c(&text), "        !c\n");
}

static const char *debug(World *world, Value v) {
    Text text = text_new(&world->arena);
    format_debug(&text, &world->symbols, v);
    return text_c(&text);
}

static void test_debug_text(void **state) {
    World *world = *state;
    static const struct {
        const char *v, *wanted;
    } rows[] = {
        {"null", "null"},
        {"0.3333333333333333;:a;'hi';1e20", "0.333333333;:a;'hi';1e+20"},
        {"-0;1", "0;1"}, // in a numeric vector -0 is printed as 0
        {"-0", "0"},
        {"-0;'a'", "-0;'a'"}, // in a mixed vector, -0 is printed as -0
        {"1234567890", "1.23456789e+09"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_text(rows[i].v, debug(world, read_value(world, rows[i].v)), rows[i].wanted);
    assert_text("node", debug(world, value_node(&world->arena, sample_node(world))),
                "(!a x=1;:k q=(!q)\n"
                " !b #b #z n=1e+22;0.1\n"
                " !a x=1;:k q=(!q)\n"
                "  !b #b #z n=1e+22;0.1)");
}

// L18.4: symbols by name, then numbers, then strings. A prefix comes before longer keys.
static void test_keys_are_ordered(void **state) {
    World *world = *state;
    static const char *const ascending[] = {
        "null",  ":B",    ":a",     ":a;:a", ":a;:clock", ":a;-1", ":a;-0", ":a;0",  ":a;0;:velocity", ":a;2",
        ":a;10", ":a;''", ":a;'x'", ":b",    ":é",        "-inf",  "-1.5",  "-0",    "-0;1",           "0",
        "0;:a",  "7",     "inf",    "''",    "'10'",      "'2'",   "'a'",   "'a';1", "'ab'",           "'é'",
    };
    for (size_t i = 0; i < COUNT_OF(ascending); i++)
        for (size_t k = 0; k < COUNT_OF(ascending); k++) {
            int order =
                format_key_compare(&world->symbols, read_value(world, ascending[i]), read_value(world, ascending[k]));
            assert_claim(ascending[i], order == (i > k) - (i < k));
        }
}

TEST_GROUP(value_format) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_values_are_printed), WORLD_TEST(test_registered_symbols_are_printed),
        WORLD_TEST(test_trees_are_printed),  WORLD_TEST(test_debug_text),
        WORLD_TEST(test_keys_are_ordered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
