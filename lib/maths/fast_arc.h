// fast_arc.h: fast paths of asin, acos, atan2 and tan. They need branches, so there are no vector variants.
//
// Each function f uses a Taylor series around the nearest c = i/128: f(c + d) = a0 + a1 d + a2 d^2 + … up to d^8, with
// |d| ≤ 2^-8. Only asin for x ≥ 1/16 uses other points c, and terms up to d^9. The coefficients a0 and a1 are stored as
// two doubles each. Below, f means f(c + d), and u is 2^-53. Rounding a number x changes it by at most u |x|. Sources
// of error:
//   d          exact for the high part of a two-part argument. The low part is used in a1 d + a2 d^2 only. In the other
//              terms it would contribute less than 3 |a3| d^2 u, which is below 2^-68 f for atan, or 2^-69 f in row 0
//   a0, a1 d   exact up to 2^-104
//   a2 d^2 …   the sum of these terms is called s below. The roundings of a square, two sums, a product, and three sums
//              with slightly larger terms change it by at most 8 u s
// atan (c ≤ 1): s ≤ 2^-15 f. In row 0, s is d^3/3; elsewhere |a2| ≤ c and f ≥ c - d, and c = 1/128 is the worst case.
// With |a9| ≤ 1/9 the truncated terms are below 2^-75. The total is below 2^-64.8 f.
// asin (c ≤ 1/16): |a2| ≤ 0.51 c, s ≤ 2^-16 f, and the argument has no low part. With |a9| ≤ 0.2 the truncated terms
// are below 2^-74. The total is below 2^-65.9 f.
//
// asin (1/16 ≤ x ≤ 15/16): |d| ≤ 2^-7 (1 - c), terms up to d^9, |a10 d^10| ≤ 0.013 · 2^-70. The generator asserts
// s < 2^-16 f, so the bound for c ≤ 1/16 also holds here. d is exact, because c has 11 bits and a - c has no bit below
// those of a.
//
// acos x = sqrt(1 - x) P(x) for x > 15/16, where P has no singularity near 1: s ≤ 0.09 · 2^-16, P ≥ 1.41, |a9| ≤ 0.02.
// The error is below 2^-69.9. The two-part root (2^-104) and the two-part product add 2^-72. The subtraction from pi/2
// or pi is exact up to 2^-105.
//
// tan = sine / cosine, with the quotient corrected once. The error is the sum of both relative errors and 2^-100. At
// most one of sine and cosine can have n = 1 or 255 (fast_sincos.h) or be smaller than 2^-12. So the sum is 2^-67.1 +
// 2^-67.8 + 2^-69, where the last term is due to the absolute error of the smaller function.
#pragma once

#include "maths/double_bits.h"
#include "maths/fast_sincos.h"

// Error bounds of the high and low part together. They are relative, except HALF_PI_ERROR.
#define ARC_ERROR 0x1.2p-66
#define ATAN_ERROR 0x1.4p-65
#define ACOS_ERROR 0x1.8p-70
#define HALF_PI_ERROR 0x1p-102 // absolute error of pi/2 in two parts, and of sums with it
#define TAN_ERROR 0x1.3p-66

// Computes a + b + lower as high + low. Requires |a| ≥ |b| or a = 0.
KERNEL void arc_sum(double a, double b, double lower, double *high, double *low) {
    *high = a + b;
    *low = real_fast_two_sum_error(a, b, *high) + lower;
}

#define ARC_COLUMNS 11 // numbers in each row of asin_table, acos_table and atan_table

// Returns the table row for i, where x = i/128 + d and i/128 is nearest to x. Sets *d exactly. The table starts with
// the row for i = first.
KERNEL const double *arc_row(const double (*table)[ARC_COLUMNS], unsigned first, double x, double *d) {
    Bits i;
    *d = x - real_steps(x, 128, &i) * (1.0 / 128);
    return table[i - first];
}

// Evaluates the series of a table row at d, as high + low.
KERNEL void arc_series(const double *row, double d, double *high, double *low) {
    const double *a = row + 4;
    // Estrin's scheme has a shorter dependency chain than Horner's.
    double square = d * d, third = real_muladd(d, a[5], a[4]);
    double sum = real_muladd(square, real_muladd(d, a[3], a[2]), real_muladd(d, a[1], a[0]));
    sum = real_muladd(square * square, real_muladd(square, a[6], third), sum);
    double p = row[2] * d, pl = real_two_product_error(row[2], d, p);
    double small = real_muladd(square, sum, real_muladd(row[3], d, row[1]) + pl);
    arc_sum(row[0], p, small, high, low);
}

// Adds first_high + first_low to high + low and sets *result to the rounded sum. Returns true if the rounding is
// certain.
KERNEL bool arc_decide(double first_high, double first_low, double high, double low, double error, double *result) {
    arc_sum(first_high, high, low + first_low, &high, &low);
    return lanes_decide(high, low, error, result);
}

// Computes acos(a) for a in [15/16, 1), where 1 - a is exact. The low part of the root is residue / (2 root). The
// equivalent residue * root * (0.5 / square) lets the processor divide while it computes the root.
KERNEL void acos_parts(double a, double *high, double *low) {
    double square = 1 - a, root = __builtin_sqrt(square);
    double d, h, l;
    const double *row = arc_row(acos_table, 120, a, &d);
    double rest = real_residue(square, root, root) * (root * (0.5 / square));
    arc_series(row, d, &h, &l);
    *high = root * h;
    *low = real_two_product_error(root, h, *high) + real_muladd(root, l, rest * h);
}

