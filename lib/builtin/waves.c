// waves.c: waveforms (spec builtins.md B7) and easings (B8).
#include "base/number.h"
#include "builtin/family.h"
#include "maths/maths.h"
#include "maths/random.h"

#include <math.h>

static double phase(double x) {
    return x - number_floor(x);
}

static double bounce(double x) {
    return maths_sin(BUILTIN_PI * phase(x));
}

static double sharkfin(double x) {
    double p = phase(x);
    return p < 0.5 ? maths_sin(BUILTIN_PI * p) : 1 - maths_sin(BUILTIN_PI * (p - 0.5));
}

static double sine(double x) {
    return (1 - turns_cos(x)) / 2;
}

static double square(double x) {
    return phase(x) < 0.5 ? 0 : 1;
}

static double triangle(double x) {
    return 1 - fabs(phase(x) * 2 - 1);
}

static double linear(double x) {
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

// Applies f in the lower half of the range from 0 to 1, and mirrors the curve in the upper half. NaN is handled like
// the upper half.
static double ease(double x, double (*f)(double)) {
    if (x < 0)
        return 0;
    if (x > 1)
        return 1;
    return x < 0.5 ? f(x * 2) / 2 : 1 - f((1 - x) * 2) / 2;
}

static double power_2(double q) {
    return q * q;
}

static double power_3(double q) {
    return q * q * q;
}

static double quad(double x) {
    return ease(x, power_2);
}

static double cubic(double x) {
    return ease(x, power_3);
}

static double snap(double x) {
    return ease(x, sqrt);
}

ELEMENT_WISE(bounce, bounce)
ELEMENT_WISE(sawtooth, phase)
ELEMENT_WISE(sharkfin, sharkfin)
ELEMENT_WISE(sine, sine)
ELEMENT_WISE(square, square)
ELEMENT_WISE(triangle, triangle)
ELEMENT_WISE(linear, linear)
ELEMENT_WISE(quad, quad)
ELEMENT_WISE(cubic, cubic)
ELEMENT_WISE(snap, snap)

static double impulse(double x, double c) {
    double p = phase(x);
    if (p < c) {
        double y = 1 - p / c;
        return 1 - (y * y) * y;
    }
    double y = 1 - (p - c) / (1 - c);
    return (y * y) * y;
}

// The result has as many elements as xs, even if cs has more.
Value builtin_impulse(BuiltinContext *context, const Value *args, uint32_t count) {
    Value xs = args[0], cs = value_or(args[1], value_number(0.25));
    if (!value_is_numeric(xs) || !value_is_numeric(cs))
        return VALUE_NULL;
    const double *x = value_numbers(&xs), *c = value_numbers(&cs);
    if (xs.len == 1)
        return value_number(impulse(x[0], c[0]));
    double *result = arena_alloc_array(context->arena, xs.len, sizeof *result);
    for (uint32_t i = 0, j = 0; i < xs.len; i++) {
        result[i] = impulse(x[i], c[j]);
        j = j + 1 == cs.len ? 0 : j + 1;
    }
    return value_numbers_view(result, xs.len);
}
