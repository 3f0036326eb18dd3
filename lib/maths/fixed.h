// fixed.h: fixed-point numbers of many bits, for the cases that doubles cannot decide.
//
// A Fixed is a whole number in two's complement, in units ("ulps" here) of 2^-(64 size): `size` limbs of fraction,
// lowest first, and one limb of whole part with the sign. All numbers of one computation have one size. Nothing is
// allocated; results may be the same object as arguments.
#ifndef PETRI_MATHS_FIXED_H
#define PETRI_MATHS_FIXED_H

#include <stdbool.h>
#include <stdint.h>

#define FIXED_MAX_LIMBS 12

typedef struct Fixed {
    int size; // limbs of the fraction; 1 … FIXED_MAX_LIMBS, one more while a turn is reduced
    uint64_t limb[FIXED_MAX_LIMBS + 2];
} Fixed;

// Exact conversions; bits of x below one ulp are cut off (towards zero). |x| < 2^63.
Fixed fixed_from_double(double x, int size);
Fixed fixed_from_int(int64_t x, int size);
// The first `size` limbs of a constant of maths_tables.h, which has `limbs` limbs of fraction: less than an ulp too
// small.
Fixed fixed_constant(const uint64_t *constant, int limbs, int size);

bool fixed_is_negative(const Fixed *a);
Fixed fixed_negate(const Fixed *a);
Fixed fixed_add(const Fixed *a, const Fixed *b);
Fixed fixed_sub(const Fixed *a, const Fixed *b);
// a 2^shift; a shift to the right cuts off. |shift| < 64 size.
Fixed fixed_scale(const Fixed *a, int shift);
// Less than an ulp below the product; the quotient less an ulp nearer to 0.
Fixed fixed_mul(const Fixed *a, const Fixed *b);
Fixed fixed_div_small(const Fixed *a, uint32_t by);
// a times a whole number below 2^63, exact unless it overflows.
Fixed fixed_mul_small(const Fixed *a, uint64_t by);
// 1 / a and 1 / sqrt(a) for a in [1/2, 2), within 16 ulps.
Fixed fixed_inverse(const Fixed *a);
Fixed fixed_inverse_root(const Fixed *a);

// 1/first! ± x/(first + stride)! + x^2/(first + 2 stride)! ± … up to 1/last!, for 0 ≤ x < 2^-6: within 3 ulps.
typedef struct Series {
    int first, last, stride; // last - first is a multiple of the stride
    bool alternating;
} Series;
Fixed fixed_series(const Fixed *x, Series series);

// A double near a: its error is below 2^-50 |a| + 1 ulp.
double fixed_to_double(const Fixed *a);
// The double nearest to a 2^scale, ties to even.
double fixed_round(const Fixed *a, int scale);
// If all numbers within 2^slack ulps of a round to the same double (times 2^scale), that is *result.
bool fixed_decides(const Fixed *a, int slack, int scale, double *result);

// --- functions; each is within 2^16 ulps of the exact value of its argument
// e^r for |r| < 1.
Fixed fixed_exp(const Fixed *r);
// The sine and the cosine of r for |r| < 1.
void fixed_sin_cos(const Fixed *r, Fixed *sine, Fixed *cosine);
// ln(m 2^exponent) for a double m in [1/2, 2).
Fixed fixed_log(double m, int exponent, int size);
// atan(b / a) for 0 ≤ b ≤ a and 1/2 ≤ a ≤ 1.
Fixed fixed_atan(const Fixed *b, const Fixed *a);
// x - quadrant pi/2 for a finite x: in [-pi/4, pi/4]. Whole turns are left out of the quadrant.
Fixed fixed_reduce(double x, int size, int *quadrant);

#endif
