// test_maths_hard.c: arguments that are hard to round, compared with MPFR. Tests the public functions, the variant
// without FMA and the accurate path alone.
#include "hard_cases.h"
#include "model.h"

static const Subject *subject_of(const char *name) {
    for (size_t i = 0; i < COUNT_OF(subjects); i++)
        if (!strcmp(subjects[i].name, name))
            return &subjects[i];
    return NULL;
}

// These results are 2^-30 to 2^-60 ulp from a midpoint, so each needs the accurate path.
static void test_listed_cases_are_rounded_correctly(void **state) {
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < COUNT_OF(hard_cases); i++) {
        const HardCase *row = &hard_cases[i];
        const Subject *subject = subject_of(row->name);
        wrong += wrong_cases(subject, row->x, row->y, true);
        if (strcmp(row->name, "pow") && strcmp(row->name, "log") && strncmp(row->name, "log", 3))
            wrong += wrong_cases(subject, -row->x, row->y, true);
    }
    assert_int_equal(wrong, 0);
}

// All powers of two and the adjacent doubles.
static void test_powers_of_two_are_rounded_correctly(void **state) {
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < COUNT_OF(subjects); i++)
        for (int e = -1074; e <= 1023; e++)
            for (int side = -1; side <= 1; side++) {
                double x = double_from(bits_from(ldexp(1, e)) + (uint64_t)(int64_t)side);
                double y = subjects[i].model2 ? ldexp(1 + 0x1p-40 * (e & 63), e % 9) : 0;
                wrong += wrong_cases(&subjects[i], x, y, e % 8 == 0);
                if (subjects[i].model2) // for pow and atan2, also exchange the arguments
                    wrong += wrong_cases(&subjects[i], y, x, e % 8 == 0);
            }
    assert_int_equal(wrong, 0);
}

// Multiples of pi/2 and the doubles near them. The reduced argument is as small as 2^-61.
static void test_quarter_turns_are_rounded_correctly(void **state) {
    (void)state;
    int wrong = 0;
    for (int name = 0; name < 3; name++) {
        const Subject *subject = subject_of((const char *[]){"sin", "cos", "tan"}[name]);
        for (int i = 1; i < 3000; i++) {
            double x = i * 1.5707963267948966 * (i % 3 == 0 ? ldexp(1, i % 1000) : 1);
            wrong += wrong_cases(subject, x, 0, i % 16 == 0) + wrong_cases(subject, nextafter(x, 0), 0, false);
        }
        // the double with the smallest relative distance to a multiple of pi/2 (Kahan; Muller)
        wrong += wrong_cases(subject, 0x1.6ac5b262ca1ffp+849, 0, true);
        wrong += wrong_cases(subject, 0x1.921fb54442d18p+0, 0, true);
    }
    assert_int_equal(wrong, 0);
}

// Powers that are exactly a double or a midpoint: m^n with up to 64 bits, roots of squares, and subnormal results.
static void test_exact_powers_are_rounded_correctly(void **state) {
    (void)state;
    const Subject *subject = subject_of("pow");
    int wrong = 0;
    for (uint64_t m = 1; m < 200; m += 2)
        for (int n = -4; n <= 40; n++)
            for (int e = -60; e <= 60; e += 20)
                wrong += wrong_cases(subject, ldexp((double)m, e), n, true);
    uint64_t seed = 2;
    for (int i = 0; i < 20000; i++) {
        // a square of up to 54 bits; about half of these squares are midpoints between two doubles
        double root = (double)(next_bits(&seed) >> (37 + i % 8) | 1);
        wrong += wrong_cases(subject, root, 2, true);
        double fourth = (double)(next_bits(&seed) >> (51 + i % 8) | 1);
        wrong += wrong_cases(subject, fourth * fourth * fourth * fourth, 0.75, true);
        wrong += wrong_cases(subject, fourth * fourth * fourth * fourth, 1.25, true);
        // midpoint between two subnormal numbers: an odd multiple of 2^-1075
        wrong += wrong_cases(subject, ldexp((double)(next_bits(&seed) >> 58 | 1), -537) * 0.5, 2, true);
        wrong += wrong_cases(subject, ldexp((double)(next_bits(&seed) >> 50 | 1), -540), 2, true);
    }
    for (int e = -1080; e <= 1030; e++) {
        wrong += wrong_cases(subject, 2, e, true) + wrong_cases(subject, 4, e * 0.5, true);
        wrong += wrong_cases(subject, 2, e + 0.5, e % 8 == 0) + wrong_cases(subject, 0x1p-1074, e / 1074.0, e % 8 == 0);
    }
    assert_int_equal(wrong, 0);
}

// Results near the smallest normal number and below it, near the largest number, and near 1.
static void test_range_limits_are_rounded_correctly(void **state) {
    (void)state;
    int wrong = 0;
    uint64_t seed = 3;
    for (int i = 0; i < 20000; i++) {
        double u = (double)(next_bits(&seed) >> 11) * 0x1p-53, v = (double)(next_bits(&seed) >> 11) * 0x1p-53;
        bool exact = i % 8 == 0;
        wrong += wrong_cases(subject_of("exp"), -708 - 38 * u, 0, exact);
        wrong += wrong_cases(subject_of("exp"), 709 + u, 0, exact);
        wrong += wrong_cases(subject_of("exp"), ldexp(u - 0.5, -40 - i % 16), 0, exact);
        wrong += wrong_cases(subject_of("pow"), 1 + 10 * v, -(1021 + 56 * u) / log2(1 + 10 * v), exact);
        wrong += wrong_cases(subject_of("pow"), 1 + 10 * v, (1023 + 2 * u) / log2(1 + 10 * v), exact);
        wrong += wrong_cases(subject_of("pow"), 1 + 10 * v, ldexp(u - 0.5, -48 - i % 16), exact);
        wrong += wrong_cases(subject_of("pow"), 1 + 0x1p-52 * (int)(10 * v - 5), ldexp(u - 0.5, i % 64), exact);
        wrong += wrong_cases(subject_of("atan2"), ldexp(u, -1000 - i % 74), ldexp(v, i % 100), true);
        wrong += wrong_cases(subject_of("atan2"), ldexp((int)(64 * u), -1074), (int)(8 * v) + 1, true);
        wrong += wrong_cases(subject_of("log"), double_from(next_bits(&seed) >> (12 + i % 50)), 0, exact);
        wrong += wrong_cases(subject_of("log10"), double_from(next_bits(&seed) >> (12 + i % 50)), 0, exact);
    }
    for (size_t i = 0; i < COUNT_OF(subjects); i++) // arguments of random bits
        for (int k = 0; k < 5000; k++) {
            double x = double_from(next_bits(&seed)), y = double_from(next_bits(&seed));
            wrong += isnan(x) || isnan(y) ? 0 : wrong_cases(&subjects[i], x, y, true);
        }
    assert_int_equal(wrong, 0);
}

TEST_GROUP(maths_hard) {
    model_start();
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_listed_cases_are_rounded_correctly),
                                       cmocka_unit_test(test_powers_of_two_are_rounded_correctly),
                                       cmocka_unit_test(test_quarter_turns_are_rounded_correctly),
                                       cmocka_unit_test(test_exact_powers_are_rounded_correctly),
                                       cmocka_unit_test(test_range_limits_are_rounded_correctly)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
