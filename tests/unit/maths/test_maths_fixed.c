// test_maths_fixed.c: fixed.h, compared with MPFR at higher precision. Each function must be within its documented
// error for every number of limbs.
#include "check.h"
#include "maths/fixed.h"

#include <mpfr.h>
#include <stdlib.h>

#define BITS 2000

static mpfr_t a, b, c, d;

static void parse_fixed(mpfr_t to, const Fixed *from) {
    bool negative = fixed_is_negative(from);
    Fixed x = negative ? fixed_negate(from) : *from;
    mpfr_set_ui(to, 0, MPFR_RNDN);
    for (int i = x.size; i >= 0; i--) {
        mpfr_mul_2si(to, to, 64, MPFR_RNDN);
        mpfr_add_ui(to, to, x.limb[i], MPFR_RNDN);
    }
    mpfr_mul_2si(to, to, -64 * x.size, MPFR_RNDN);
    if (negative)
        mpfr_neg(to, to, MPFR_RNDN);
}

// Checks that |found - wanted| is at most `limit` ulps.
static void check_near(const char *what, const Fixed *found, mpfr_t wanted, double limit) {
    parse_fixed(d, found);
    mpfr_sub(d, d, wanted, MPFR_RNDN);
    mpfr_mul_2si(d, d, 64 * found->size, MPFR_RNDN);
    double off = fabs(mpfr_get_d(d, MPFR_RNDN));
    if (!(off <= limit))
        print_error("%s: %g ulps with %d limbs\n", what, off, found->size);
    assert_claim(what, off <= limit);
}

static double unit(uint64_t *seed) {
    return (double)(next_bits(seed) >> 11) * 0x1p-53;
}

// Returns a random number in [0, 1) of the given size, and sets `to` to the same number.
static Fixed random_fixed(uint64_t *seed, int size, mpfr_t to) {
    Fixed r = fixed_from_int(0, size);
    for (int i = 0; i < size; i++)
        r.limb[i] = next_bits(seed);
    parse_fixed(to, &r);
    return r;
}

static const int sizes[] = {3, 6, 12};

static void test_arithmetic_is_within_error(void **state) {
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 3000; i++) {
        int size = sizes[i % 3];
        Fixed x = random_fixed(&seed, size, a), y = random_fixed(&seed, size, b), r;
        if (i & 4) {
            x = fixed_negate(&x);
            mpfr_neg(a, a, MPFR_RNDN);
        }
        if (i & 8) {
            y = fixed_negate(&y);
            mpfr_neg(b, b, MPFR_RNDN);
        }
        mpfr_add(c, a, b, MPFR_RNDN);
        r = fixed_add(&x, &y);
        check_near("add", &r, c, 0);
        mpfr_sub(c, a, b, MPFR_RNDN);
        r = fixed_sub(&x, &y);
        check_near("sub", &r, c, 0);
        mpfr_mul(c, a, b, MPFR_RNDN);
        r = fixed_mul(&x, &y);
        check_near("mul", &r, c, 1);
        uint32_t by = (uint32_t)(next_bits(&seed) >> 32) | 1;
        mpfr_div_ui(c, a, by, MPFR_RNDN);
        r = fixed_div_small(&x, by);
        check_near("div_small", &r, c, 1);
        mpfr_mul_ui(c, a, by, MPFR_RNDN);
        r = fixed_mul_small(&x, by);
        check_near("mul_small", &r, c, 0);
        int shift = (int)(next_bits(&seed) % 160) - 150;
        mpfr_mul_2si(c, a, shift, MPFR_RNDN);
        r = fixed_scale(&x, shift);
        check_near("scale", &r, c, 1);
        // y runs from 1/2 to 2.
        y = fixed_from_int(1, size);
        x.limb[size] = 0;
        x.limb[size - 1] |= UINT64_C(1) << 63;
        if (i & 16)
            x = fixed_scale(&x, 1);
        parse_fixed(a, &x);
        mpfr_ui_div(c, 1, a, MPFR_RNDN);
        r = fixed_inverse(&x);
        check_near("inverse", &r, c, 16);
        mpfr_rec_sqrt(c, a, MPFR_RNDN);
        r = fixed_inverse_root(&x);
        check_near("inverse_root", &r, c, 16);
    }
}

