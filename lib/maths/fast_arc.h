// fast_arc.h: asin, acos, atan2 and tan, one number at a time: they take branches.
//
// asin and atan: Taylor series around the nearest c = i/128, f(c + d) = a0 + a1 d + a2 d^2 + …, the first two
// coefficients in two parts. |d| ≤ 2^-8. The error, with u = 2^-53:
//   argument   high + low: a quotient or a root, corrected once, 2^-104 relatively; d = high - c is exact; low counts
//              in a1 d and a2 d^2: what is left is below 3 |a3| d^2 |low| < 2^-70
//   series     atan is cut after d^8: |a9| ≤ 1/9, 2^-75; asin, c ≤ 1/2, after d^9: |a10| < 24, 2^-75. In row 0 the
//              terms left are below 2^-75 |d|, too
//   a2 d^2     |a2| ≤ 0.39; |a2| ≤ c for c > 0, 0 for c = 0: four roundings of what is below 2^-15.9 f in each row, and
//              four more in the sum: 8 u 2^-15.9 f < 2^-65.9 f
//   a0, a1 d   exact but for 2^-104
// asin and acos of |x| > 1/2 use s = sqrt((1 - |x|) / 2) ≤ 1/2: acos |x| = 2 asin s, asin |x| = pi/2 - 2 asin s; the
// differences from pi/2 and pi are at least half of what is taken away. ARC_ERROR covers all of them.
//
// tan = sine / cosine, with the quotient corrected once: the sum of both relative errors, and 2^-100.
#ifndef PETRI_MATHS_FAST_ARC_H
#define PETRI_MATHS_FAST_ARC_H

#include "maths/doubles.h"
#include "maths/fast_turn.h"

#define ARC_ERROR 0x1p-65
#define TAN_ERROR 0x1p-63

// a + b for |a| ≥ |b| or a = 0, with what is lower, as high + low.
KERNEL void arc_sum(double a, double b, double lower, double *high, double *low) {
    *high = a + b;
    *low = real_add_low(a, b, *high) + lower;
}

// A row of atan_table (COUNT = 7) or asin_table (8) at c + d + rest.
KERNEL void arc_series(const double *row, int count, double d, double rest, double *high, double *low) {
    const double *a = row + 4;
    double sum = a[count - 1];
    for (int i = count - 2; i >= 0; i--)
        sum = real_muladd(d, sum, a[i]);
    double p = row[2] * d, pl = real_mul_low(row[2], d, p);
    double slope = real_muladd(2 * a[0], d, row[2]);
    double small = real_muladd(d * d, sum, real_muladd(slope, rest, real_muladd(row[3], d, row[1]) + pl));
    arc_sum(row[0], p, small, high, low);
}

// asin of s + rest, 0 ≤ s ≤ 1/2
KERNEL void asin_parts(double s, double rest, double *high, double *low) {
    Bits i;
    double c = real_steps(s, 128, &i) * (1.0 / 128);
    arc_series(asin_table[i], 8, s - c, rest, high, low);
}

// acos |x| / 2 for |x| > 1/2
KERNEL void half_acos_parts(double x, double *high, double *low) {
    double square = (1 - x) * 0.5, s = __builtin_sqrt(square), p = s * s; // 1 - x is exact
    double rest = ((square - p) - real_mul_low(s, s, p)) / (s + s);
    asin_parts(s, rest, high, low);
}

KERNEL bool asin_fast(double x, double *result) {
    double a = real_absolute(x), high, low;
    if (!(a <= 1))
        return false;
    if (a <= 0.5)
        asin_parts(a, 0, &high, &low);
    else {
        half_acos_parts(a, &high, &low);
        arc_sum(HALF_PI_HIGH, -2 * high, HALF_PI_LOW - 2 * low, &high, &low);
    }
    bool good = lanes_decide(high, low, high * ARC_ERROR, result) & (a > 0x1p-27);
    *result = double_with_sign(*result, x);
    return good;
}

KERNEL bool acos_fast(double x, double *result) {
    double a = real_absolute(x), high, low;
    if (!(a < 1))
        return false;
    if (a <= 0.5) {
        asin_parts(a, 0, &high, &low);
        double sign = double_with_sign(1, -x);
        arc_sum(HALF_PI_HIGH, sign * high, HALF_PI_LOW + sign * low, &high, &low);
    } else {
        half_acos_parts(a, &high, &low);
        if (x < 0)
            arc_sum(PI_HIGH, -2 * high, PI_LOW - 2 * low, &high, &low);
        else {
            high *= 2;
            low *= 2;
        }
    }
    return lanes_decide(high, low, high * ARC_ERROR, result);
}

// atan(b / a), 0 ≤ b ≤ a, both far from the ends of the range
KERNEL void atan_parts(double b, double a, double *high, double *low) {
    double q = b / a, p = q * a, rest = ((b - p) - real_mul_low(q, a, p)) / a;
    Bits i;
    double c = real_steps(q, 128, &i) * (1.0 / 128);
    arc_series(atan_table[i], 7, q - c, rest, high, low);
}

KERNEL bool atan2_fast(double y, double x, double *result) {
    double a = real_absolute(x), b = real_absolute(y), high, low;
    double small = a < b ? a : b, large = a < b ? b : a;
    // All steps are then far from under- and overflow; nan fails, too.
    if (!(small > 0x1p-400 && large < 0x1p400 && small > 0x1p-50 * large))
        return false;
    atan_parts(small, large, &high, &low);
    // The four octants of a half turn: a constant plus or minus the angle.
    if (a < b) {
        double sign = double_with_sign(1, -x);
        arc_sum(HALF_PI_HIGH, sign * high, HALF_PI_LOW + sign * low, &high, &low);
    } else if (x < 0)
        arc_sum(PI_HIGH, -high, PI_LOW - low, &high, &low);
    bool good = lanes_decide(high, low, high * ARC_ERROR, result);
    *result = double_with_sign(*result, y);
    return good;
}

KERNEL bool tan_fast(const Turn *turn, double *result) {
    Arc arc = turn_arc(turn);
    double sh, sl, ch, cl;
    turn_sine(turn, &arc, 0, &sh, &sl);
    turn_sine(turn, &arc, 1, &ch, &cl);
    arc_sum(sh, sl, 0, &sh, &sl);
    arc_sum(ch, cl, 0, &ch, &cl);
    double q = sh / ch, p = q * ch;
    double rest = (((sh - p) - real_mul_low(q, ch, p)) + (sl - q * cl)) / ch;
    // The reduction's absolute error counts where the sine or the cosine is small.
    double least = real_absolute(sh) < real_absolute(ch) ? real_absolute(sh) : real_absolute(ch);
    return lanes_decide(q, rest, real_absolute(q) * TAN_ERROR, result) & (least > 0x1p-28);
}

#endif
