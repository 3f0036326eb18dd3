// wide.h: fixed-point numbers of many bits, for the cases that doubles cannot decide.
//
// A Wide is a whole number in two's complement, in units ("ulps" here) of 2^-(64 size): `size` limbs of fraction,
// lowest first, and one limb of whole part with the sign. All numbers of one computation have one size. Nothing is
// allocated; results may be the same object as arguments.
#ifndef PETRI_MATHS_WIDE_H
#define PETRI_MATHS_WIDE_H

#include <stdbool.h>
#include <stdint.h>

#define WIDE_MAX 12

typedef struct Wide {
    int size; // limbs of the fraction; 1 … WIDE_MAX, one more while a turn is reduced
    uint64_t limb[WIDE_MAX + 2];
} Wide;

// Exact conversions; bits of x below one ulp are cut off (towards zero). |x| < 2^63.
Wide wide_from_double(double x, int size);
Wide wide_from_int(int64_t x, int size);
// The first `size` limbs of a constant of maths_tables.h, which has `limbs` limbs of fraction: less than an ulp too
// small.
Wide wide_constant(const uint64_t *constant, int limbs, int size);

bool wide_is_negative(const Wide *a);
Wide wide_negate(const Wide *a);
Wide wide_add(const Wide *a, const Wide *b);
Wide wide_sub(const Wide *a, const Wide *b);
// a 2^shift; a shift to the right cuts off. |shift| < 64 size.
Wide wide_scale(const Wide *a, int shift);
// Less than an ulp below the product; the quotient less an ulp nearer to 0.
Wide wide_mul(const Wide *a, const Wide *b);
Wide wide_div_small(const Wide *a, uint32_t by);
// a times a whole number below 2^63, exact unless it overflows.
Wide wide_mul_small(const Wide *a, uint64_t by);
// 1 / a and 1 / sqrt(a) for a in [1/2, 2), within 16 ulps.
Wide wide_inverse(const Wide *a);
Wide wide_inverse_root(const Wide *a);

// 1/first! ± x/(first + stride)! + x^2/(first + 2 stride)! ± … up to 1/last!, for 0 ≤ x < 2^-6: within 3 ulps.
typedef struct Series {
    int first, last, stride; // last - first is a multiple of the stride
    bool alternating;
} Series;
Wide wide_series(const Wide *x, Series series);

// A double near a: its error is below 2^-50 |a| + 1 ulp.
double wide_near(const Wide *a);
// The double nearest to a 2^scale, ties to even.
double wide_round(const Wide *a, int scale);
// If all numbers within 2^slack ulps of a round to the same double (times 2^scale), that is *result.
bool wide_decides(const Wide *a, int slack, int scale, double *result);

// --- functions; each is within 2^16 ulps of the exact value of its argument
// e^r for |r| < 1.
Wide wide_exp(const Wide *r);
// The sine and the cosine of r for |r| < 1.
void wide_sin_cos(const Wide *r, Wide *sine, Wide *cosine);
// ln(m 2^exponent) for a double m in [1/2, 2).
Wide wide_log(double m, int exponent, int size);
// atan(b / a) for 0 ≤ b ≤ a and 1/2 ≤ a ≤ 1.
Wide wide_atan(const Wide *b, const Wide *a);
// x - quadrant pi/2 for a finite x: in [-pi/4, pi/4]. Whole turns are left out of the quadrant.
Wide wide_turn(double x, int size, int *quadrant);

#endif
