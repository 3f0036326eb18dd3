// fast_exp.h: fast path of the exponential function, vectorised. Computes e^(x + tail), where the tail is the low part
// of the argument.
//
// Tang's method (ACM TOMS 15, 1989): x = k ln2/128 + r and e^x = 2^(k/128) e^r. A table holds 2^(i/128) as two doubles.
//
// Sources of error relative to 2^(k/128), with u = 2^-53 and |r| ≤ 2^-8.5 (1 + 2^-40):
//   k ln2/128    rounding and truncation of k EXP_STEP_LOW, |k| < 2^17.1       2 · 2^-79.5
//   r            x - k EXP_STEP_HIGH is exact (35 + 18 bits; the difference is a multiple of 2^-61 below 2^-8); the
//                square uses r + rest, rounded: r u |r|                        2^-70
//   series       truncated after r^6 / 6!: r^7 / 5040                          2^-71.8
//                r^2 (1/2 + …): four roundings of terms below 2^-17.9          2^-68.9 (2^-17.9 · 4 u / 2)
//   sums         rest + series, th q, and the sum with three smaller terms:
//                at most six roundings of terms below 2^-17.8                  2^-68.2
//   table        both parts together                                           2^-107
// The total is below 2^-67.2, so EXP_ERROR is large enough. 2^(i/128) is below 2, so the absolute
// error of high + low is below 2 EXP_ERROR.
#pragma once

#include "maths/lanes.h"
#include "maths/maths_tables.h"

#define EXP_ERROR 0x1p-67 // bound of the error relative to 2^(k/128)
#define EXP_MAX 708.0     // for smaller |x| the result neither overflows nor is subnormal

// Computes e^(x + tail) = 2^(exponent / 2^52) (high + low) for |x| < EXP_MAX. high is in [0.99, 2), |low| < 2^-16.
KERNEL void exp_parts(Real x, Real tail, Bits *exponent, Real *high, Real *low) {
    Bits number;
    Real k = real_steps(x, EXP_STEPS_PER_ONE, &number);
    Real r = x - k * real_set(EXP_STEP_HIGH), rest = tail - k * real_set(EXP_STEP_LOW);
    Bits row = (number & bits_set(127)) << 1;
    Real th = real_gather_table(&exp_table[0][0], row), tl = real_gather_table(&exp_table[0][1], row);
    Real s = r + rest, square = s * s;
    Real upper = real_muladd(s, real_set(1.0 / 120), real_set(1.0 / 24));
    Real lower = real_muladd(s, real_set(1.0 / 6), real_set(0.5));
    upper = real_muladd(square, real_set(1.0 / 720), upper);
    Real q = real_muladd(square, real_muladd(square, upper, lower), rest);
    Real p = th * r, pl = real_two_product_error(th, r, p);
    *high = th + p;
    *low = real_fast_two_sum_error(th, p, *high) + (real_muladd(th, q, real_muladd(tl, r, tl)) + pl);
    *exponent = (number & bits_set(~UINT64_C(127))) << 45;
}

KERNEL Lanes exp_lanes(Real x, Real *result) {
    Bits exponent;
    Real high, low;
    exp_parts(x, real_set(0), &exponent, &high, &low);
    Lanes good = LANES_BOTH(lanes_decide(high, low, real_set(2 * EXP_ERROR), result),
                            lanes_less(real_absolute(x), real_set(EXP_MAX)));
    *result = real_of(bits_of(*result) + exponent);
    return good;
}