// Random numbers, ties, subnormal results, results that are too small to be subnormal, and results that overflow.
static void test_rounding_matches_mpfr(void **state) {
    (void)state;
    uint64_t seed = 2;
    mpfr_t rounded;
    mpfr_init2(rounded, 53);
    for (int i = 0; i < 30000; i++) {
        Fixed x = random_fixed(&seed, sizes[i % 3], a);
        if (i & 4) { // few bits, for ties and exact results
            memset(x.limb, 0, sizeof *x.limb * (size_t)x.size);
            x.limb[x.size - 1] = next_bits(&seed) >> (i % 12) << (i % 12 + (i >> 4) % 12);
        }
        if (i & 8)
            x = fixed_negate(&x);
        static const int scales[] = {0,     -20,   -1010, -1030, -1060, -1073, -1074,
                                     -1075, -1080, 1000,  1023,  1024,  1025,  1100};
        int scale = scales[next_bits(&seed) % COUNT_OF(scales)];
        parse_fixed(a, &x);
        mpfr_mul_2si(a, a, scale, MPFR_RNDN);
        mpfr_exp_t low = mpfr_get_emin(), high = mpfr_get_emax();
        mpfr_set_emin(-1073);
        mpfr_set_emax(1024);
        int side = mpfr_set(rounded, a, MPFR_RNDN);
        side = mpfr_check_range(rounded, side, MPFR_RNDN);
        mpfr_subnormalize(rounded, side, MPFR_RNDN);
        double wanted = mpfr_get_d(rounded, MPFR_RNDN);
        mpfr_set_emin(low);
        mpfr_set_emax(high);
        assert_claim("round", fixed_round(&x, scale) == wanted);
    }
    mpfr_clear(rounded);
}

static void test_functions_are_within_error(void **state) {
    (void)state;
    uint64_t seed = 3;
    double limit = 0x1p16;
    for (int i = 0; i < 1500; i++) {
        int size = sizes[i % 3];
        Fixed x = random_fixed(&seed, size, a), r, s;
        if (i & 4) {
            x = fixed_negate(&x);
            mpfr_neg(a, a, MPFR_RNDN);
        }
        mpfr_exp(c, a, MPFR_RNDN);
        r = fixed_exp(&x);
        check_near("exp", &r, c, limit);
        fixed_sin_cos(&x, &r, &s);
        mpfr_sin(c, a, MPFR_RNDN);
        check_near("sin", &r, c, limit);
        mpfr_cos(c, a, MPFR_RNDN);
        check_near("cos", &s, c, limit);
        double m = 0.703125 * (1 + unit(&seed));
        int exponent = (int)(next_bits(&seed) % 2000) - 1000;
        mpfr_set_d(c, m, MPFR_RNDN);
        mpfr_mul_2si(c, c, exponent, MPFR_RNDN);
        mpfr_log(c, c, MPFR_RNDN);
        r = fixed_log(m, exponent, size);
        check_near("log", &r, c, limit);
        r = random_fixed(&seed, size, b);
        r.limb[size - 1] |= UINT64_C(1) << 63;
        parse_fixed(b, &r);
        x = random_fixed(&seed, size, a);
        s = fixed_mul(&x, &r);
        parse_fixed(a, &s);
        mpfr_atan2(c, a, b, MPFR_RNDN);
        s = fixed_atan(&s, &r);
        check_near("atan", &s, c, limit);
    }
}

static void test_reduction_is_within_error(void **state) {
    (void)state;
    uint64_t seed = 4;
    mpfr_t pi;
    mpfr_init2(pi, 4000);
    mpfr_const_pi(pi, MPFR_RNDN);
    mpfr_mul_2si(pi, pi, -1, MPFR_RNDN);
    for (int i = 0; i < 2000; i++) {
        int size = sizes[i % 3], quadrant;
        double x = ldexp(1 + unit(&seed), (int)(next_bits(&seed) % 1050) - 27) * (i & 4 ? -1 : 1);
        Fixed r = fixed_reduce(x, size, &quadrant);
        mpfr_t turns, rest;
        mpfr_inits2(4000, turns, rest, (mpfr_ptr)0);
        mpfr_set_d(turns, x, MPFR_RNDN);
        mpfr_div(turns, turns, pi, MPFR_RNDN);
        mpfr_rint(rest, turns, MPFR_RNDN);
        mpfr_sub(turns, turns, rest, MPFR_RNDN);
        mpfr_mul(turns, turns, pi, MPFR_RNDN);
        check_near("turn", &r, turns, 4);
        mpfr_fmod_ui(rest, rest, 4, MPFR_RNDN);
        assert_int_equal((mpfr_get_si(rest, MPFR_RNDN) + 4) % 4, quadrant);
        mpfr_clears(turns, rest, (mpfr_ptr)0);
    }
    mpfr_clear(pi);
}

TEST_GROUP(maths_fixed) {
    mpfr_inits2(BITS, a, b, c, d, (mpfr_ptr)0);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_arithmetic_is_within_error), cmocka_unit_test(test_rounding_matches_mpfr),
        cmocka_unit_test(test_functions_are_within_error), cmocka_unit_test(test_reduction_is_within_error)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
