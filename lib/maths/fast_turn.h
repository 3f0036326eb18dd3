// fast_turn.h: sine and cosine in lanes.
//
// Cody and Waite's reduction (1980) with three parts of pi/256: x = n pi/256 + r, and the addition theorems with sine and
// cosine of n pi/256 from a table (Gal's method with exact rows in place of accurate ones):
//   sin x = S + C r + [S (cos r - 1) + C (sin r - r)],   cos x = C - S r + [C (cos r - 1) - S (sin r - r)].
//
// The error, with u = 2^-53, |r| ≤ pi/512 (1 + 2^-20) < 2^-7.34, |n| < 2^24:
//   reduction   n P1 and n P2 are exact (29 + 24 bits), x - n P1 is exact, n P3 < 2^-42.3 is rounded, P1 + P2 + P3 is
//               pi/256 up to 2^-121: less than 2^-94 absolutely, 0 for n = 0
//   cos r - 1   cut after r^6/720: 2^-74; three roundings of something below 2^-15.7
//   sin r - r   cut after r^7/5040: 2^-84; roundings of something below 2^-24.6: 2^-75
//   S (cos r-1) its product and the four sums behind it: roundings of something below 2^-15.6 S
//   C r         exact as two doubles
// together below 8 u 2^-15.6 S + 2^-73 (S + r) + 2^-94 < 2^-65.5 |sin x| + 2^-94: S ≤ 2 |sin x| / (1 + 2^-8) in the row 1
// (n pi/256 is at most twice |x|), where S (cos r - 1) is 2^-6.3 times smaller than the result's bound assumes, and S is
// at most 1.34 |sin x| from row 2 on; 8 u covers it, as S r^2/2 / |sin x| is below 2^-15.7 · 1.34 only there.
#ifndef PETRI_MATHS_FAST_TURN_H
#define PETRI_MATHS_FAST_TURN_H

#include "maths/lanes.h"
#include "maths/maths_tables.h"

#define TURN_ERROR 0x1p-65
#define TURN_REDUCTION_ERROR 0x1p-92
#define TURN_LARGEST 131072.0 // |n| < 2^24

// x = n pi/256 + high + low for |x| < TURN_LARGEST
typedef struct Turn {
    Bits n;
    Real high, low;
} Turn;

KERNEL Turn turn_reduce(Real x) {
    Turn turn;
    Real n = real_steps(x, TURN_STEPS_PER_ONE, &turn.n);
    Real a = x - n * real_set(TURN_STEP_1), b = -n * real_set(TURN_STEP_2), s = a + b;
    Real rest = real_add_rest(a, b, s) - n * real_set(TURN_STEP_3);
    turn.high = s + rest;
    turn.low = real_add_rest(s, rest, turn.high);
    return turn;
}

// What sine and cosine need of r: cos r - 1 and sin r - r.
typedef struct Arc {
    Real high, versed, bent;
} Arc;

KERNEL Arc turn_arc(const Turn *turn) {
    Real r = turn->high, square = r * r;
    Real versed = real_muladd(square, real_set(-1.0 / 720), real_set(1.0 / 24));
    versed = real_muladd(square, versed, real_set(-0.5));
    versed = real_muladd(square, versed, -r * turn->low);
    Real bent = real_muladd(square, real_set(-1.0 / 5040), real_set(1.0 / 120));
    bent = real_muladd(square, bent, real_set(-1.0 / 6));
    bent = real_muladd(square * r, bent, turn->low);
    return (Arc){r, versed, bent};
}

// The sine of what a turn stands for, plus `quarter` (0 or 1) right angles, as high + low.
KERNEL void turn_sine(const Turn *turn, const Arc *arc, unsigned quarter, Real *high, Real *low) {
    Bits row = ((turn->n + bits_set(128 * quarter)) & bits_set(511)) << 2;
    Real sh = real_look_up(&turn_table[0][0], row), sl = real_look_up(&turn_table[0][1], row);
    Real ch = real_look_up(&turn_table[0][2], row), cl = real_look_up(&turn_table[0][3], row);
    Real p = ch * arc->high, pl = real_mul_low(ch, arc->high, p);
    Real small = real_muladd(cl, arc->high, sl) + pl;
    small = real_muladd(ch, arc->bent, small);
    small = real_muladd(sh, arc->versed, small);
    *high = sh + p;
    *low = real_add_low(sh, p, *high) + small;
}

KERNEL Lanes turn_decide(Real high, Real low, Real *result) {
    Real error = real_muladd(real_absolute(high), real_set(TURN_ERROR), real_set(TURN_REDUCTION_ERROR));
    return lanes_decide(high, low, error, result);
}

KERNEL Lanes sin_lanes(Real x, unsigned quarter, Real *result) {
    Turn turn = turn_reduce(x);
    Arc arc = turn_arc(&turn);
    Real high, low;
    turn_sine(&turn, &arc, quarter, &high, &low);
    return turn_decide(high, low, result) & lanes_less(real_absolute(x), real_set(TURN_LARGEST));
}

KERNEL Lanes sin_cos_lanes(Real x, Real *sine, Real *cosine) {
    Turn turn = turn_reduce(x);
    Arc arc = turn_arc(&turn);
    Real high, low;
    turn_sine(&turn, &arc, 0, &high, &low);
    Lanes good = turn_decide(high, low, sine);
    turn_sine(&turn, &arc, 1, &high, &low);
    return good & turn_decide(high, low, cosine) & lanes_less(real_absolute(x), real_set(TURN_LARGEST));
}

#endif
