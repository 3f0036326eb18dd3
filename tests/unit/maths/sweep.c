// sweep.c: comparison with MPFR for random arguments.
//
// usage: sweep COUNT [NAME]: tests COUNT arguments for each function, or for the named function. Half of the arguments
// are spread evenly over all exponents for which the function is neither constant nor the identity. The other half are
// from ranges in which results are dense or error bounds are tight. For each function, prints the number of wrong
// results, how often the accurate path ran, and the largest error of the fast path relative to its bound. Exits with 0
// if no result was wrong.
#include "model.h"
#include "watch.h"

#include <stdlib.h>

typedef struct Range {
    const char *name;
    bool exponents; // true: the exponent of x is in [low, high); false: x is in [low, high)
    double low, high;
    double y_low, y_high; // range of the second argument, with the same meaning as low and high
} Range;

static const Range ranges[] = {
    {"sin", true, -27, 1024, 0, 0},        {"sin", false, -7, 7, 0, 0},       {"sin", false, -0.0123, 0.0123, 0, 0},
    {"sin", false, 60000, 70000, 0, 0},    {"cos", true, -28, 1024, 0, 0},    {"cos", false, -7, 7, 0, 0},
    {"cos", false, 1.5585, 1.583, 0, 0},   {"cos", false, 6e4, 7e4, 0, 0},    {"tan", true, -27, 1024, 0, 0},
    {"tan", false, -7, 7, 0, 0},           {"tan", false, 1.55, 1.59, 0, 0},  {"tan", false, -0.0123, 0.0123, 0, 0},
    {"asin", true, -27, 0, 0, 0},          {"asin", false, -1, 1, 0, 0},      {"asin", false, 0.003, 0.013, 0, 0},
    {"asin", false, 0.99, 1, 0, 0},        {"acos", true, -28, 0, 0, 0},      {"acos", false, -1, 1, 0, 0},
    {"acos", false, 0.999, 1, 0, 0},       {"acos", false, -1, -0.999, 0, 0}, {"exp", true, -55, 10, 0, 0},
    {"exp", false, -708, 709, 0, 0},       {"exp", false, -1, 1, 0, 0},       {"exp", false, -746, -707, 0, 0},
    {"log", true, -1074, 1024, 0, 0},      {"log", false, 0.99, 1.01, 0, 0},  {"log", false, 0, 2, 0, 0},
    {"log2", true, -1074, 1024, 0, 0},     {"log2", false, 0.99, 1.01, 0, 0}, {"log2", false, 0, 2, 0, 0},
    {"log10", true, -1074, 1024, 0, 0},    {"log10", false, 0.9, 1.1, 0, 0},  {"log10", false, 0, 2, 0, 0},
    {"atan2", true, -16, 16, -16, 16},     {"atan2", false, -1, 1, -1, 1},    {"atan2", true, -1074, 1024, -1074, 1024},
    {"atan2", false, -0.02, 0.02, 1, 2},   {"pow", true, -1074, 1024, -9, 9}, {"pow", false, 0, 10, -8, 8},
    {"pow", false, 0.99, 1.01, -6e4, 6e4},
};

static double unit(uint64_t *seed) {
    return (double)(next_bits(seed) >> 11) * 0x1p-53;
}

static double random_argument(uint64_t *seed, bool exponents, double low, double high) {
    if (!exponents)
        return low + (high - low) * unit(seed);
    double x = ldexp(1 + unit(seed), (int)floor(low + (high - low) * unit(seed)));
    return next_bits(seed) & 1 ? x : -x;
}

static uint64_t sweep_function(const Subject *subject, const Watched *watched, uint64_t count) {
    const Range *mine[8];
    unsigned kinds = 0;
    for (size_t i = 0; i < COUNT_OF(ranges); i++)
        if (!strcmp(ranges[i].name, subject->name))
            mine[kinds++] = &ranges[i];
    uint64_t seed = 1, wrong = 0;
    watch_start();
    for (uint64_t i = 0; i < count; i++) {
        // Every second argument comes from the first range, the others from all ranges in turn.
        const Range *range = mine[i % 2 ? 0 : i / 2 % kinds];
        double x = random_argument(&seed, range->exponents, range->low, range->high);
        double y = random_argument(&seed, range->exponents, range->y_low, range->y_high);
        bool positive = watched->positive;
        x = positive ? fabs(x) : x;
        wrong += (uint64_t)wrong_cases(subject, x, y, i % 16 == 0);
        watch_next(subject, watched, x, y, i % 8 == 0);
    }
    printf(
        "%-6s %12llu arguments, %llu wrong; accurate path 1 in %.0f; largest error of the fast path %.2f of its bound "
        "(with FMA %.2f)\n",
        subject->name, (unsigned long long)count, (unsigned long long)wrong,
        (double)watch_state[0].cases / (double)(watch_state[0].undecided + !watch_state[0].undecided),
        watch_state[0].worst, watch_state[1].worst);
    fflush(stdout);
    // An error above its bound means that the error analysis is wrong, even if all results are correctly rounded.
    return wrong + (watch_state[0].worst > 1) + (watch_state[1].worst > 1);
}

int main(int count, char **words) {
    if (count < 2)
        return 2;
    model_start();
    uint64_t wrong = 0, known = 0;
    for (size_t i = 0; i < COUNT_OF(subjects); i++) {
        if (count > 2 && strcmp(words[2], subjects[i].name))
            continue;
        known++;
        wrong += sweep_function(&subjects[i], &watched_functions[i], strtoull(words[1], NULL, 10));
    }
    return wrong || !known;
}
