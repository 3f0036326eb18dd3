// test_maths_arrays.c: array functions with 1, 2, 4 and 8 lanes, and streams of normal variates, return the same bits
// as the scalar functions.
#include "check.h"
#include "maths/arrays.h"
#include "maths/maths.h"
#include "maths/random.h"

#define COUNT 4099 // not a multiple of any lane count
#define EXTRA 8    // number of elements after the results that must not change

typedef struct Lanes {
    const char *name;
    const ArraysIsa *instance;
} Lanes;

// Stores the instruction levels of this processor in `lanes`. Returns their number.
static size_t find_isas(Lanes *lanes) {
    size_t count = 0;
    lanes[count++] = (Lanes){"1 lane", &maths_arrays_plain};
    lanes[count++] = (Lanes){"2 lanes", &maths_arrays_pair};
#if defined(__x86_64__)
    if (cpu_detected.fma)
        lanes[count++] = (Lanes){"4 lanes", &maths_arrays_avx2};
    if (cpu_detected.level >= CPU_AVX512)
        lanes[count++] = (Lanes){"8 lanes", &maths_arrays_avx512};
#endif
    return count;
}

static double x[COUNT], y[COUNT], out[COUNT + EXTRA];

// Fills an array with numbers of all magnitudes and special values, so that some lanes of a vector need the accurate
// path.
static void fill_arguments(uint64_t *seed, double low, double high, bool special) {
    static const double odd[] = {0.0, -0.0, INFINITY, -INFINITY, NAN,  0x1p-1074, -0x1p-1030, 0x1.fffffffffffffp+1023,
                                 1.0, -1.0, 2.0,      0.5,       1e10, -1e300,    710,        -745.1};
    for (size_t i = 0; i < COUNT; i++) {
        x[i] = low + (high - low) * (double)(next_bits(seed) >> 11) * 0x1p-53;
        y[i] = -20 + 40 * (double)(next_bits(seed) >> 11) * 0x1p-53;
        if (special && next_bits(seed) % 5 == 0)
            x[i] = odd[next_bits(seed) % COUNT_OF(odd)];
        if (special && next_bits(seed) % 9 == 0)
            y[i] = odd[next_bits(seed) % COUNT_OF(odd)];
        if (special && next_bits(seed) % 5 == 0)
            memcpy(&x[i], &(uint64_t){next_bits(seed)}, sizeof *x);
    }
    for (size_t i = 0; i < COUNT + EXTRA; i++)
        out[i] = -77;
}

static void check_array(const char *row, const double *found, double (*one)(double), double (*two)(double, double),
                        const double *second, size_t step) {
    for (size_t i = 0; i < COUNT; i++)
        assert_number(row, found[i], one ? one(x[i]) : two(x[i], second[step * i]));
    for (size_t i = COUNT; i < COUNT + EXTRA; i++)
        assert_number(row, found[i], -77);
}

static void test_arrays_match_scalars(void **state) {
    (void)state;
    static const double ranges[][2] = {{-3, 3}, {0, 1}, {-800, 800}, {0.99, 1.01}, {-1e5, 1e5}};
    Lanes lanes[4];
    size_t count = find_isas(lanes);
    uint64_t seed = 5;
    for (size_t k = 0; k < count; k++)
        for (size_t r = 0; r < 2 * COUNT_OF(ranges); r++) {
            const ArraysIsa *instance = lanes[k].instance;
            const char *name = lanes[k].name;
            fill_arguments(&seed, ranges[r / 2][0], ranges[r / 2][1], r % 2);
            instance->exp(x, COUNT, out);
            check_array(name, out, maths_exp, NULL, NULL, 0);
            instance->log(x, COUNT, out);
            check_array(name, out, maths_log, NULL, NULL, 0);
            instance->pow(x, y, 1, COUNT, out);
            check_array(name, out, NULL, maths_pow, y, 1);
            for (int i = 0; i < 4; i++) {
                const double power[] = {3, 2.5, -1, 0.1};
                instance->pow(x, &power[i], 0, COUNT, out);
                check_array(name, out, NULL, maths_pow, &power[i], 0);
            }
            instance->turns_sin(x, COUNT, out);
            check_array(name, out, turns_sin, NULL, NULL, 0);
        }
}

// The results may overwrite the arguments. Memory after the end of a short array is not accessed.
static void test_result_may_overwrite_arguments(void **state) {
    (void)state;
    for (int level = 0; level <= (int)cpu_detected.level; level++)
        for (size_t n = 0; n < 20; n++) {
            double values[24], wanted[24];
            for (size_t i = 0; i < 24; i++) {
                values[i] = 0.3 + (double)i;
                wanted[i] = i < n ? maths_pow(maths_exp(maths_log(values[i])), 1.7) : values[i];
            }
            maths_arrays((CpuLevel)level)->log(values, n, values);
            maths_arrays((CpuLevel)level)->exp(values, n, values);
            maths_arrays((CpuLevel)level)->pow(values, &(double){1.7}, 0, n, values);
            for (size_t i = 0; i < 24; i++)
                assert_number("in place", values[i], wanted[i]);
        }
}

static void test_uniform_array_matches_items(void **state) {
    (void)state;
    Lanes lanes[4];
    size_t count = find_isas(lanes);
    for (size_t k = 0; k < count; k++)
        for (uint64_t key = 1; key; key *= UINT64_C(0x9e3779b97f4a7c16)) {
            uint64_t first = key >> 7;
            lanes[k].instance->uniform(key, first, 37, out);
            for (uint64_t i = 0; i < 37; i++)
                assert_number(lanes[k].name, out[i], random_uniform(key, first + i));
        }
}

static void test_normals_match_items(void **state) {
    (void)state;
    uint64_t key = UINT64_C(0x03953eea0e693074);
    double found[700];
    for (int level = 0; level <= (int)cpu_detected.level; level++)
        for (size_t first = 0; first < 5; first++)
            for (size_t n = 0; n < 700; n = n * 2 + 1) {
                random_normals((CpuLevel)level, key, first, n, found);
                for (size_t i = 0; i < n; i++)
                    assert_number("normals", found[i], random_normal(key, first + i));
            }
}

// Compares turns_sin of huge arguments with a computation that uses the quotient of C's remquo.
static void test_sine_of_turns_matches_remquo(void **state) {
    (void)state;
    uint64_t seed = 9;
    for (int i = 0; i < 100000; i++) {
        double t = ldexp(1 + (double)(next_bits(&seed) >> 12) * 0x1p-52, (int)(next_bits(&seed) % 80) - 10);
        int quadrant;
        double angle = remquo(t * 4, 1.0, &quadrant) * 1.5707963267948966;
        double wanted = quadrant & 1 ? maths_cos(angle) : maths_sin(angle);
        assert_number("turns", turns_sin(t), quadrant & 2 ? -wanted : wanted);
    }
    assert_number("infinity", turns_sin(INFINITY), NAN);
    assert_number("-0", turns_sin(-0.0), -0.0);
    assert_number("whole", turns_sin(0x1p60), 0);
}

TEST_GROUP(maths_arrays) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arrays_match_scalars), cmocka_unit_test(test_result_may_overwrite_arguments),
        cmocka_unit_test(test_uniform_array_matches_items), cmocka_unit_test(test_normals_match_items),
        cmocka_unit_test(test_sine_of_turns_matches_remquo)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
