// watch.h: records the decisions of the scalar functions' fast paths. A decision is a test of a fast path's result,
// high + low, whose error is at most `error`: is the result accurate enough to be rounded correctly? The functions are
// two variants that are compiled from watched.c, without and with FMA.
#pragma once

#include "model.h"

// The last decision of a variant, and statistics of all its decisions.
typedef struct Watch {
    double high, low, error;
    bool asked;
    uint64_t cases, undecided; // number of calls, and of calls in which the fast path did not suffice
    double worst;              // largest error of a fast path, divided by the bound `error`
} Watch;

static Watch watch_state[2];

static inline void watch_decision(double high, double low, double error, int instance) {
    watch_state[instance].high = high;
    watch_state[instance].low = low;
    watch_state[instance].error = error;
    watch_state[instance].asked = true;
}

typedef struct Watched {
    const char *name;
    bool positive; // x must not be negative
    One one[2];
    Two two[2];
} Watched;

#define WATCH_ONE(name)                                                                                                \
    double maths_##name##_watched0(double x);                                                                          \
    double maths_##name##_watched1(double x);
#define WATCH_TWO(name)                                                                                                \
    double maths_##name##_watched0(double x, double y);                                                                \
    double maths_##name##_watched1(double x, double y);
MATHS_FUNCTIONS(WATCH_ONE, WATCH_TWO)
#undef WATCH_ONE
#undef WATCH_TWO

// Called with each decision of a variant.
extern void (*watch_hook0)(double high, double low, double error, int instance);
extern void (*watch_hook1)(double high, double low, double error, int instance);

#define IS_POSITIVE(name) (#name[0] == 'l' || #name[0] == 'p')
#define WATCH_ONE(name) {#name, IS_POSITIVE(name), {maths_##name##_watched0, maths_##name##_watched1}, {NULL, NULL}},
#define WATCH_TWO(name) {#name, IS_POSITIVE(name), {NULL, NULL}, {maths_##name##_watched0, maths_##name##_watched1}},
static const Watched watched_functions[] = {MATHS_FUNCTIONS(WATCH_ONE, WATCH_TWO)};

static inline void watch_start(void) {
    memset(watch_state, 0, sizeof watch_state);
    watch_hook0 = watch_hook1 = watch_decision;
}

// Returns the actual error of high + low in the last decision, divided by the bound `error`. exp and pow multiply their
// result by a scale 2^k after the decision, so f(x, y) is divided by that scale first.
static inline double watch_error_ratio(const Subject *subject, const Watch *watch, double x, double y) {
    mpfr_t scale, f, sum;
    mpfr_inits2(200, scale, f, sum, (mpfr_ptr)0);
    model_value(subject, f, x, y);
    mpfr_set_d(sum, watch->high, MPFR_RNDN);
    mpfr_add_d(sum, sum, watch->low, MPFR_RNDN);
    mpfr_abs(sum, sum, MPFR_RNDN);
    mpfr_abs(f, f, MPFR_RNDN);
    if (subject->name[0] == 'e' || subject->name[0] == 'p') {
        mpfr_div(scale, f, sum, MPFR_RNDN);
        mpfr_mul_2si(f, f, -lround(log2(mpfr_get_d(scale, MPFR_RNDN))), MPFR_RNDN);
    }
    mpfr_sub(f, f, sum, MPFR_RNDN);
    double share = fabs(mpfr_get_d(f, MPFR_RNDN)) / watch->error;
    mpfr_clears(scale, f, sum, (mpfr_ptr)0);
    return share;
}

// Calls both variants and counts the calls. If `measure` is true and the result is a normal number, also updates the
// largest error.
static inline void watch_next(const Subject *subject, const Watched *watched, double x, double y, bool measure) {
    for (int i = 0; i < 2; i++) {
        Watch *watch = &watch_state[i];
        watch->asked = false;
        double r = watched->one[i] ? watched->one[i](x) : watched->two[i](x, y);
        watch->cases++;
        bool decided =
            watch->asked && watch->high + (watch->low + watch->error) == watch->high + (watch->low - watch->error);
        watch->undecided += !decided;
        // Decisions for a subnormal x of a logarithm are ignored, because log_lanes rejects them.
        if (!measure || !watch->asked || !isnormal(r) || (watched->positive && x < 0x1p-1022))
            continue;
        double share = watch_error_ratio(subject, watch, x, y);
        if (share > watch->worst && isfinite(share))
            watch->worst = share;
    }
}
