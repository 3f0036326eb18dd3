// fast.h: what the instances of the fast paths offer (maths_isa.c, once per instruction set), and what stands behind
// them.
//
// A fast path either returns the correctly rounded result or leaves the case to the exact_ function, which decides all.
#ifndef PETRI_MATHS_FAST_H
#define PETRI_MATHS_FAST_H

#include <stddef.h>
#include <stdint.h>

// name and parameters of the scalar functions
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

// exact_pow for x ≥ 0 or an even or no whole y; the sign of the result for the other cases: 1, -1, or 0 if it is nan.
double exact_pow_sign(double x, double y);

// Doubles near ln m for m in [1/2, 2), and atan q for q in [0, 1].
double fast_log_near(double m);
double fast_atan_near(double q);

// x = (n pi/512 mod 2 pi) + high + low for any finite x of at least 1; |high| ≤ pi/1024, up to 2^-110.
void exact_reduction(double x, uint64_t *n, double *high, double *low);

#endif
