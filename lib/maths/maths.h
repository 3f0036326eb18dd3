// maths.h: correctly rounded elementary functions.
//
// Each result is the double nearest to the exact value, ties to even. So it is the same with every compiler, C library,
// processor and instruction set. Special cases follow C17 Annex F, but any NaN may be returned, and exception flags and
// errno are undefined. The processor must be in the rounding mode to nearest.
//
// The method is described in fast.h (Ziv's two steps), fast_exp.h, fast_log.h, fast_sincos.h, fast_arc.h and fixed.h.
#ifndef PETRI_MATHS_H
#define PETRI_MATHS_H

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

// Returns sqrt(x^2 + y^2) without intermediate overflow. Not correctly rounded, but the same on every machine.
double maths_hypot(double x, double y);

#endif
