// test_value_ops.c: arithmetic and ranges (language.md L5.1 to L5.3).
#include "maths/maths.h"
#include "value/ops.h"
#include "values.h"

static void test_arithmetic_by_element(void **state) {
    World *world = *state;
    static const struct {
        const char *a;
        ArithOp op;
        const char *b, *wanted;
    } rows[] = {
        {"1;2;3", ARITH_ADD, "10;20", "11;22;13"},
        {"1;2;3", ARITH_ADD, "null", "null"},
        {"null", ARITH_ADD, "null", "null"},
        {"1;'a'", ARITH_ADD, "1", "null"},
        {"1", ARITH_MUL, "!a", "null"},
        {"uniform:1", ARITH_ADD, "1", "null"},
        {"10;20", ARITH_SUB, "1;2;3;4;5", "9;18;7;16;5"},
        {"7;-7;7;7.5", ARITH_FLOORDIV, "2;2;-2;0.5", "3;-4;-4;15"},
        {"7;-7;7;-7;5.5", ARITH_MOD, "2;2;-2;-2;2", "1;1;-1;-1;1.5"},
        {"1;-1;0", ARITH_DIV, "0", "inf;-inf;nan"},
        {"1;0", ARITH_FLOORDIV, "0", "inf;nan"},
        {"1", ARITH_MOD, "0", "nan"},
        {"inf;5;-5", ARITH_MOD, "2;inf;inf", "nan;nan;nan"},
        {"5;-5", ARITH_FLOORDIV, "inf", "0;-0"},
        {"7", ARITH_FLOORDIV, "0.1", "70"},
        {"7;1e17", ARITH_MOD, "0.1;3", "0;0"},
        {"2;-8;0;nan", ARITH_POW, "0.5;0.3333333333333333;0;0", "1.4142135623730951;nan;1;1"},
        {"2.5", ARITH_DIV, "3", "0.8333333333333334"},
        {"0.1", ARITH_ADD, "0.2", "0.30000000000000004"},
        {":a", ARITH_MUL, "2", "-inf"},
        {":a", ARITH_ADD, "1", ":a"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Value a = read_value(world, rows[i].a), b = read_value(world, rows[i].b);
        assert_text(rows[i].wanted, show(world, op_arith(&world->arena, rows[i].op, a, b)), rows[i].wanted);
    }
}

// x ** 2 is x * x if the right operand is the single number 2; otherwise, it is pow(x, 2) (D2).
static void test_square_is_multiplication(void **state) {
    World *world = *state;
    uint64_t seed = 7;
    for (int i = 0; i < 20000; i++) {
        double x = (double)(next_bits(&seed) >> 11) * 0x1p-50;
        Value square = op_arith(&world->arena, ARITH_POW, value_number(x), value_number(2));
        assert_number("one element", square.as.number, x * x);
        double pair[] = {x, x}, twos[] = {2, 2};
        Value squares = op_arith(&world->arena, ARITH_POW, value_numbers_view(pair, 2), value_number(2));
        assert_number("a vector of bases", squares.as.numbers[1], x * x);
        Value powers = op_arith(&world->arena, ARITH_POW, value_number(x), value_numbers_view(twos, 2));
        assert_number("a vector of exponents", powers.as.numbers[0], maths_pow(x, 2));
    }
}

// The shorter vector is repeated cyclically.
static void test_shorter_vector_is_repeated(void **state) {
    World *world = *state;
    double numbers[12];
    for (int i = 0; i < 12; i++)
        numbers[i] = 1 + i * i;
    for (uint32_t n = 1; n <= 12; n++)
        for (uint32_t m = 1; m <= 12; m++) {
            Value result =
                op_arith(&world->arena, ARITH_SUB, value_numbers_view(numbers, n), value_numbers_view(numbers, m));
            assert_int_equal(result.len, n > m ? n : m);
            for (uint32_t i = 0; i < result.len; i++)
                assert_number("element", value_numbers(&result)[i], numbers[i % n] - numbers[i % m]);
        }
}

static void test_unary_operators(void **state) {
    World *world = *state;
    static const struct {
        const char *v, *minus, *plus;
    } rows[] = {
        {"0", "-0", "0"},          {"1;-2;nan;inf", "-1;2;nan;-inf", "1;-2;nan;inf"},
        {"null", "null", "null"},  {"'a'", "null", "null"},
        {"1;'a'", "null", "null"}, {"beta:5", "null", "null"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Value v = read_value(world, rows[i].v);
        assert_text(rows[i].v, show(world, op_negate(&world->arena, v)), rows[i].minus);
        assert_text(rows[i].v, show(world, op_plus(v)), rows[i].plus);
    }
}

static void test_range_elements(void **state) {
    World *world = *state;
    static const struct {
        const char *start, *stop, *step, *wanted;
    } rows[] = {
        {"null", "5", "null", "0;1;2;3;4"},
        {"3", "25", "7", "3;10;17;24"},
        {"2", "1", "-0.3", "2;1.7;1.4;1.1"},
        {"0", "1", "0.1", "0;0.1;0.2;0.30000000000000004;0.4;0.5;0.6000000000000001;0.7000000000000001;0.8;0.9"},
        {"null", "2.5", "null", "0;1;2"},
        {"0.5", "3", "null", "0.5;1.5;2.5"},
        {"5", "0", "null", "null"},
        {"5", "0", "-2", "5;3;1"},
        {"null", "1", "0", "null"},
        {"null", "1", "-0", "null"},
        {"null", "null", "null", "null"},
        {"1;2", "3", "null", "null"},
        {"1", "3;4", "null", "null"},
        {"1", "3", "1;1", "null"},
        {"'a'", "3", "null", "null"},
        {"1", "'a'", "null", "null"},
        {"1", "3", "!a", "null"},
        {"null", "inf", "null", "null"},
        {"null", "nan", "null", "null"},
        {"nan", "3", "null", "null"},
        {"0", "3", "nan", "null"},
        {"null", "1e-300", "null", "0"},
        {"-2", "2", "null", "-2;-1;0;1"},
        {"0", "3", "inf", "null"},
        {"uniform:1", "2", "null", "0;1"}, // a stream counts as a vector without elements
        {"-0", "1", "null", "0"},          // -0 + 1*0
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        bool too_long = false;
        Value range = op_range(&world->arena, read_value(world, rows[i].start), read_value(world, rows[i].stop),
                               read_value(world, rows[i].step), &too_long);
        char row[100];
        snprintf(row, sizeof row, "%s..%s|%s", rows[i].start, rows[i].stop, rows[i].step);
        assert_text(row, show(world, range), rows[i].wanted);
        assert_false(too_long);
    }
}

static void test_too_long_range_is_reported(void **state) {
    World *world = *state;
    bool too_long = false;
    Value range = op_range(&world->arena, VALUE_NULL, value_number(1e12), VALUE_NULL, &too_long);
    assert_true(too_long);
    assert_true(value_is_null(range));
    too_long = false;
    range = op_range(&world->arena, VALUE_NULL, value_number(1), value_number(1e-10), &too_long);
    assert_true(too_long);
    assert_true(value_is_null(range));
    too_long = false;
    range = op_range(&world->arena, VALUE_NULL, value_number(1e6), VALUE_NULL, &too_long);
    assert_false(too_long);
    assert_int_equal(range.len, 1000000);
    assert_number("last", range.as.numbers[999999], 999999);
}

TEST_GROUP(value_ops) {
    const struct CMUnitTest tests[] = {
        WORLD_TEST(test_arithmetic_by_element),
        WORLD_TEST(test_square_is_multiplication),
        WORLD_TEST(test_shorter_vector_is_repeated),
        WORLD_TEST(test_unary_operators),
        WORLD_TEST(test_range_elements),
        WORLD_TEST(test_too_long_range_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
