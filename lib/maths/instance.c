// instance.c: the scalar functions for one instruction set, named by INSTANCE: maths_sin_plain and so on.
//
// Each asks its fast path first. What that cannot decide (once in some thousand arguments), and all that is special, is
// left to exact_….
#include "maths/fast.h"

#define LANES 1
#include "maths/fast_arc.h"
#include "maths/fast_exp.h"
#include "maths/fast_log.h"
#include "maths/fast_turn.h"

#ifndef INSTANCE
#define INSTANCE plain
#endif
#define JOIN(name, instance) maths_##name##_##instance
#define NAMED(name, instance) JOIN(name, instance)
#define FUNCTION(name) NAMED(name, INSTANCE)

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

static Turn large_turn(double x) {
    Turn turn;
    exact_turn(x, &turn.n, &turn.high, &turn.low);
    return turn;
}

static inline bool is_large(double x) {
    double a = real_absolute(x);
    return a >= TURN_LARGEST && a < DOUBLE_INFINITY;
}

static bool large_sine(double x, unsigned quarter, double *result) {
    Turn turn = large_turn(x);
    Arc arc = turn_arc(&turn);
    Row row = turn_row(turn.n + 256 * quarter);
    double high, low;
    turn_sine(&row, &arc, &high, &low);
    return turn_decide(high, low, result);
}

double FUNCTION(sin)(double x) {
    double result;
    return sin_lanes(x, 0, &result) || (is_large(x) && large_sine(x, 0, &result)) ? result : exact_sin(x);
}

double FUNCTION(cos)(double x) {
    double result;
    return sin_lanes(x, 1, &result) || (is_large(x) && large_sine(x, 1, &result)) ? result : exact_cos(x);
}

double FUNCTION(tan)(double x) {
    double result;
    if (!(real_absolute(x) < DOUBLE_INFINITY))
        return exact_tan(x);
    Turn turn = is_large(x) ? large_turn(x) : turn_reduce(x);
    return tan_fast(&turn, &result) ? result : exact_tan(x);
}

double FUNCTION(atan2)(double y, double x) {
    double result;
    return atan2_fast(y, x, &result) ? result : exact_atan2(y, x);
}

#ifdef INSTANCE_NEAR
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
