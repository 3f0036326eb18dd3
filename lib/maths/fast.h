// fast.h: internal declarations of the elementary functions.
//
// Each function has a fast path, compiled once per instruction set (maths_isa.c). If the fast path cannot round the
// result with certainty, it calls the exact_ function (exact.c), which handles all arguments.
#pragma once

#include <stddef.h>
#include <stdint.h>

// X-macro: applies ONE to the names of functions with one parameter, and TWO to those with two.
#define MATHS_FUNCTIONS(ONE, TWO)                                                                                      \
    ONE(sin)                                                                                                           \
    ONE(cos)                                                                                                           \
    ONE(tan)                                                                                                           \
    ONE(asin)                                                                                                          \
    ONE(acos)                                                                                                          \
    ONE(exp)                                                                                                           \
    ONE(log)                                                                                                           \
    ONE(log2)                                                                                                          \
    ONE(log10)                                                                                                         \
    TWO(atan2)                                                                                                         \
    TWO(pow)

#define DECLARE_ONE(name)                                                                                              \
    double exact_##name(double x);                                                                                     \
    double maths_##name##_plain(double x);                                                                             \
    double maths_##name##_fma(double x);
#define DECLARE_TWO(name)                                                                                              \
    double exact_##name(double x, double y);                                                                           \
    double maths_##name##_plain(double x, double y);                                                                   \
    double maths_##name##_fma(double x, double y);
MATHS_FUNCTIONS(DECLARE_ONE, DECLARE_TWO)
#undef DECLARE_ONE
#undef DECLARE_TWO

// Returns the sign of x^y for a negative x: -1 for odd integers y, 1 for even integers y, else 0 (the result is NaN).
double exact_pow_sign(double x, double y);

// Return approximations. fast_log_near approximates ln m for m in [1/2, 2), and fast_atan_near approximates atan q for
// q in [0, 1].
double fast_log_near(double m);
double fast_atan_near(double q);

// Finds n, high and low such that x equals n pi/512 + high + low modulo 2 pi, with |high| ≤ pi/1024. The error is at
// most 2^-110. x must be finite with |x| ≥ 1.
void exact_reduction(double x, uint64_t *n, double *high, double *low);
