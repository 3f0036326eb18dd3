// parameter_step.c: see parameter_step.h.
//
// Steps lead to multiples of the step size, so that values stay round numbers. The value 0 is skipped if the script
// would take it for a missing one.
#include "view/parameter_step.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STEPS_OF_RANGE = 50, STEPS_OF_VALUE = 20, SLIDER_STEPS = 200 };

static bool is_whole(double x) {
    return !isfinite(x) || x == floor(x);
}

// Returns the largest number <= x that is 1, 2 or 5 times a power of ten.
static double round_step(double x) {
    double power = pow(10, floor(log10(x))), digit = x / power;
    return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * power;
}

// Returns true if the value, the default `regular` and the range are integers.
static bool counts_whole(const PetriParameter *parameter, double regular) {
    return is_whole(regular) && is_whole(parameter->number) && is_whole(parameter->min) && is_whole(parameter->max);
}

static double step_size(const PetriParameter *parameter) {
    double regular = isnan(parameter->default_number) ? parameter->number : parameter->default_number;
    double range = parameter->max - parameter->min;
    if (parameter->step > 0)
        return parameter->step;
    double rough = isfinite(range) ? range / STEPS_OF_RANGE : fabs(regular) / STEPS_OF_VALUE;
    double size = rough > 0 && isfinite(rough) ? round_step(rough) : 1;
    return counts_whole(parameter, regular) ? fmax(1, floor(size)) : size;
}

// Rounds to 12 significant digits, which removes binary rounding errors.
static double round_decimal(double x) {
    char text[40];
    snprintf(text, sizeof text, "%.12g", x);
    double clean = strtod(text, NULL);
    return clean == 0 ? 0 : clean; // also turns -0 into 0
}

// Returns the multiple of the step size that is `steps` multiples away from `value`, limited to the range. If the
// parameter's comment gives a step, multiples count from the minimum, else from 0.
static double step_from(const PetriParameter *parameter, double value, int steps) {
    double size = step_size(parameter), dust = 1e-9;
    double origin = parameter->step > 0 && isfinite(parameter->min) ? parameter->min : 0;
    double place = (value - origin) / size;
    place = steps > 0 ? floor(place + dust) : ceil(place - dust);
    double to = round_decimal(origin + (place + steps) * size);
    return fmin(fmax(to, parameter->min), parameter->max);
}

// Returns true if a value would select the default instead.
static bool selects_default(const PetriParameter *parameter, double value) {
    return value == 0 && parameter->default_number != 0 && !parameter->accepts_false;
}

double parameter_stepped(const PetriParameter *parameter, int steps) {
    if (!isfinite(parameter->number))
        return NAN;
    double to = step_from(parameter, parameter->number, steps);
    if (selects_default(parameter, to))
        to = step_from(parameter, to, steps > 0 ? 1 : -1);
    return selects_default(parameter, to) ? NAN : to;
}

double parameter_at(const PetriParameter *parameter, double fraction) {
    double range = parameter->max - parameter->min, regular = parameter->default_number;
    double size = parameter->step > 0 ? parameter->step : counts_whole(parameter, regular) ? 1 : range / SLIDER_STEPS;
    double steps = round(fraction * range / size);
    double to = round_decimal(fmin(parameter->min + steps * size, parameter->max));
    if (selects_default(parameter, to))
        to = round_decimal(to + size <= parameter->max ? to + size : to - size);
    return to;
}