// Computes asin(a) for a in [1/16, 15/16]. The exponent and the upper 6 mantissa bits of 1 - a select the row.
KERNEL void steep_asin_parts(double a, double *high, double *low) {
    const double *row = steep_asin_table[(double_bits(1 - a) >> 46) - (UINT64_C(0x3fb0) << 2)], *t = row + 5;
    double d = a - row[0], square = d * d;
    double third = real_muladd(d, t[5], t[4]), last = real_muladd(d, t[7], t[6]);
    double sum = real_muladd(square, real_muladd(d, t[3], t[2]), real_muladd(d, t[1], t[0]));
    sum = real_muladd(square * square, real_muladd(square, last, third), sum);
    double p = row[3] * d, pl = real_two_product_error(row[3], d, p);
    arc_sum(row[1], p, real_muladd(square, sum, real_muladd(row[4], d, row[2]) + pl), high, low);
}

// Computes asin(a) for a in [0, 15/16].
KERNEL void asin_parts(double a, double *high, double *low) {
    if (a >= 0.0625)
        steep_asin_parts(a, high, low);
    else {
        double d;
        const double *row = arc_row(asin_table, 0, a, &d);
        arc_series(row, d, high, low);
    }
}

KERNEL bool asin_fast(double x, double *result) {
    double a = real_absolute(x), high, low;
    if (!(a < 1 && a > 0x1p-27))
        return false;
    bool good;
    if (a <= 0.9375) {
        asin_parts(a, &high, &low);
        good = lanes_decide(high, low, high * ARC_ERROR, result);
    } else {
        acos_parts(a, &high, &low);
        good = arc_decide(HALF_PI_HIGH, HALF_PI_LOW, -high, -low, high * ACOS_ERROR, result);
    }
    *result = double_with_sign(*result, x);
    return good;
}

KERNEL bool acos_fast(double x, double *result) {
    static const double first[2][3] = {{0, 0, 1}, {PI_HIGH, PI_LOW, -1}};
    double a = real_absolute(x), high, low;
    if (!(a < 1))
        return false;
    if (a <= 0.9375) {
        asin_parts(a, &high, &low);
        double error = real_muladd(high, ARC_ERROR, HALF_PI_ERROR);
        high = double_from_bits(double_bits(high) ^ (~double_bits(x) & DOUBLE_SIGN));
        low = double_from_bits(double_bits(low) ^ (~double_bits(x) & DOUBLE_SIGN));
        return arc_decide(HALF_PI_HIGH, HALF_PI_LOW, high, low, error, result);
    }
    const double *constant = first[double_is_negative(x)];
    double sign = constant[2];
    acos_parts(a, &high, &low);
    return arc_decide(constant[0], constant[1], sign * high, sign * low, high * ACOS_ERROR, result);
}

// Computes atan(b / a) for 0 ≤ b ≤ a, both far from overflow and underflow.
KERNEL void atan_parts(double b, double a, double *high, double *low) {
    double inverse = 1 / a, q = b * inverse, rest = real_residue(b, q, a) * inverse, d;
    const double *row = arc_row(atan_table, 0, q, &d);
    arc_series(row, d, high, low);
    *low += real_muladd(2 * row[4], d, row[2]) * rest; // low part of the quotient times the derivative
}

KERNEL bool atan2_fast(double y, double x, double *result) {
    // Indexed by |y| > |x| and x < 0: the angle to add (high and low part) and the sign of the arc tangent.
    static const double plans[2][2][3] = {{{0, 0, 1}, {PI_HIGH, PI_LOW, -1}},
                                          {{HALF_PI_HIGH, HALF_PI_LOW, -1}, {HALF_PI_HIGH, HALF_PI_LOW, 1}}};
    double a = real_absolute(x), b = real_absolute(y), high, low;
    double small = a < b ? a : b, large = a < b ? b : a;
    // These limits prevent overflow and underflow and reject NaN. They also keep the angle so large that the error of
    // pi (2^-105) is negligible.
    if (!(small > 0x1p-400 && large < 0x1p400 && small > 0x1p-36 * large))
        return false;
    atan_parts(small, large, &high, &low);
    const double *plan = plans[a < b][double_is_negative(x)];
    bool good = arc_decide(plan[0], plan[1], plan[2] * high, plan[2] * low, high * ATAN_ERROR, result);
    *result = double_with_sign(*result, y);
    return good;
}

KERNEL bool tan_fast(const ReducedArgument *turn, double *result) {
    Arc arc = sincos_arc(turn);
    Row row = sincos_row(turn->n), next = sincos_quarter(&row);
    double sh, sl, ch, cl;
    sincos_sine(&row, &arc, &sh, &sl);
    sincos_sine(&next, &arc, &ch, &cl);
    arc_sum(sh, sl, 0, &sh, &sl);
    arc_sum(ch, cl, 0, &ch, &cl);
    double inverse = 1 / ch, q = sh * inverse;
    double rest = (real_residue(sh, q, ch) + (sl - q * cl)) * inverse;
    // If the sine or cosine is smaller, the absolute error of the reduction is too large relative to it.
    bool large = real_absolute(sh) > 0x1p-26 && real_absolute(ch) > 0x1p-26;
    return lanes_decide(q, rest, real_absolute(q) * TAN_ERROR, result) && large;
}
