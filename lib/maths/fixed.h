// fixed.h: multi-word fixed-point arithmetic, for results that the fast paths cannot round with certainty.
//
// A Fixed is a two's complement integer in units of 2^-(64 size), called ulps here. It has `size` 64-bit limbs of
// fraction, lowest first, and one limb for the sign and the integer part. All numbers of a computation must have the
// same size. Nothing is allocated. A result may be assigned to one of the arguments.
#pragma once

#include <stdbool.h>
#include <stdint.h>

#define FIXED_MAX_LIMBS 12

typedef struct Fixed {
    int size; // number of limbs of the fraction: 1 to FIXED_MAX_LIMBS, or one more inside fixed_reduce
    uint64_t limb[FIXED_MAX_LIMBS + 2];
} Fixed;

// Convert x, |x| < 2^63. Bits below one ulp are truncated towards zero; otherwise the result is exact.
Fixed fixed_from_double(double x, int size);
Fixed fixed_from_int(int64_t x, int size);
// Returns a constant of maths_tables.h, truncated from FIXED_MAX_LIMBS to `size` limbs of fraction. The result is too
// small by less than an ulp.
Fixed fixed_constant(const uint64_t *constant, int size);

bool fixed_is_negative(const Fixed *a);
Fixed fixed_negate(const Fixed *a);
Fixed fixed_add(const Fixed *a, const Fixed *b);
Fixed fixed_sub(const Fixed *a, const Fixed *b);
// Returns a * 2^shift, truncated if the shift is negative. Requires |shift| < 64 size.
Fixed fixed_scale(const Fixed *a, int shift);
// fixed_mul returns the product a * b. Truncation makes it too small by less than an ulp. fixed_div_small returns the
// quotient a / by, truncated towards zero.
Fixed fixed_mul(const Fixed *a, const Fixed *b);
Fixed fixed_div_small(const Fixed *a, uint32_t by);
// Returns a * by for by < 2^63. The result is exact, except that the integer part is reduced modulo 2^64.
Fixed fixed_mul_small(const Fixed *a, uint64_t by);
// Return 1 / a and 1 / sqrt(a) for a in [1/2, 2), within 16 ulps.
Fixed fixed_inverse(const Fixed *a);
Fixed fixed_inverse_root(const Fixed *a);

// The series 1/first! ± x/(first + stride)! + x^2/(first + 2 stride)! ± …, up to the term with the divisor last!.
typedef struct Series {
    int first, last, stride; // last - first is a multiple of the stride
    bool alternating;
} Series;
// Returns the sum of a series for 0 ≤ x < 2^-6, within 3 ulps.
Fixed fixed_series(const Fixed *x, Series series);

// Converts a Fixed to a double with an error below 2^-50 |a| + 1 ulp.
double fixed_to_double(const Fixed *a);
// Returns the double nearest to a * 2^scale, ties to even.
double fixed_round(const Fixed *a, int scale);
// If all numbers within 2^slack ulps of a, multiplied by 2^scale, round to the same double, sets *result to that double
// and returns true.
bool fixed_decides(const Fixed *a, int slack, int scale, double *result);

// --- elementary functions, with errors below 2^16 ulps
// Returns e^r for |r| < 1.
Fixed fixed_exp(const Fixed *r);
// Computes sine and cosine of r for |r| < 1.
void fixed_sin_cos(const Fixed *r, Fixed *sine, Fixed *cosine);
// Returns ln(m 2^exponent) for a double m in [1/2, 2).
Fixed fixed_log(double m, int exponent, int size);
// Returns atan(b / a) for 0 ≤ b ≤ a and 1/2 ≤ a ≤ 1.
Fixed fixed_atan(const Fixed *b, const Fixed *a);
// Returns x - q pi/2 for a finite x and the integer q nearest to x / (pi/2). Sets *quadrant to q modulo 4.
Fixed fixed_reduce(double x, int size, int *quadrant);
