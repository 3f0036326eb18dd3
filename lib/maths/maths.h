// maths.h: correctly rounded elementary functions.
//
// Each result, except that of maths_hypot, is the double nearest to the exact value, ties to even, so it does not
// depend on the compiler, C library, processor or instruction set. Special cases follow C17 Annex F, but the bits of a
// NaN, the exception flags and errno are unspecified. The rounding mode must be to nearest.
//
// The methods are described in fast.h, exact.c (Ziv's method), fast_exp.h, fast_log.h, fast_sincos.h, fast_arc.h and
// fixed.h.
#pragma once

double maths_sin(double x);
double maths_cos(double x);
double maths_tan(double x);
double maths_asin(double x);
double maths_acos(double x);
double maths_atan2(double y, double x);
double maths_exp(double x);
double maths_log(double x);
double maths_log2(double x);
double maths_log10(double x);
double maths_pow(double x, double y);

// Returns sqrt(x^2 + y^2) without intermediate overflow. The result is not correctly rounded,
// but bit-identical on every machine.
double maths_hypot(double x, double y);
