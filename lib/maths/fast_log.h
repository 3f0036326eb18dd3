// fast_log.h: logarithms and powers in lanes.
//
// Tang (ACM TOMS 16, 1990): x = 2^k m with m in [0.6875, 1.375), and from the table a short r near 1/m with -ln r in
// two parts: ln x = k ln2 - ln r + ln(1 + z), z = r m - 1 exactly (the generator asserts that z is a double), |z| ≤
// 2^-8.
//
// The error, with u = 2^-53 and c = z^3/3 - z^4/4 + … ≈ z^3/3:
//   k ln2 - ln r   the upper parts are multiples of 2^-42 and their sum is exact; the lower parts are rounded and cut
//                  off by at most (|k| + 3) 2^-97
//   z - z^2/2      three doubles, exactly: sums with their rests, the square with its low half
//   c              its last terms, z^9 / 9 and later: z^10 / 10 < 2^-57 |c| is cut off, and the factor z^6 / 9 is
//                  replaced by the nearest parabola in z^2 (Chebyshev), 2^-48 / 288 < 2^-54.5 / 3 away for |z| ≤ 2^-8.
//                  The rounded square, z times it, times a sum of six terms (less than 2 u), the product: all of it
//                  less than 5.1 u |c|
//   low            its sum has c as the largest term or rests below u |high|: two roundings of the former, 2 u |c|, and
//                  four of what is below 1.1 u |high| + 2^-34: 2^-104 |high|
// together below 7.5 u |c| + 2^-96 |high|. The generator asserts |z|^3 ≤ 2^-15.9 |ln x| in each row (|c| is at most
// 0.34 |z|^3), so this is less than 2^-67.6 |ln x|; LOG_ERROR covers it, and what log2 and log10 add (2^-104).
#ifndef PETRI_MATHS_FAST_LOG_H
#define PETRI_MATHS_FAST_LOG_H

#include "maths/fast_exp.h"

#define LOG_ERROR 0x1.4p-67
#define LOG_CUBE_ERROR 0x1p-50 // 7.5 u, and more

#define LOG_REACH 0x1p-16 // |z|^2 is not larger

#define LOG_FIRST UINT64_C(0x3fe6000000000000) // 0.6875

// The logarithm of lanes that hold positive normal numbers is high + low; low is below 2^-15 |high|. *cube: see above.
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
    // r has 10 bits: both products are exact, and so are both sums.
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

// log2 and log10: the natural logarithm times a constant of two parts.
KERNEL Lanes log_lanes_scaled(Real x, double scale_high, double scale_low, Real *result) {
    Real high, low, cube;
    log_parts(x, &high, &low, &cube);
    Real product = high * real_set(scale_high), rest = real_two_product_error(high, real_set(scale_high), product);
    rest = real_muladd(high, real_set(scale_low), real_muladd(low, real_set(scale_high), rest));
    Real error = real_absolute(product) * real_set(LOG_ERROR);
    return LANES_BOTH(lanes_decide(product, rest, error, result), lanes_positive_normal(x));
}

// x^y = e^(y ln x). With ln x = high + low, t = y (high + low) is again two parts, wrong by at most |y| times the error
// of the logarithm and 2^-103 |t|; that is the relative error that e^t adds to its own. |t| < 708.
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

#endif
