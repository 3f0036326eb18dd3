// test_value_vector.c: construction, truth, equality, order and indexing of vectors (language.md L4 to L6).
#include "value/node.h"
#include "value/stream.h"
#include "values.h"

static void test_composition_concatenates_parts(void **state) {
    World *world = *state;
    static const struct {
        const char *parts[4];
        const char *wanted;
        ValueKind kind;
    } rows[] = {
        {{"null"}, "null", VALUE_NUMBERS},
        {{"1"}, "1", VALUE_NUMBERS},
        {{"1;2", "null", "3"}, "1;2;3", VALUE_NUMBERS},
        {{"null", "'a'", "null"}, "'a'", VALUE_MIXED},
        {{"1;2", "'a'", "3"}, "1;2;'a';3", VALUE_MIXED},
        {{"'a'", "1;2"}, "'a';1;2", VALUE_MIXED},
        {{"!a", "!b", ":x"}, "(!a);(!b);:x", VALUE_MIXED},
        {{"uniform:5"}, "null", VALUE_STREAM},          // a stream is kept if it is the only part
        {{"null", "uniform:5"}, "null", VALUE_NUMBERS}, // null also counts as a part
        {{"uniform:5", "null"}, "null", VALUE_NUMBERS},
        {{"uniform:5", "1"}, "1", VALUE_NUMBERS},
        {{"1", "uniform:5"}, "1", VALUE_NUMBERS},
        {{"uniform:5", "beta:5"}, "null", VALUE_NUMBERS},
        {{"'a'", "normal:5"}, "'a'", VALUE_MIXED},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Vector vector = vector_new(&world->arena);
        for (int k = 0; k < 4 && rows[i].parts[k]; k++)
            vector_add(&vector, read_value(world, rows[i].parts[k]));
        Value v = vector_finish(&vector);
        assert_text(rows[i].wanted, show(world, v), rows[i].wanted);
        assert_int_equal(v.kind, rows[i].kind);
    }
}

// Numbers followed by a string: at any length, the builder changes to a mixed vector.
static void test_builder_turns_mixed(void **state) {
    World *world = *state;
    for (uint32_t before = 0; before < 40; before++) {
        Vector vector = vector_new(&world->arena);
        for (uint32_t i = 0; i < before; i++)
            vector_add_number(&vector, i);
        String s = {STR("s")};
        vector_add_item(&vector, (Item){ITEM_STRING, .as.string = &s});
        vector_add_item(&vector, (Item){ITEM_NUMBER, .as.number = 7});
        Value v = vector_finish(&vector);
        assert_int_equal(v.len, before + 2);
        assert_int_equal(v.kind, VALUE_MIXED);
        for (uint32_t i = 0; i < before; i++)
            assert_number("element", value_at(&v, i).as.number, i);
        assert_int_equal(value_at(&v, before).type, ITEM_STRING);
        assert_number("last", value_at(&v, before + 1).as.number, 7);
    }
}

static void test_builder_reports_overflow(void **state) {
    World *world = *state;
    double few[] = {1, 2, 3};
    Vector vector = vector_new(&world->arena);
    vector_add(&vector, value_numbers_view(few, 3));
    vector_add(&vector,
               (Value){.len = VALUE_MAX_LEN - 2, .as.numbers = few}); // one element too many; the elements are not read
    assert_true(vector.overflow);
    vector_add_number(&vector, 4);
    assert_true(vector.overflow);
    assert_true(value_is_null(vector_finish(&vector)));
}

