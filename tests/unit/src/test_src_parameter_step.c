// test_src_parameter_step.c: where the keys of `petri view` take a parameter.
#include "check.h"
#include "view/parameter_step.h"

static PetriParameter parameter(double number, double fallback, double least, double most, double step) {
    return (PetriParameter){.number = number, .default_number = fallback, .min = least, .max = most, .step = step};
}

static void test_steps(void **state) {
    (void)state;
    static const struct {
        const char *row;
        double number, fallback, least, most, step;
        int steps;
        double to;
    } rows[] = {
        {"a fiftieth of the range, in round steps", 200, 200, 1, 500, 0, 1, 205},
        {"down", 200, 200, 1, 500, 0, -1, 195},
        {"ten", 200, 200, 1, 500, 0, 10, 250},
        {"to a multiple of the step", 1, 200, 1, 500, 0, 1, 5},
        {"back from there", 203, 200, 1, 500, 0, -1, 200},
        {"not beyond the end", 498, 200, 1, 500, 0, 1, 500},
        {"and there it stays", 500, 200, 1, 500, 0, 1, 500},
        {"nor the beginning", 3, 200, 1, 500, 0, -1, 1},
        {"into the range from outside", 900, 200, 1, 500, 0, 1, 500},
        {"whole in a small range", 3, 3, 1, 9, 0, 1, 4},
        {"parts in a range of parts", 0.5, 0.5, 0.1, 2.1, 0, 1, 0.52},
        {"a step of the script's", 0.5, 0.5, 0, 1, 0.05, 1, 0.55},
        {"counted from the range's start", 0.3, 0.3, 0.1, 1, 0.25, 1, 0.35},
        {"no dust", 0.2, 0.3, 0, 1, 0.1, 1, 0.3},
        {"a twentieth of the default without a range", 15, 15, -INFINITY, INFINITY, 0, 1, 16},
        {"of a large one", 12000, 10000, -INFINITY, INFINITY, 0, -1, 11500},
        {"of a small one", 1e-3, 1e-3, 0, INFINITY, 0, 1, 0.00105},
        {"the size is that of the default", 1, 1000, -INFINITY, INFINITY, 0, 1, 50},
        {"a default that only a frame knows", 40, NAN, -INFINITY, INFINITY, 0, 1, 42},
        {"below 0", -1, 5, -5, 5, 0, -1, -2},
        {"over 0, which would be the default", 1, 5, -5, 5, 0, -1, -1},
        {"from below, too", -0.02, 0.5, -1, 1, 0, 1, 0.02},
        {"to 0 where it is the default", 1, 0, 0, 1, 0, -1, 0},
        {"and away from it", 0, 0, 0, 1, 0, 1, 1},
        {"not to 0 at the range's start", 1, 5, 0, 10, 0, -1, NAN},
        {"no number", NAN, NAN, -INFINITY, INFINITY, 0, 1, NAN},
        {"infinite", INFINITY, 1, -INFINITY, INFINITY, 0, 1, NAN},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        PetriParameter row = parameter(rows[i].number, rows[i].fallback, rows[i].least, rows[i].most, rows[i].step);
        assert_number(rows[i].row, parameter_stepped(&row, rows[i].steps), rows[i].to);
    }
}

// Up and down again leads back to where it was, from anywhere on the way.
static void test_there_and_back(void **state) {
    (void)state;
    PetriParameter row = parameter(0.1, 0.7, 0.1, 3, 0.1);
    for (int i = 0; i < 28; i++) {
        double before = row.number;
        row.number = parameter_stepped(&row, 1);
        assert_true(row.number > before);
        assert_number("back", parameter_stepped(&row, -1), before);
    }
    assert_number("all the way", row.number, 2.9);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_steps), cmocka_unit_test(test_there_and_back)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
