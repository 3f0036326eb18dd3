// maths.c: element-wise functions (spec builtins.md B1), and functions of pairs and vectors (B2).
#include "maths/maths.h"

#include "base/number.h"
#include "builtin/family.h"
#include "maths/random.h"

#include <math.h>

static double fract(double x) {
    return x - number_floor(x);
}

// Unlike turns_sin and turns_cos, this function does not first reduce the angle to one turn (B1.1).
static double turns_tan(double x) {
    return maths_tan(x * BUILTIN_TAU);
}

static double turns_asin(double x) {
    return maths_asin(x) / BUILTIN_TAU;
}

static double turns_acos(double x) {
    return maths_acos(x) / BUILTIN_TAU;
}

// Defines a built-in whose function has a faster version for arrays, `many`.
#define ELEMENT_WISE_ARRAY(name, function, many)                                                                       \
    BUILTIN_IS(name, builtin_each_array(context->arena, args[0], function, many))

static void turns_cos_array(const double *t, size_t count, double *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = t[i] + 0.25; // same rounding as turns_cos
    maths_arrays(cpu_detected.level)->turns_sin(to, count, to);
}

ELEMENT_WISE(abs, fabs)
ELEMENT_WISE(ceil, ceil)
ELEMENT_WISE(floor, number_floor)
ELEMENT_WISE(fract, fract)
ELEMENT_WISE(sqrt, sqrt)
ELEMENT_WISE_ARRAY(exp, maths_exp, maths_arrays(cpu_detected.level)->exp)
ELEMENT_WISE_ARRAY(log, maths_log, maths_arrays(cpu_detected.level)->log)
ELEMENT_WISE(log2, maths_log2)
ELEMENT_WISE(log10, maths_log10)
ELEMENT_WISE_ARRAY(sin, turns_sin, maths_arrays(cpu_detected.level)->turns_sin)
ELEMENT_WISE_ARRAY(cos, turns_cos, turns_cos_array)
ELEMENT_WISE(asin, turns_asin)
ELEMENT_WISE(acos, turns_acos)

// Returns true near multiples of a quarter turn, where the tangent needs extended precision.
static bool is_steep(double turns) {
    double quarters = turns * 4;
    return fabs(quarters - floor(quarters + 0.5)) < 0x1p-24;
}

Value builtin_tan(BuiltinContext *context, const Value *args, uint32_t count) {
    enum { STEEP_WORK = 300 };
    uint64_t steep = 0;
    for (uint32_t i = 0; value_is_numeric(args[0]) && i < args[0].len; i++)
        steep += is_steep(value_numbers(&args[0])[i]);
    arena_charge(context->arena, steep * STEEP_WORK);
    return builtin_each(context->arena, args[0], turns_tan);
    (void)count;
}

// Computes roundhalfaway(x * s) / s (B1.4). For d decimals, s is 10^d, or 0 if d < 0.
Value builtin_round(BuiltinContext *context, const Value *args, uint32_t count) {
    Value xs = args[0], ys = value_or(args[1], value_number(0));
    if (!value_is_numeric(xs) || !value_is_number(ys))
        return VALUE_NULL;
    double digits = floor(ys.as.number);
    if (digits > 18)
        return xs;
    double scale = isnan(digits) ? NAN : digits < 0 ? 0 : 1; // powers of ten up to 10^22 are exact
    for (int i = 0; i < digits; i++)
        scale *= 10;
    const double *x = value_numbers(&xs);
    if (xs.len == 1)
        return value_number(round(x[0] * scale) / scale);
    double *result = arena_alloc_array(context->arena, xs.len, sizeof *result);
    for (uint32_t i = 0; i < xs.len; i++)
        result[i] = round(x[i] * scale) / scale;
    return value_numbers_view(result, xs.len);
}

Value builtin_polar(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_numeric(args[0]))
        return VALUE_NULL;
    uint32_t len = args[0].len;
    if (len > VALUE_MAX_LEN / 2)
        return builtin_too_long(context, "polar");
    const double *x = value_numbers(&args[0]);
    double *result = arena_alloc_array(context->arena, len * 2, sizeof *result);
    for (uint32_t i = 0; i < len; i++) {
        result[2 * i] = turns_cos(x[i]);
        result[2 * i + 1] = turns_sin(x[i]);
    }
    return value_numbers_view(result, len * 2);
}