static void test_truth_of_values(void **state) {
    World *world = *state;
    static const struct {
        const char *v;
        bool wanted;
    } rows[] = {
        {"null", false}, {"0", false},        {"-0", false}, {"0;0", false},  {"0;1", true},
        {"nan", true},   {"''", false},       {"'a'", true}, {"0;''", false}, {"!a", true},
        {"0;!a", true},  {"uniform:0", true}, {":a", true},  {"inf", true},   {"1e-300", true},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_claim(rows[i].v, value_true(read_value(world, rows[i].v)) == rows[i].wanted);
    static const Function function = {.name = {"f", 1}};
    assert_true(value_true(value_function(&world->arena, &function)));
}

static void test_equality_of_vectors(void **state) {
    World *world = *state;
    static const struct {
        const char *a, *b;
        bool wanted;
    } rows[] = {
        {"1;2", "1;2", true},
        {"1;2", "1", false},
        {"1", "1;2", false},
        {"0", "-0", true},
        {"nan", "nan", false},
        {"null", "null", true},
        {"null", "0", false},
        {"'a'", ":a", false},
        {"'a'", "'a'", true},
        {"1;'a'", "1;'a'", true},
        {"1;'a'", "1;'b'", false},
        {"1;'a'", "1;2", false},
        {"!a", "!a", true},
        {"!a", "!b", false},
        {"!a", "'a'", false},
        {"!a", "1", false},
        {"uniform:1", "uniform:1", true},
        {"uniform:1", "uniform:2", false},
        {"uniform:1", "beta:1", false},
        {"uniform:1", "null", false},
        {"uniform:1", "1", false},
        {"inf", "inf", true},
        {"inf", "-inf", false},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Value a = read_value(world, rows[i].a), b = read_value(world, rows[i].b);
        assert_claim(rows[i].a, value_equal(NULL, a, b) == rows[i].wanted);
        assert_claim(rows[i].a, value_equal(NULL, b, a) == rows[i].wanted);
    }
    // Closures are equal if they are the same object. Built-in functions are equal if they have the same table row.
    static const int sine_row = 0, cosine_row = 0;
    static const Function f = {.name = {"f", 1}}, g = {.name = {"f", 1}}, sin1 = {.builtin = &sine_row},
                          sin2 = {.builtin = &sine_row}, cos1 = {.builtin = &cosine_row};
#define SAME(x, y) value_equal(NULL, value_function(&world->arena, &(x)), value_function(&world->arena, &(y)))
    assert_true(SAME(f, f));
    assert_false(SAME(f, g));
    assert_true(SAME(sin1, sin2));
    assert_false(SAME(sin1, cos1));
    assert_false(SAME(f, sin1));
}

enum { LESS = -1, SAME_ORDER, GREATER, NONE = VALUE_INCOMPARABLE };

static void test_order_of_vectors(void **state) {
    World *world = *state;
    static const struct {
        const char *a, *b;
        int wanted;
    } rows[] = {
        {"1;2", "1;3", LESS},
        {"1;2", "1;2;0", LESS},
        {"3", "2;9", GREATER},
        {"'B'", "'a'", LESS},
        {"'ab'", "'b'", LESS},
        {"'é'", "'z'", GREATER},
        {"null", "0", LESS},
        {"0", "null", GREATER},
        {"null", "null", SAME_ORDER},
        {"1", "'a'", NONE},
        {"1;'a'", "2;'a'", LESS},
        {"1;'a'", "1;'b'", LESS},
        {"1;'a'", "1;2", NONE},
        {"nan", "1", GREATER},
        {"1", "nan", GREATER},
        {"1;nan", "2;0", LESS},
        {"1;2", "1;2", SAME_ORDER},
        {"1;'a'", "1;'a'", SAME_ORDER},
        {"1;'a'", "1;'a';0", LESS},
        {"'a'", "!a", NONE},
        {"!a", "!b", NONE},
        {"!a", "!a", SAME_ORDER},
        {"!a;1", "!a;2", LESS},
        {"uniform:1", "0", LESS},
        {"uniform:1", "null", SAME_ORDER},
        {"'a'", "null", GREATER},
        {"0", "-0", SAME_ORDER},
        {"1;'a'", "'a';1", NONE},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        int order = value_compare(NULL, read_value(world, rows[i].a), read_value(world, rows[i].b));
        assert_claim(rows[i].a, order == rows[i].wanted);
    }
    Value nans = read_value(world, "nan;nan");
    assert_int_equal(value_compare(NULL, nans, nans), SAME_ORDER); // the operands are the same vector (L5.5 rule 1)
    assert_int_equal(value_compare(NULL, nans, read_value(world, "nan;nan")), GREATER);
}

static void test_in_finds_values(void **state) {
    World *world = *state;
    static const struct {
        const char *x, *y;
        bool wanted;
    } rows[] = {
        {"2", "1;2;3", true},        {"2;3", "1;2;3", true},   {"1;3", "1;2;3", false},   {"null", "3", true},
        {"3", "null", false},        {"null", "null", true},   {"1", "1;'b'", true},      {"'b'", "1;'b'", true},
        {"1;'b'", "1;'b';2", true},  {"'a'", "1;2", false},    {"nan", "nan", false},     {"1;1;2", "1;1;1;2", true},
        {"1;2;3;4", "1;2;3", false}, {"uniform:1", "3", true}, {"1", "uniform:1", false}, {"null", "uniform:1", true},
        {"!a", "!b;!a", true},       {"0", "-0", true},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        assert_claim(rows[i].x, value_contains(NULL, read_value(world, rows[i].x), read_value(world, rows[i].y)) ==
                                    rows[i].wanted);
}

static void test_index_wraps(void **state) {
    World *world = *state;
    static const struct {
        const char *v, *index, *wanted;
    } rows[] = {
        {"1;2;3", "0", "1"},         {"1;2;3", "-1", "3"},         {"1;2;3", "3;4;-4", "1;2;3"},
        {"1;2;3", "1.9", "2"},       {"1;2;3", "-0.5", "3"},       {"1;2;3", "null", "null"},
        {"1;2;3", "0;'a'", "null"},  {"null", "0", "null"},        {"'a';1;2", "1;2", "1;2"},
        {"5", "0;1;2;3", "5;5;5;5"}, {"'abc'", "0", "'abc'"},      {"'a';1", "0;0", "'a';'a'"},
        {"1;2;3", "1e18", "2"},      {"1;2;3", "-1e18", "3"},      {"1;2;3", "uniform:1", "null"},
        {"1;2;3", "nan", "2"},       {"1;2;3", "inf;-inf", "2;2"}, // nan and infinities are treated as -2147483648 (D8)
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Value found = value_index(&world->arena, read_value(world, rows[i].v), read_value(world, rows[i].index));
        assert_text(rows[i].index, show(world, found), rows[i].wanted);
    }
    Value numbers = value_index(&world->arena, read_value(world, "'a';1;2"), read_value(world, "1;2"));
    assert_int_equal(numbers.kind, VALUE_NUMBERS); // all selected elements are numbers, so the result is numeric
}

static void test_element_and_slice(void **state) {
    World *world = *state;
    Arena *arena = &world->arena;
    Value v = read_value(world, "'a';1;2;!b");
    assert_text("wraps", show(world, value_element(v, 5)), "1");
    assert_text("null", show(world, value_element(VALUE_NULL, 5)), "null");
    Value stream = read_value(world, "uniform:1");
    assert_true(value_element(stream, 5).as.number == value_stream_item(stream, 5));
    assert_text("all", show(world, value_slice(arena, v, 0, 4)), "'a';1;2;(!b)");
    assert_text("none", show(world, value_slice(arena, v, 2, 0)), "null");
    assert_text("one", show(world, value_slice(arena, v, 3, 1)), "(!b)");
    Value slice = value_slice(arena, v, 1, 2);
    assert_text("numbers of a mixed vector", show(world, slice), "1;2");
    assert_int_equal(slice.kind, VALUE_NUMBERS);
    assert_text("of numbers", show(world, value_slice(arena, read_value(world, "1;2;3;4"), 1, 2)), "2;3");
    assert_int_equal(value_wrap_index(-1, 3), 2);
    assert_int_equal(value_wrap_index(4294967296.0 * 4294967296.0, 7), 2); // 2^64 mod 7
}

// The copy must not point into the old arena.
static void test_copy_is_deep(void **state) {
    World *world = *state;
    Arena other;
    arena_init(&other, "other", SIZE_MAX);
    Value inner = read_value(world, "1;2;3");
    Node *node = node_set_attrs(&other, node_new(&other, name_of(world, "k")), &(Attr){name_of(world, "x"), inner}, 1);
    Value values[] = {read_value(world, "1"), value_numbers_view(inner.as.numbers, 3),
                      value_string(&other, STR("text")), value_node(&other, node), value_stream(STREAM_BETA, 9)};
    static const char *const wanted[] = {"1", "1;2;3", "'text'", "(!k)", "null"};
    for (size_t i = 0; i < COUNT_OF(values); i++)
        values[i] = value_copy(&world->arena, values[i]);
    arena_free(&other);
    for (size_t i = 0; i < COUNT_OF(values); i++)
        assert_text(wanted[i], show(world, values[i]), wanted[i]);
    const Node *copy = values[3].as.items[0].as.node;
    assert_text("attribute", show(world, node_get(copy, name_of(world, "x"))), "1;2;3");
    assert_true(value_equal(NULL, values[4], value_stream(STREAM_BETA, 9)));
}

static void test_text_concatenates_elements(void **state) {
    World *world = *state;
    static const struct {
        const char *v, *wanted;
    } rows[] = {
        {"null", ""},
        {"0.3333333333333333;:a;1e20;-0;1e-7", "0.333333333a1e+20-01e-07"},
        {"'a';1;2.5;'';1;1e9;1e8;123456789;1234567890;0.30000000000000004",
         "a12.511e+091000000001234567891.23456789e+090.3"},
        {"12345678.95;1e-4;1e-5;nan;-inf;inf", "12345678.90.00011e-05nan-infinf"},
        {"!foo", "foo"},
        {"'é😀'", "é😀"},
        {"uniform:1", ""},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Str text = value_text(&world->arena, &world->symbols, read_value(world, rows[i].v));
        assert_text(rows[i].v, str_to_c(&world->arena, text), rows[i].wanted);
    }
}

TEST_GROUP(value_vector) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_composition_concatenates_parts),
        WORLD_TEST(test_builder_turns_mixed),
        WORLD_TEST(test_builder_reports_overflow),
        WORLD_TEST(test_truth_of_values),
        WORLD_TEST(test_equality_of_vectors),
        WORLD_TEST(test_order_of_vectors),
        WORLD_TEST(test_in_finds_values),
        WORLD_TEST(test_index_wraps),
        WORLD_TEST(test_element_and_slice),
        WORLD_TEST(test_copy_is_deep),
        WORLD_TEST(test_text_concatenates_elements),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
