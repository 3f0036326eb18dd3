// maths.h: elementary functions whose bits mathematics defines.
//
// Each result is the double nearest to the exact value, ties to even: the same with every compiler, C library,
// processor and instruction set. Special cases are those of C17 Annex F. What is not a number comes out as a nan; no
// exception flag and no errno means anything. The processor must round to nearest.
//
// How it is done: fast.h (Ziv's two steps), fast_exp.h, fast_log.h, fast_sincos.h, fast_arc.h, fixed.h.
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

// sqrt(x^2 + y^2) without overflow in between: the same everywhere, but with more than one rounding.
double maths_hypot(double x, double y);

#endif