static double pair_angle(const double *xy, uint32_t count) {
    return maths_atan2(xy[1], xy[0]) / BUILTIN_TAU;
}

static double pair_length(const double *xy, uint32_t count) {
    return sqrt(xy[0] * xy[0] + xy[1] * xy[1]);
}

// Applies f to pairs of numbers (B2.2). If there is one argument, the pairs are its elements 0 and 1, 2 and 3, and so
// on. If there are two, each pair has one element of each argument.
static Value each_pair(Arena *arena, const Value *args, double (*f)(const double *xy, uint32_t count)) {
    if (!is_absent(args[1]))
        return builtin_repeat(arena, args, 2, f);
    if (!value_is_numeric(args[0]) || args[0].len < 2)
        return VALUE_NULL;
    uint32_t pairs = args[0].len / 2;
    const double *xy = value_numbers(&args[0]);
    if (pairs == 1)
        return value_number(f(xy, 2));
    double *result = arena_alloc_array(arena, pairs, sizeof *result);
    for (uint32_t i = 0; i < pairs; i++)
        result[i] = f(xy + 2 * i, 2);
    return value_numbers_view(result, pairs);
}

BUILTIN_IS(angle, each_pair(context->arena, args, pair_angle))
BUILTIN_IS(length, each_pair(context->arena, args, pair_length))

static double sum_of_squares(const double *x, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++)
        sum = sum + x[i] * x[i];
    return sum;
}

static double root_of_squares(const double *x, uint32_t count) {
    return sqrt(sum_of_squares(x, count));
}

Value builtin_hypot(BuiltinContext *context, const Value *args, uint32_t count) {
    if (count != 1)
        return builtin_repeat(context->arena, args, count, root_of_squares);
    if (!value_is_numeric(args[0]))
        return VALUE_NULL;
    return value_number(root_of_squares(value_numbers(&args[0]), args[0].len));
}

Value builtin_dot(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_numeric(args[0]) || !value_is_numeric(args[1]))
        return VALUE_NULL;
    const double *x = value_numbers(&args[0]), *y = value_numbers(&args[1]);
    uint32_t len = args[0].len > args[1].len ? args[0].len : args[1].len;
    double sum = 0;
    for (uint32_t i = 0, j = 0, k = 0; i < len; i++) {
        sum = sum + x[j] * y[k];
        j = j + 1 == args[0].len ? 0 : j + 1;
        k = k + 1 == args[1].len ? 0 : k + 1;
    }
    return value_number(sum);
}

Value builtin_cross(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!is_numeric_of(args[0], 3) || !is_numeric_of(args[1], 3))
        return VALUE_NULL;
    const double *a = args[0].as.numbers, *b = args[1].as.numbers;
    double result[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return builtin_numbers(context->arena, result, 3);
}

Value builtin_normalize(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_numeric(args[0]))
        return VALUE_NULL;
    const double *x = value_numbers(&args[0]);
    uint32_t len = args[0].len;
    double square = sum_of_squares(x, len);
    if (square == 0)
        return VALUE_NULL;
    double root = sqrt(square);
    if (len == 1)
        return value_number(x[0] / root);
    double *result = arena_alloc_array(context->arena, len, sizeof *result);
    for (uint32_t i = 0; i < len; i++)
        result[i] = x[i] / root;
    return value_numbers_view(result, len);
}

static double map_one(const double *x, uint32_t count) {
    return (1 - x[0]) * x[1] + x[0] * x[2];
}

BUILTIN_IS(map, builtin_repeat(context->arena, args, count, map_one))

// If the limits are swapped, the upper limit takes precedence. NaN counts as less than both limits (B2.8).
static double clamp_one(const double *x, uint32_t count) {
    double raised = x[0] > x[1] ? x[0] : x[1];
    return x[2] < raised ? x[2] : raised;
}

BUILTIN_IS(clamp, builtin_repeat(context->arena, args, count, clamp_one))
