// cases.c: sampling of cases, and cases as text; see property.h.
#include "base/number.h"
#include "property/property.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Returns a number from 0 to below 1 that depends only on the arguments (the finaliser of SplitMix64, Steele and
// others, 2014).
static double uniform(uint64_t number, uint64_t index) {
    uint64_t x = (number * 0x9E3779B97F4A7C15U) ^ ((index + 1) * 0xD1B54A32D192ED03U);
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
    x ^= x >> 31;
    return (double)(x >> 11) * 0x1p-53;
}

double range_clamp(const Range *range, double value) {
    value = range->whole ? round(value) : value;
    return value < range->min ? range->min : value > range->max ? range->max : value;
}

// Returns a value of a range. Small integers are more frequent, because they make short runs; other parameters often
// have their default, so that a violation depends on few of them.
static double sample(const Range *range, uint64_t number, uint64_t index) {
    double u = uniform(number, 2 * index), kind = uniform(number, 2 * index + 1);
    if (kind < 0.25 && !isnan(range->usual))
        return range_clamp(range, range->usual);
    if (range->whole)
        return range_clamp(range, floor(range->min + (range->max - range->min + 1) * u * u));
    return kind < 0.35 ? range->min : kind < 0.45 ? range->max : range->min + (range->max - range->min) * u;
}

void case_sample(const Properties *properties, int64_t number, double *values) {
    for (size_t i = 0; i < properties->range_count; i++) {
        const Range *range = &properties->ranges[i];
        values[i] = number > 0 ? sample(range, (uint64_t)number, i) : range_clamp(range, range->usual);
    }
}

void case_add_text(const Properties *properties, const double *values, bool changed, Text *text) {
    bool first = true;
    for (size_t i = 0; i < properties->range_count; i++) {
        const Range *range = &properties->ranges[i];
        if (changed && values[i] == range->usual)
            continue;
        text_add_format(text, "%s%s=", first ? "" : " ", range->name);
        text_add_number(text, values[i]);
        first = false;
    }
}

bool case_read_text(const Properties *properties, const char *text, double *values) {
    SCOPED_STRING copy = memory_strdup(text);
    case_sample(properties, 0, values);
    for (char *rest = copy; rest && *rest != '\0';) {
        char *word = str_split(&rest, ' '), *equals = strchr(word, '='), *end = NULL;
        bool known = false;
        if (!equals)
            return false;
        *equals = '\0';
        double value = strtod(equals + 1, &end);
        for (size_t i = 0; i < properties->range_count && *end == '\0'; i++)
            if (strcmp(properties->ranges[i].name, word) == 0) {
                values[i] = value;
                known = true;
            }
        if (!known)
            return false;
    }
    return true;
}
