// test_roots.c: roots and inverses by fused multiply-add (fused_roots.h) have the bits of sqrt and of a division, in
// the cases that are hardest to round, in all exponents, and for random squares: 2 million, or as many millions as the
// environment variable ROOTS says.
#include "hard_roots.h"
#include "roots_isa.h"
#include "support.h"

#include <float.h>

enum { BATCH = 4096 };

typedef struct Squares {
    double at[BATCH];
    size_t count;
    uint64_t total, excluded;
} Squares;

static void check_batch(Squares *squares) {
#if defined(__x86_64__)
    static RootCheck *const checks[CPU_LEVELS] = {[CPU_AVX2] = check_roots_avx2, [CPU_AVX512] = check_roots_avx512};
    while (squares->count % 8)
        squares->at[squares->count++] = 2;
    for (int level = CPU_AVX2; level <= (int)cpu_detected.level && cpu_detected.fma; level++) {
        size_t wrong = checks[level](squares->at, squares->count, &squares->excluded);
        if (wrong < squares->count)
            fail_msg("%s: the root of %a, or its inverse, is wrong", cpu_name((CpuLevel)level), squares->at[wrong]);
    }
#endif
    squares->total += squares->count;
    squares->count = 0;
}

static void add_square(Squares *squares, double square) {
    squares->at[squares->count++] = square;
    if (squares->count == BATCH)
        check_batch(squares);
}

// Adds the square times each power of 4 for which it is normal.
static void add_scaled(Squares *squares, double square, int step) {
    for (int power = -1022; power <= 1020; power += step)
        add_square(squares, ldexp(square, power));
}

static void test_hard_roots_are_exact(void **state) {
    (void)state;
    Squares squares = {0};
    for (size_t i = 0; i < COUNT_OF(hard_squares); i++)
        add_scaled(&squares, hard_squares[i], 2);
    check_batch(&squares);
}

// The squares of a hard root are those whose root is rounded to it.
static void test_inverses_of_hard_roots_are_exact(void **state) {
    (void)state;
    Squares squares = {0};
    for (size_t i = 0; i < COUNT_OF(hard_roots); i++) {
        double root = ldexp((double)hard_roots[i], -52), square = root * root, first = square;
        while (sqrt(nextafter(first, 0)) == root)
            first = nextafter(first, 0);
        for (double x = sqrt(first) == root ? first : nextafter(first, 4); sqrt(x) == root; x = nextafter(x, 8))
            add_scaled(&squares, x, 2);
    }
    check_batch(&squares);
    // The first argument that one step of Newton's iteration fails, on a processor of 2022.
    add_square(&squares, 0x1.0d5f392d40881p+6);
    check_batch(&squares);
}

// Where nothing is excluded, a lattice with distances of any size uses the fast way.
static void test_few_squares_are_excluded(void **state) {
    (void)state;
    Squares squares = {0};
    for (int i = 1; i <= 4096; i++)
        add_square(&squares, (double)i / 16 + 0x1p-30);
    check_batch(&squares);
    assert_int_equal(squares.excluded, 0);
    const double excluded[] = {
        0, DBL_TRUE_MIN, DBL_MIN, 0x1p-901, INFINITY, NAN, 1, 4, 16, 1 + 7 * DBL_EPSILON, 4 - 8 * DBL_EPSILON};
    for (size_t i = 0; i < COUNT_OF(excluded); i++)
        for (int lane = 0; lane < 8; lane++)
            add_square(&squares, excluded[i]);
    uint64_t added = squares.count;
    check_batch(&squares);
    assert_int_equal(squares.excluded, added * (cpu_detected.level - CPU_SCALAR));
}

static void test_random_roots_are_exact(void **state) {
    (void)state;
    const char *wish = getenv("ROOTS");
    uint64_t count = (wish ? strtoull(wish, NULL, 10) : 2) * 1000000, kind;
    Dice dice = {1};
    Squares squares = {0};
    while (squares.total + squares.count < count) {
        uint64_t bits = dice_next(&dice);
        kind = bits >> 60;
        double root = ldexp((double)(bits << 12 >> 12 | UINT64_C(1) << 52), (int)(bits >> 52 & 63) - 84);
        double square = root * root;
        if (kind < 4) // a neighbour of the square of a middle between two doubles
            square = (double)((long double)root * (long double)root * (1 + 0x1p-53L));
        add_square(&squares, kind < 8 ? square : root);
    }
    check_batch(&squares);
}

TEST_GROUP(roots) {
    if (!cpu_detected.fma)
        return GROUP_SKIPPED;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hard_roots_are_exact), cmocka_unit_test(test_inverses_of_hard_roots_are_exact),
        cmocka_unit_test(test_few_squares_are_excluded), cmocka_unit_test(test_random_roots_are_exact)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
