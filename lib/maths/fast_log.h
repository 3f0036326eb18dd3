// fast_log.h: fast paths of logarithms and powers, vectorised.
//
// Tang's method (ACM TOMS 16, 1990): x = 2^k m with m in [0.6875, 1.375). A table holds a short r near 1/m, and -ln r
// in two parts. Then ln x = k ln2 - ln r + ln(1 + z) with z = r m - 1, |z| ≤ 2^-8. generate_tables.py asserts
// that a double holds z exactly.
//
// Sources of error, with u = 2^-53 and c = z^3/3 - z^4/4 + … ≈ z^3/3:
//   k ln2 - ln r   the high parts are multiples of 2^-42, so their sum is exact; rounding and truncation of the low
//                  parts cost at most (|k| + 3) 2^-97
//   z - z^2/2      exact as three doubles: sums with their rounding errors, the square with its low part
//   c              terms beyond z^9 / 9 are dropped (below 2^-57 |c|). In the term z^9 / 9, z^6 / 9 is replaced with
//                  the nearest parabola in z^2 (Chebyshev), which differs by 2^-48 / 288 < 2^-54.5 / 3 for |z| ≤ 2^-8.
//                  The roundings are those of the square, its product with z, a sum of six terms (less than 2 u), and
//                  the final product: in all less than 5.1 u |c|
//   low            the sum of c and of rounding errors below u |high|. Two roundings of c cost 2 u |c|, and four
//                  roundings of terms below 1.1 u |high| + 2^-34 cost 2^-104 |high|
// The total is below 7.5 u |c| + 2^-96 |high|. The generator asserts |z|^3 ≤ 2^-15.9 |ln x| in each row, and |c| is at
// most 0.34 |z|^3. So the error is below 2^-67.6 |ln x|. LOG_ERROR covers this and the 2^-104 that log2 and log10 add.
#pragma once

#include "maths/fast_exp.h"

#define LOG_ERROR 0x1.4p-67    // bound of the relative error
#define LOG_CUBE_ERROR 0x1p-50 // factor of |c| in the total above; at least 7.5 u

#define LOG_REACH 0x1p-16 // maximum of z^2

#define LOG_FIRST UINT64_C(0x3fe6000000000000) // the bits of 0.6875

// Computes ln x as high + low for positive normal x, with |low| < 2^-15 |high|. Sets *cube to c (see above), from which
// the error bound follows.
KERNEL void log_parts(Real x, Real *high, Real *low, Real *cube) {
    Bits from = bits_of(x) - bits_set(LOG_FIRST), row = from >> 44 & bits_set(255);
    Real m = real_of(bits_of(x) - (from & bits_set(UINT64_C(0xfff) << 52)));
    Real k = lanes_exponent(from);
    Real entry[4];
    real_gather_table_row(log_table, row, entry);
    Real r = entry[0], lh = entry[1], ll = entry[2];
#if HAS_FMA
    Real z = real_muladd(r, m, real_set(-1));
#else
    // r has 10 bits, so both products and both sums are exact.
    Real upper = real_of(bits_of(m) & bits_set(~UINT64_C(0x7ffffff)));
    Real z = (r * upper - real_set(1)) + r * (m - upper);
#endif
    Real a = k * real_set(LOG_2_HIGH) + lh, s = a + z;
    Real square = z * z, halved = z * real_set(0.5), half = z * halved, t = s - half;
    Real rests = real_fast_two_sum_error(a, z, s) + ((s - t) - half);
    Real p1 = real_muladd(z, real_set(-1.0 / 4), real_set(1.0 / 3 + LOG_REACH * LOG_REACH * LOG_REACH / 288));
    Real p2 = real_muladd(z, real_set(-1.0 / 6), real_set(1.0 / 5 - LOG_REACH * LOG_REACH / 16));
    Real p3 = real_muladd(z, real_set(-1.0 / 8), real_set(1.0 / 7 + LOG_REACH / 6));
    p1 = real_muladd(square, real_muladd(square, p3, p2), p1);
    *cube = z * square * p1;
    Real tiny = real_muladd(k, real_set(LOG_2_LOW), ll) - real_two_product_error(z, halved, half);
    *high = t;
    *low = *cube + (rests + tiny);
}

KERNEL Lanes lanes_positive_normal(Real x) {
    return LANES_BOTH(lanes_less(x, real_set(__builtin_inf())), lanes_less(real_set(0x1.fffffffffffffp-1023), x));
}

KERNEL Lanes log_lanes(Real x, Real *result) {
    Real high, low, cube;
    log_parts(x, &high, &low, &cube);
    Real error = real_absolute(high) * real_set(LOG_ERROR);
    return LANES_BOTH(lanes_decide(high, low, error, result), lanes_positive_normal(x));
}

// Computes log2 or log10: the natural logarithm times a two-part constant.
KERNEL Lanes log_lanes_scaled(Real x, double scale_high, double scale_low, Real *result) {
    Real high, low, cube;
    log_parts(x, &high, &low, &cube);
    Real product = high * real_set(scale_high), rest = real_two_product_error(high, real_set(scale_high), product);
    rest = real_muladd(high, real_set(scale_low), real_muladd(low, real_set(scale_high), rest));
    Real error = real_absolute(product) * real_set(LOG_ERROR);
    return LANES_BOTH(lanes_decide(product, rest, error, result), lanes_positive_normal(x));
}

// Computes x^y = e^t with t = y ln x in two parts and |t| < 708. The error of t is at most |y| times the error of the
// logarithm, plus 2^-103 |t|. It becomes a relative error of e^t, in addition to that of the exponential function.
KERNEL Lanes pow_lanes(Real x, Real y, Real *result) {
    Real high, low, cube;
    log_parts(x, &high, &low, &cube);
    Real sum = high + low;
    low = real_fast_two_sum_error(high, low, sum);
    Real t = y * sum, tail = real_muladd(y, low, real_two_product_error(y, sum, t));
    Real error = real_muladd(real_absolute(y * cube), real_set(2 * LOG_CUBE_ERROR), real_set(2 * EXP_ERROR));
    Bits exponent;
    Real mantissa, rest;
    exp_parts(t, tail, &exponent, &mantissa, &rest);
    Lanes good =
        LANES_BOTH(lanes_decide(mantissa, rest, error, result), lanes_less(real_absolute(t), real_set(EXP_MAX)));
    good = LANES_BOTH(good, lanes_positive_normal(x));
    *result = real_of(bits_of(*result) + exponent);
    return good;
}
