// fast_sincos.h: fast paths of sine and cosine, vectorised.
//
// The argument is reduced to x = n pi/512 + r with pi/512 in three parts P1, P2, P3 (Cody and Waite, 1980). A table
// holds S and C, the sine and cosine of n pi/512 (Tang, 1991). Then
//   sin x = S + C r + [S (cos r - 1) + C (sin r - r)], and cos x is the sine of x plus a quarter turn.
//
// Sources of error, with u = 2^-53 (rounding x changes it by at most u |x|),
// |r| ≤ pi/1024 (1 + 2^-20) < 2^-8.34, |n| < 2^24:
//   reduction    n P1 and n P2 are exact (29 + 24 bits), x - n P1 is exact, n P3 < 2^-43.3 is rounded, P1 + P2 + P3 is
//                pi/512 up to 2^-122. The absolute error is below 2^-95, and 0 for n = 0
//   cos r - 1    at most 2^-17.69. Truncation after r^6/720: 2^-82. Roundings: the square (u), the sum near 1/2 (u/2)
//                multiplied by it, and the addition of r low: 2^-71, or 1.93 · 2^-70 without a fused multiply-add
//   S (cos r-1)  the product and two later sums that are not larger: at most 3 · 2^-71 S
//   sin r - r    at most 2^-27.6. Truncation after r^7/5040: 2^-85 |r|. Roundings: below 2^-77 |C r|
//   C r, S       exact up to 2^-104
// The total is below 3.5 · 2^-70 S + 2^-76 |sin x| + 2^-95. S / |sin x| is at most 2 (for n = 1, r = -pi/1024) and
// smaller for larger n. So the error is below 2^-67.1 |sin x| + 2^-95.
#pragma once

#include "maths/lanes.h"
#include "maths/maths_tables.h"

#define SINCOS_ERROR 0x1.2p-67         // bound of the error relative to the result
#define SINCOS_REDUCTION_ERROR 0x1p-94 // bound of the absolute error, which is added to that
#define SINCOS_MAX 65536.0             // for smaller |x|, |n| is below 2^24

// An argument reduced to x = n pi/512 + high + low.
typedef struct ReducedArgument {
    Bits n;
    Real high, low;
} ReducedArgument;

// Reduces x for |x| < SINCOS_MAX.
KERNEL ReducedArgument sincos_reduce(Real x) {
    ReducedArgument turn;
    Real n = real_steps(x, SINCOS_STEPS_PER_ONE, &turn.n);
    Real a = x - n * real_set(SINCOS_STEP_1), b = -n * real_set(SINCOS_STEP_2), s = a + b;
    Real rest = real_two_sum_error(a, b, s) - n * real_set(SINCOS_STEP_3);
    turn.high = s + rest;
    turn.low = real_two_sum_error(s, rest, turn.high);
    return turn;
}

// Terms that depend only on the reduced argument r.
typedef struct Arc {
    Real high;   // high part of r
    Real versed; // cos r - 1, the negated versine
    Real bent;   // sin r - r, plus the low part of r
} Arc;

KERNEL Arc sincos_arc(const ReducedArgument *turn) {
    Real r = turn->high, square = r * r;
    Real versed = real_muladd(square, real_set(-1.0 / 720), real_set(1.0 / 24));
    versed = real_muladd(square, versed, real_set(-0.5));
    versed = real_muladd(square, versed, -r * turn->low);
    Real bent = real_muladd(square, real_set(-1.0 / 5040), real_set(1.0 / 120));
    bent = real_muladd(square, bent, real_set(-1.0 / 6));
    bent = real_muladd(square * r, bent, turn->low);
    return (Arc){r, versed, bent};
}

// Sine sh + sl and cosine ch + cl of n pi/512.
typedef struct Row {
    Real sh, sl, ch, cl; // high and low part of each
} Row;

KERNEL Real real_flip(Real a, Bits sign) {
    return real_of(bits_of(a) ^ sign);
}

// Returns the table row for n. In odd quadrants the table is read backwards, at index 256 - (n mod 256).
KERNEL Row sincos_row(Bits n) {
    Bits backwards = bits_set(0) - (n >> 8 & bits_set(1)), index = n & bits_set(255);
    index = (index ^ backwards) + (backwards & bits_set(257));
    Bits sine_sign = (n & bits_set(512)) << 54, cosine_sign = ((n + bits_set(256)) & bits_set(512)) << 54;
    Real row[4];
    real_gather_table_row(sincos_table, index, row);
    return (Row){real_flip(row[0], sine_sign), real_flip(row[1], sine_sign), real_flip(row[2], cosine_sign),
                 real_flip(row[3], cosine_sign)};
}

// Returns the row for an angle that is a quarter turn larger.
KERNEL Row sincos_quarter(const Row *row) {
    return (Row){row->ch, row->cl, -row->sh, -row->sl};
}

// Computes the sine of the angle that `row` and `arc` describe, as high + low.
KERNEL void sincos_sine(const Row *row, const Arc *arc, Real *high, Real *low) {
    Real p = row->ch * arc->high, pl = real_two_product_error(row->ch, arc->high, p);
    Real small = real_muladd(row->cl, arc->high, row->sl) + pl;
    small = real_muladd(row->ch, arc->bent, small);
    *high = row->sh + p;
    small = real_muladd(row->sh, arc->versed, small);
    *low = real_fast_two_sum_error(row->sh, p, *high) + small;
}

KERNEL Lanes sincos_decide(Real high, Real low, Real *result) {
    Real error = real_muladd(real_absolute(high), real_set(SINCOS_ERROR), real_set(SINCOS_REDUCTION_ERROR));
    return lanes_decide(high, low, error, result);
}

// Computes the sine of x plus `quarters` quarter turns. Returns the lanes with a final result.
KERNEL Lanes sin_lanes(Real x, Bits quarters, Real *result) {
    ReducedArgument turn = sincos_reduce(x);
    Arc arc = sincos_arc(&turn);
    Row row = sincos_row(turn.n + (quarters << 8));
    Real high, low;
    sincos_sine(&row, &arc, &high, &low);
    return LANES_BOTH(sincos_decide(high, low, result), lanes_less(real_absolute(x), real_set(SINCOS_MAX)));
}
