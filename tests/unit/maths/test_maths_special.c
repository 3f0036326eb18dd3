// test_maths_special.c: special values of C17 Annex F, compared bit for bit without a reference library.
#include "check.h"
#include "maths/fast.h"
#include "maths/maths.h"

#define INF INFINITY
#define TINY 0x1p-1074
#define HUGE 0x1.fffffffffffffp+1023
#define PI 0x1.921fb54442d18p+1

typedef struct RowOne {
    const char *text;
    double (*functions[3])(double);
    double x, wanted;
} RowOne;

typedef struct RowTwo {
    const char *text;
    double (*functions[3])(double, double);
    double x, y, wanted;
} RowTwo;

#define ALL_OF(name)                                                                                                   \
    { maths_##name, maths_##name##_plain, exact_##name }
#define ONE_ROW(name, x, wanted)                                                                                       \
    { #name "(" #x ")", ALL_OF(name), x, wanted }
#define TWO_ROW(name, x, y, wanted)                                                                                    \
    { #name "(" #x ", " #y ")", ALL_OF(name), x, y, wanted }

static const RowOne one_rows[] = {
    // sine, cosine, tangent: F.10.1.5 to 7
    ONE_ROW(sin, 0.0, 0.0),
    ONE_ROW(sin, -0.0, -0.0),
    ONE_ROW(sin, INF, NAN),
    ONE_ROW(sin, -INF, NAN),
    ONE_ROW(sin, NAN, NAN),
    ONE_ROW(sin, TINY, TINY),
    ONE_ROW(sin, -0x1p-1022, -0x1p-1022),
    ONE_ROW(sin, HUGE, 0x1.452fc98b34e97p-8),
    ONE_ROW(sin, PI, 0x1.1a62633145c07p-53),
    ONE_ROW(cos, 0.0, 1.0),
    ONE_ROW(cos, -0.0, 1.0),
    ONE_ROW(cos, INF, NAN),
    ONE_ROW(cos, NAN, NAN),
    ONE_ROW(cos, TINY, 1.0),
    ONE_ROW(cos, 0x1p-26, 0x1.fffffffffffffp-1),
    ONE_ROW(cos, PI, -1.0),
    ONE_ROW(tan, 0.0, 0.0),
    ONE_ROW(tan, -0.0, -0.0),
    ONE_ROW(tan, -INF, NAN),
    ONE_ROW(tan, NAN, NAN),
    ONE_ROW(tan, -TINY, -TINY),
    ONE_ROW(tan, PI / 2, 0x1.d02967c31cdb5p+53),
    ONE_ROW(tan, PI / 4, 0x1.fffffffffffffp-1),
    // asin and acos: F.10.1.1 and 2
    ONE_ROW(asin, 0.0, 0.0),
    ONE_ROW(asin, -0.0, -0.0),
    ONE_ROW(asin, 1.0, PI / 2),
    ONE_ROW(asin, -1.0, -PI / 2),
    ONE_ROW(asin, 0x1.0000000000001p+0, NAN),
    ONE_ROW(asin, -INF, NAN),
    ONE_ROW(asin, NAN, NAN),
    ONE_ROW(asin, TINY, TINY),
    ONE_ROW(asin, 0.5, 0x1.0c152382d7366p-1),
    ONE_ROW(acos, 1.0, 0.0),
    ONE_ROW(acos, -1.0, PI),
    ONE_ROW(acos, 0.0, PI / 2),
    ONE_ROW(acos, -0.0, PI / 2),
    ONE_ROW(acos, TINY, PI / 2),
    ONE_ROW(acos, -2.0, NAN),
    ONE_ROW(acos, INF, NAN),
    ONE_ROW(acos, NAN, NAN),
    // exponential and logarithms: F.10.3.1, 7, 8, 10
    ONE_ROW(exp, 0.0, 1.0),
    ONE_ROW(exp, -0.0, 1.0),
    ONE_ROW(exp, INF, INF),
    ONE_ROW(exp, -INF, 0.0),
    ONE_ROW(exp, NAN, NAN),
    ONE_ROW(exp, 1.0, 0x1.5bf0a8b145769p+1),
    ONE_ROW(exp, TINY, 1.0),
    ONE_ROW(exp, -0x1p-54, 1.0),
    ONE_ROW(exp, -0x1.0000000000001p-54, 0x1.fffffffffffffp-1),
    ONE_ROW(exp, 0x1.62e42fefa39efp+9, 0x1.fffffffffff2ap+1023),
    ONE_ROW(exp, 0x1.62e42fefa39f0p+9, INF),
    ONE_ROW(exp, HUGE, INF),
    ONE_ROW(exp, -0x1.74910d52d3051p+9, TINY),
    ONE_ROW(exp, -0x1.74910d52d3052p+9, 0.0),
    ONE_ROW(exp, -HUGE, 0.0),
    ONE_ROW(log, 1.0, 0.0),
    ONE_ROW(log, 0.0, -INF),
    ONE_ROW(log, -0.0, -INF),
    ONE_ROW(log, -1.0, NAN),
    ONE_ROW(log, -INF, NAN),
    ONE_ROW(log, INF, INF),
    ONE_ROW(log, NAN, NAN),
    ONE_ROW(log, TINY, -0x1.74385446d71c3p+9),
    ONE_ROW(log, 10.0, 2.302585092994046),
    ONE_ROW(log2, 1.0, 0.0),
    ONE_ROW(log2, 8.0, 3.0),
    ONE_ROW(log2, TINY, -1074.0),
    ONE_ROW(log2, 0x1p+1023, 1023.0),
    ONE_ROW(log2, 0.0, -INF),
    ONE_ROW(log2, -TINY, NAN),
    ONE_ROW(log2, INF, INF),
    ONE_ROW(log10, 1.0, 0.0),
    ONE_ROW(log10, 1000.0, 3.0),
    ONE_ROW(log10, 1e22, 22.0),
    ONE_ROW(log10, 0.001, -3.0),
    ONE_ROW(log10, 0.0, -INF),
    ONE_ROW(log10, -1.0, NAN),
    ONE_ROW(log10, INF, INF),
};

static const RowTwo two_rows[] = {
    // F.10.1.4
    TWO_ROW(atan2, 0.0, -0.0, PI),
    TWO_ROW(atan2, -0.0, -0.0, -PI),
    TWO_ROW(atan2, 0.0, 0.0, 0.0),
    TWO_ROW(atan2, -0.0, 0.0, -0.0),
    TWO_ROW(atan2, 0.0, -1.0, PI),
    TWO_ROW(atan2, -0.0, -1.0, -PI),
    TWO_ROW(atan2, -0.0, 1.0, -0.0),
    TWO_ROW(atan2, -1.0, 0.0, -PI / 2),
    TWO_ROW(atan2, 1.0, -0.0, PI / 2),
    TWO_ROW(atan2, 1.0, -INF, PI),
    TWO_ROW(atan2, -1.0, -INF, -PI),
    TWO_ROW(atan2, 1.0, INF, 0.0),
    TWO_ROW(atan2, -1.0, INF, -0.0),
    TWO_ROW(atan2, INF, 1.0, PI / 2),
    TWO_ROW(atan2, -INF, -1.0, -PI / 2),
    TWO_ROW(atan2, INF, -INF, 0x1.2d97c7f3321d2p+1),
    TWO_ROW(atan2, INF, INF, PI / 4),
    TWO_ROW(atan2, -INF, INF, -PI / 4),
    TWO_ROW(atan2, NAN, 1.0, NAN),
    TWO_ROW(atan2, 1.0, NAN, NAN),
    TWO_ROW(atan2, NAN, INF, NAN),
    // tiny ratios: y / x is rounded once; ties are rounded down, because the arc tangent is smaller than its argument
    TWO_ROW(atan2, TINY, 1.0, TINY),
    TWO_ROW(atan2, TINY, 2.0, 0.0),
    TWO_ROW(atan2, 3 * TINY, 2.0, TINY),
    TWO_ROW(atan2, 5 * TINY, 2.0, 2 * TINY),
    TWO_ROW(atan2, -3 * TINY, 4.0, -TINY),
    TWO_ROW(atan2, TINY, HUGE, 0.0),
    TWO_ROW(atan2, -TINY, HUGE, -0.0),
    TWO_ROW(atan2, 0x1p-100, 1.0, 0x1p-100),
    TWO_ROW(atan2, TINY, -1.0, PI),
    TWO_ROW(atan2, HUGE, TINY, PI / 2),
    TWO_ROW(atan2, TINY, TINY, PI / 4),
    TWO_ROW(atan2, HUGE, HUGE, PI / 4),
    // F.10.4.4
    TWO_ROW(pow, 0.0, -3.0, INF),
    TWO_ROW(pow, -0.0, -3.0, -INF),
    TWO_ROW(pow, -0.0, -2.0, INF),
    TWO_ROW(pow, -0.0, -0.5, INF),
    TWO_ROW(pow, 0.0, -INF, INF),
    TWO_ROW(pow, -0.0, -INF, INF),
    TWO_ROW(pow, -0.0, 3.0, -0.0),
    TWO_ROW(pow, 0.0, 3.0, 0.0),
    TWO_ROW(pow, -0.0, 2.0, 0.0),
    TWO_ROW(pow, -0.0, 0.5, 0.0),
    TWO_ROW(pow, -1.0, INF, 1.0),
    TWO_ROW(pow, -1.0, -INF, 1.0),
    TWO_ROW(pow, 1.0, NAN, 1.0),
    TWO_ROW(pow, 1.0, INF, 1.0),
    TWO_ROW(pow, NAN, 0.0, 1.0),
    TWO_ROW(pow, NAN, -0.0, 1.0),
    TWO_ROW(pow, INF, 0.0, 1.0),
    TWO_ROW(pow, -2.0, 0.5, NAN),
    TWO_ROW(pow, -HUGE, 0.1, NAN),
    TWO_ROW(pow, 0.5, -INF, INF),
    TWO_ROW(pow, 2.0, -INF, 0.0),
    TWO_ROW(pow, -0.5, INF, 0.0),
    TWO_ROW(pow, -2.0, INF, INF),
    TWO_ROW(pow, -INF, -3.0, -0.0),
    TWO_ROW(pow, -INF, -2.0, 0.0),
    TWO_ROW(pow, -INF, 3.0, -INF),
    TWO_ROW(pow, -INF, 2.0, INF),
    TWO_ROW(pow, INF, -1.0, 0.0),
    TWO_ROW(pow, INF, 1.0, INF),
    TWO_ROW(pow, NAN, 1.0, NAN),
    TWO_ROW(pow, 2.0, NAN, NAN),
    // all doubles of at least 2^53 in magnitude are even integers
    TWO_ROW(pow, -1.0, 0x1p+53, 1.0),
    TWO_ROW(pow, -1.0, 0x1.fffffffffffffp+52, -1.0),
    TWO_ROW(pow, -1.0, HUGE, 1.0),
    TWO_ROW(pow, -2.0, 3.0, -8.0),
    TWO_ROW(pow, -2.0, -2.0, 0.25),
    // exact results, and midpoints, which are rounded to even
    TWO_ROW(pow, 9.0, 0.5, 3.0),
    TWO_ROW(pow, 9.0, 1.5, 27.0),
    TWO_ROW(pow, 54.125, 2.0, 2929.515625),
    TWO_ROW(pow, 3.0, 33.0, 5559060566555523.0),
    TWO_ROW(pow, 2.0, -1074.0, TINY),
    TWO_ROW(pow, 2.0, -1075.0, 0.0),
    TWO_ROW(pow, 0x1.8p-537, 2.0, 2 * TINY),
    TWO_ROW(pow, 4.0, 511.5, 0x1p+1023),
    TWO_ROW(pow, 2.0, 1024.0, INF),
    TWO_ROW(pow, -2.0, 1025.0, -INF),
    TWO_ROW(pow, -2.0, -1077.0, -0.0),
    TWO_ROW(pow, 10.0, 0.3, 1.9952623149688795),
    TWO_ROW(pow, 2.5, 1.5, 3.952847075210474),
    TWO_ROW(pow, 10.0, 22.0, 1e22),
    // overflow and underflow
    TWO_ROW(pow, HUGE, 1.0, HUGE),
    TWO_ROW(pow, TINY, 1.0, TINY),
    TWO_ROW(pow, TINY, -1.0, INF),
    TWO_ROW(pow, HUGE, -1.0, 0x1p-1024),
    TWO_ROW(pow, HUGE, HUGE, INF),
    TWO_ROW(pow, HUGE, -HUGE, 0.0),
    TWO_ROW(pow, TINY, HUGE, 0.0),
    TWO_ROW(pow, HUGE, TINY, 1.0),
    TWO_ROW(pow, TINY, TINY, 1.0),
    TWO_ROW(pow, 1.0, HUGE, 1.0),
    TWO_ROW(pow, 0x1.0000000000001p+0, HUGE, INF),
    TWO_ROW(pow, 0x1.fffffffffffffp-1, HUGE, 0.0),
    TWO_ROW(pow, 0x1.0000000000001p+0, 1.0, 0x1.0000000000001p+0),
};

static void test_unary_special_values(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(one_rows); i++)
        for (int k = 0; k < 3; k++)
            assert_number(one_rows[i].text, one_rows[i].functions[k](one_rows[i].x), one_rows[i].wanted);
}

static void test_binary_special_values(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(two_rows); i++)
        for (int k = 0; k < 3; k++)
            assert_number(two_rows[i].text, two_rows[i].functions[k](two_rows[i].x, two_rows[i].y), two_rows[i].wanted);
}

// A NaN that results from arguments other than NaN has no sign bit, so its bits are the same on every processor.
static void test_new_nan_has_no_sign(void **state) {
    (void)state;
    const double results[] = {maths_sin(INF), maths_tan(-INF), maths_asin(2),
                              maths_acos(-2), maths_log(-1),   maths_pow(-2, 0.5)};
    for (size_t i = 0; i < COUNT_OF(results); i++) {
        assert_claim("result", isnan(results[i]));
        assert_claim("result", !signbit(results[i]));
    }
}

// Odd and even functions are exactly symmetric.
static void test_functions_are_symmetric(void **state) {
    (void)state;
    uint64_t seed = 4;
    for (int i = 0; i < 20000; i++) {
        double x = ldexp((double)(next_bits(&seed) >> 11) * 0x1p-53, (int)(next_bits(&seed) % 80) - 40);
        double y = (double)(next_bits(&seed) >> 11) * 0x1p-53;
        assert_number("sin", maths_sin(-x), -maths_sin(x));
        assert_number("cos", maths_cos(-x), maths_cos(x));
        assert_number("tan", maths_tan(-x), -maths_tan(x));
        assert_number("asin", maths_asin(-y), -maths_asin(y));
        assert_number("atan2", maths_atan2(-x, y), -maths_atan2(x, y));
        assert_number("pow", maths_pow(-y, 5), -maths_pow(y, 5));
    }
}

TEST_GROUP(maths_special) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_unary_special_values), cmocka_unit_test(test_binary_special_values),
        cmocka_unit_test(test_new_nan_has_no_sign), cmocka_unit_test(test_functions_are_symmetric)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
