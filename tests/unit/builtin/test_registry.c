// test_registry.c: the table of built-ins and the matching of arguments (spec builtins.md B0).
#include "world.h"

// The functions of B0.6 and related rules, in the order of that index.
static const char *const all_names[] = {
    "abs",           "accumulate", "acos",      "angle",     "asin",     "beta",    "bounce",       "ceil",
    "chr",           "clamp",      "colortemp", "concat",    "cos",      "count",   "cross",        "csv",
    "cubic",         "debug",      "dot",       "exp",       "floor",    "fract",   "glob",         "hsl",
    "hsv",           "hypot",      "impulse",   "inverse",   "len",      "length",  "linear",       "log",
    "log10",         "log2",       "map",       "max",       "maxindex", "mean",    "measure_text", "min",
    "minindex",      "noise",      "normal",    "normalize", "octnoise", "oklab",   "oklch",        "ord",
    "point_towards", "polar",      "product",   "qbetween",  "qmul",     "quad",    "quaternion",   "read",
    "read_bytes",    "round",      "sample",    "sawtooth",  "sharkfin", "shuffle", "sin",          "sine",
    "slerp",         "snap",       "sort",      "split",     "sqrt",     "square",  "srt",          "sum",
    "tan",           "triangle",   "uniform",   "zip",
};
enum { NAME_COUNT = sizeof all_names / sizeof all_names[0] };

static bool is_one_of(const char *name, const char *const *names) {
    while (*names && strcmp(*names, name) != 0)
        names++;
    return *names != NULL;
}

static void test_all_functions_exist(void **state) {
    (void)state;
    assert_int_equal(builtin_table_count, NAME_COUNT);
    for (uint32_t i = 0; i < NAME_COUNT; i++) {
        const Builtin *builtin = builtin_find(str_from(all_names[i]));
        assert_non_null(builtin);
        assert_string_equal(builtin->name, all_names[i]);
    }
    assert_null(builtin_find(STR("")));
    assert_null(builtin_find(STR("si")));
    assert_null(builtin_find(STR("sinx")));
    assert_null(builtin_find(STR("zz")));
}

// The table is complete, and sorted for binary search.
static void test_table_is_sorted(void **state) {
    (void)state;
    static const char *const impure[] = {"debug",      "sample", "glob",         "csv", "read",
                                         "read_bytes", "srt",    "measure_text", NULL};
    for (uint32_t i = 0; i < builtin_table_count; i++) {
        const Builtin *builtin = &builtin_table[i];
        assert_true(i == 0 || strcmp(builtin_table[i - 1].name, builtin->name) < 0);
        assert_non_null(builtin->call);
        assert_true(strlen(builtin->help) > 10);
        assert_true(builtin->help[strlen(builtin->help) - 1] == '.');
        assert_true(builtin->required <= builtin->fixed && builtin->fixed <= 8);
        assert_int_equal(builtin->pure, !is_one_of(builtin->name, impure));
    }
}

// The parameter lists in the help agree with the argument counts, and required parameters come first.
static void test_parameter_texts_match_counts(void **state) {
    (void)state;
    for (uint32_t i = 0; i < builtin_table_count; i++) {
        const Builtin *builtin = &builtin_table[i];
        uint32_t fixed = 0;
        bool variadic = false;
        char text[200];
        snprintf(text, sizeof text, "%s", builtin->parameters);
        for (char *at = text, *next; at; at = next) {
            next = strstr(at, ", ");
            if (next) {
                *next = 0;
                next += 2;
            }
            assert_false(variadic);
            variadic = strcmp(at, "...") == 0;
            fixed += !variadic;
            if (strchr(at, '='))
                assert_true(fixed > builtin->required);
        }
        assert_int_equal(fixed, builtin->fixed);
        assert_int_equal(variadic, builtin->variadic);
    }
}

// The functions that accept arguments by name (B0.3).
static void test_named_arguments_are_accepted(void **state) {
    (void)state;
    static const char *const also[] = {"debug", "glob", "read", "read_bytes", NULL};
    static const char *const never[] = {"hypot", "zip", NULL};
    for (uint32_t i = 0; i < builtin_table_count; i++) {
        const Builtin *builtin = &builtin_table[i];
        bool single = builtin->fixed == 1 && builtin->required == 1 && !builtin->variadic;
        bool named = (!single || is_one_of(builtin->name, also)) && !is_one_of(builtin->name, never);
        assert_int_equal(builtin->named, named);
    }
}

static void test_constants_have_values(void **state) {
    (void)state;
    static const struct {
        const char *name;
        double number;
    } constants[] = {
        {"true", 1},
        {"false", 0},
        {"inf", INFINITY},
        {"nan", NAN},
        {"pi", 3.141592653589793},
        {"\u03c0", 3.141592653589793},
        {"tau", 6.283185307179586},
        {"\U0001d70f", 6.283185307179586},
    };
    Value v;
    for (size_t i = 0; i < sizeof constants / sizeof constants[0]; i++) {
        assert_true(builtin_constant(str_from(constants[i].name), &v));
        assert_true(same_value(v, value_number(constants[i].number)));
    }
    assert_true(builtin_constant(STR("null"), &v) && value_is_null(v));
    assert_false(builtin_constant(STR("TRUE"), &v));
    assert_false(builtin_constant(STR(""), &v));
}

// A context without callbacks is valid and reports nothing.
static void test_callbacks_are_optional(void **state) {
    World *world = *state;
    world->context.report_error = NULL;
    world->context.log = NULL;
    Value one = value_number(1);
    assert_true(value_is_null(builtin_call(&world->context, builtin_find(STR("sin")), NULL, 0, NULL, NULL, 0)));
    assert_true(same_value(builtin_call(&world->context, builtin_find(STR("debug")), &one, 1, NULL, NULL, 0), one));
}

TEST_GROUP(registry) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_functions_exist),
        cmocka_unit_test(test_table_is_sorted),
        cmocka_unit_test(test_parameter_texts_match_counts),
        cmocka_unit_test(test_named_arguments_are_accepted),
        cmocka_unit_test(test_constants_have_values),
        cmocka_unit_test_setup_teardown(test_callbacks_are_optional, world_setup, world_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
