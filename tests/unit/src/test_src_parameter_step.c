// test_src_parameter_step.c: tests of the values that the keys of `petri view` set.
#include "check.h"
#include "view/parameter_step.h"

static PetriParameter parameter(double number, double default_value, double min, double max, double step) {
    return (PetriParameter){.number = number, .default_number = default_value, .min = min, .max = max, .step = step};
}

static void test_step_gives_expected_value(void **state) {
    (void)state;
    static const struct {
        const char *row;
        double number, default_value, min, max, step;
        int steps;
        double to;
    } rows[] = {
        {"step up by a round fiftieth of the range", 200, 200, 1, 500, 0, 1, 205},
        {"step down", 200, 200, 1, 500, 0, -1, 195},
        {"ten steps up", 200, 200, 1, 500, 0, 10, 250},
        {"step up to a multiple of the step", 1, 200, 1, 500, 0, 1, 5},
        {"step down to a multiple of the step", 203, 200, 1, 500, 0, -1, 200},
        {"stop at the maximum", 498, 200, 1, 500, 0, 1, 500},
        {"stay at the maximum", 500, 200, 1, 500, 0, 1, 500},
        {"stop at the minimum", 3, 200, 1, 500, 0, -1, 1},
        {"move into the range from outside", 900, 200, 1, 500, 0, 1, 500},
        {"integer steps in a small range of integers", 3, 3, 1, 9, 0, 1, 4},
        {"fractional steps in a range with fractions", 0.5, 0.5, 0.1, 2.1, 0, 1, 0.52},
        {"step of the script", 0.5, 0.5, 0, 1, 0.05, 1, 0.55},
        {"steps counted from the minimum", 0.3, 0.3, 0.1, 1, 0.25, 1, 0.35},
        {"no rounding error", 0.2, 0.3, 0, 1, 0.1, 1, 0.3},
        {"a twentieth of the default if there is no range", 15, 15, -INFINITY, INFINITY, 0, 1, 16},
        {"a twentieth of a large default", 12000, 10000, -INFINITY, INFINITY, 0, -1, 11500},
        {"a twentieth of a small default", 1e-3, 1e-3, 0, INFINITY, 0, 1, 0.00105},
        {"step size from the default, not the value", 1, 1000, -INFINITY, INFINITY, 0, 1, 50},
        {"step size from the value if the default is unknown", 40, NAN, -INFINITY, INFINITY, 0, 1, 42},
        {"step down below 0", -1, 5, -5, 5, 0, -1, -2},
        {"skip 0, which would select the default", 1, 5, -5, 5, 0, -1, -1},
        {"skip 0 from below", -0.02, 0.5, -1, 1, 0, 1, 0.02},
        {"stop at 0 if it is the default", 1, 0, 0, 1, 0, -1, 0},
        {"leave 0 if it is the default", 0, 0, 0, 1, 0, 1, 1},
        {"no step to 0 at the minimum", 1, 5, 0, 10, 0, -1, NAN},
        {"not a number", NAN, NAN, -INFINITY, INFINITY, 0, 1, NAN},
        {"infinite value", INFINITY, 1, -INFINITY, INFINITY, 0, 1, NAN},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        PetriParameter row = parameter(rows[i].number, rows[i].default_value, rows[i].min, rows[i].max, rows[i].step);
        assert_number(rows[i].row, parameter_stepped(&row, rows[i].steps), rows[i].to);
    }
}

// A step up followed by a step down restores the value, at every point of the range.
static void test_step_down_undoes_step_up(void **state) {
    (void)state;
    PetriParameter row = parameter(0.1, 0.7, 0.1, 3, 0.1);
    for (int i = 0; i < 28; i++) {
        double before = row.number;
        row.number = parameter_stepped(&row, 1);
        assert_true(row.number > before);
        assert_number("step down after step up", parameter_stepped(&row, -1), before);
    }
    assert_number("28 steps up", row.number, 2.9);
}

static void test_fraction_selects_value(void **state) {
    (void)state;
    static const struct {
        const char *row;
        double number, default_value, min, max, step, fraction, to;
    } rows[] = {
        {"minimum", 3, 3, 1, 9, 0, 0, 1},
        {"maximum", 3, 3, 1, 9, 0, 1, 9},
        {"integers in a range of integers", 3, 3, 1, 9, 0, 0.3, 3},
        {"step of the script, counted from the minimum", 0.3, 0.3, 0.1, 1, 0.25, 0.5, 0.6},
        {"not beyond the maximum", 0.3, 0.3, 0.1, 1, 0.25, 1, 1},
        {"a two hundredth of a range with fractions", 0.5, 0.5, 0, 1, 0, 0.503, 0.505},
        {"the next value instead of 0", 5, 5, 0, 10, 0, 0, 1},
        {"the next smaller value instead of a maximum of 0", -5, -5, -10, 0, 0, 1, -1},
        {"0 if it is the default", 1, 0, 0, 10, 0, 0, 0},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        PetriParameter row = parameter(rows[i].number, rows[i].default_value, rows[i].min, rows[i].max, rows[i].step);
        assert_number(rows[i].row, parameter_at(&row, rows[i].fraction), rows[i].to);
    }
}

// A parameter that accepts 0 reaches it with keys and with its slider.
static void test_zero_is_reached_if_accepted(void **state) {
    (void)state;
    PetriParameter row = parameter(1, 5, -5, 5, 0);
    row.accepts_false = true;
    assert_number("step down to 0", parameter_stepped(&row, -1), 0);
    assert_number("0 in the middle", parameter_at(&row, 0.5), 0);
    row.min = 0;
    assert_number("0 at the minimum", parameter_at(&row, 0), 0);
}

TEST_GROUP(src_parameter_step) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_step_gives_expected_value), cmocka_unit_test(test_step_down_undoes_step_up),
        cmocka_unit_test(test_fraction_selects_value), cmocka_unit_test(test_zero_is_reached_if_accepted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
