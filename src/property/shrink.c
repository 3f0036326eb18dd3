// shrink.c: simplifies a violated case; see property.h.
//
// Each parameter in turn gets the simplest value with which the property is still violated: for integers the smallest,
// so that there are few particles, for other numbers the default or few digits.
#include "base/clock.h"
#include "property/property.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PARTS = 16 }; // number of integers below a value that are tried first

typedef struct Shrink {
    const Properties *properties;
    size_t property;
    double deadline;
    Found *found;
    bool first; // true in the first round
    bool fewer; // true: keep only values with fewer particles
} Shrink;

// Runs the case with another value of a parameter. If the property is violated, without more particles, keeps the
// value.
static bool try_value(Shrink *shrink, size_t index, double value) {
    Found *found = shrink->found;
    double before = found->values[index];
    size_t particles = found->violation.particles;
    value = range_clamp(&shrink->properties->ranges[index], value);
    if (value == before || clock_seconds() > shrink->deadline)
        return false;
    found->values[index] = value;
    bool violated = violation_refresh(shrink->properties, shrink->property, shrink->deadline, found);
    if (violated && found->violation.particles <= particles - (shrink->fewer ? 1 : 0))
        return true;
    found->values[index] = before;
    if (violated) // the violation must be that of the values
        violation_refresh(shrink->properties, shrink->property, INFINITY, found);
    return false;
}

static bool shrink_whole(Shrink *shrink, size_t index) {
    const Range *range = &shrink->properties->ranges[index];
    double min = range->min;
    const double *value = &shrink->found->values[index];
    if (*value == min)
        return false;
    if (try_value(shrink, index, min))
        return true;
    bool smaller = false;
    shrink->fewer = *value == range->usual;
    // A violation may need a special number of particles, so numbers all over the range are tried.
    double span = *value - min;
    for (int i = 1; i < PARTS && !smaller; i++)
        smaller = floor(span * i / PARTS) > 0 && try_value(shrink, index, min + floor(span * i / PARTS));
    for (double step = floor((*value - min) / 2); step >= 1; step = floor(step / 2))
        while (*value - step > min && try_value(shrink, index, *value - step))
            smaller = true;
    shrink->fewer = false;
    // The default is simpler than another number, unless it means more particles.
    return (shrink->first && try_value(shrink, index, range->usual)) || smaller;
}

static bool shrink_real(Shrink *shrink, size_t index) {
    const Range *range = &shrink->properties->ranges[index];
    double value = shrink->found->values[index];
    if (value == range->usual)
        return false;
    if (try_value(shrink, index, range->usual))
        return true;
    for (int digits = 1; digits < 4; digits++) {
        char text[32];
        snprintf(text, sizeof text, "%.*e", digits - 1, value);
        double rounded = strtod(text, NULL);
        if (rounded == value) // it is simple already
            return false;
        if (try_value(shrink, index, rounded))
            return true;
    }
    return false;
}

void shrink_case(const Properties *properties, size_t property, double seconds, Found *found) {
    enum { MAX_ROUNDS = 4 };
    Shrink shrink = {
        .properties = properties, .property = property, .deadline = clock_seconds() + seconds, .found = found};
    bool simpler = true;
    for (int round = 0; simpler && round < MAX_ROUNDS; round++) {
        simpler = false;
        shrink.first = round == 0;
        for (size_t i = 0; i < properties->range_count; i++)
            simpler = (properties->ranges[i].whole ? shrink_whole(&shrink, i) : shrink_real(&shrink, i)) || simpler;
    }
}
