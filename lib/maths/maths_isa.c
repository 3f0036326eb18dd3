// maths_isa.c: the scalar functions for one instruction set. MATHS_ISA is the name of the set,
// such as `plain` in maths_sin_plain.
//
// Each function tries its fast path first. If the rounding is uncertain (about one in a thousand arguments), or if the
// argument is special, it calls the exact_ function.
#include "maths/fast.h"
#include "maths/fast_arc.h"
#include "maths/fast_exp.h"
#include "maths/fast_log.h"
#include "maths/fast_sincos.h"

#ifndef MATHS_ISA
#define MATHS_ISA plain
#endif
#define JOIN(name, instance) maths_##name##_##instance
#define NAMED(name, instance) JOIN(name, instance)
#define FUNCTION(name) NAMED(name, MATHS_ISA)

#define FAST(name, fast)                                                                                               \
    double FUNCTION(name)(double x) {                                                                                  \
        double result;                                                                                                 \
        return fast(x, &result) ? result : exact_##name(x);                                                            \
    }
FAST(exp, exp_lanes)
FAST(log, log_lanes)
FAST(asin, asin_fast)
FAST(acos, acos_fast)

double FUNCTION(log2)(double x) {
    double result;
    return log_lanes_scaled(x, LOG_2E_HIGH, LOG_2E_LOW, &result) ? result : exact_log2(x);
}

double FUNCTION(log10)(double x) {
    double result;
    return log_lanes_scaled(x, LOG_10E_HIGH, LOG_10E_LOW, &result) ? result : exact_log10(x);
}

double FUNCTION(pow)(double x, double y) {
    double result;
    if (x < 0) {
        double sign = exact_pow_sign(x, y);
        return sign != 0 && pow_lanes(-x, y, &result) ? sign * result : exact_pow(x, y);
    }
    return pow_lanes(x, y, &result) ? result : exact_pow(x, y);
}

static ReducedArgument reduce_large(double x) {
    ReducedArgument turn;
    exact_reduction(x, &turn.n, &turn.high, &turn.low);
    return turn;
}

static inline bool is_large(double x) {
    double a = real_absolute(x);
    return a >= SINCOS_MAX && a < DOUBLE_INFINITY;
}

static bool sine_of_large(double x, unsigned quarter, double *result) {
    ReducedArgument turn = reduce_large(x);
    Arc arc = sincos_arc(&turn);
    Row row = sincos_row(turn.n + 256 * quarter);
    double high, low;
    sincos_sine(&row, &arc, &high, &low);
    return sincos_decide(high, low, result);
}

double FUNCTION(sin)(double x) {
    double result;
    return sin_lanes(x, 0, &result) || (is_large(x) && sine_of_large(x, 0, &result)) ? result : exact_sin(x);
}

double FUNCTION(cos)(double x) {
    double result;
    return sin_lanes(x, 1, &result) || (is_large(x) && sine_of_large(x, 1, &result)) ? result : exact_cos(x);
}

double FUNCTION(tan)(double x) {
    double result;
    if (!(real_absolute(x) < DOUBLE_INFINITY))
        return exact_tan(x);
    ReducedArgument turn = is_large(x) ? reduce_large(x) : sincos_reduce(x);
    return tan_fast(&turn, &result) ? result : exact_tan(x);
}

double FUNCTION(atan2)(double y, double x) {
    double result;
    return atan2_fast(y, x, &result) ? result : exact_atan2(y, x);
}

#ifdef MATHS_ISA_NEAR
double fast_log_near(double m) {
    double high, low, cube;
    log_parts(m, &high, &low, &cube);
    return high + low;
}

double fast_atan_near(double q) {
    double high, low;
    atan_parts(q, 1, &high, &low);
    return high + low;
}
#endif
