// model.h: reference results for lib/maths, computed with MPFR, and random arguments.
#pragma once

#include "check.h"
#include "maths/fast.h"
#include "maths/maths.h"

#include <mpfr.h>

typedef int (*ModelOne)(mpfr_t, const mpfr_t, mpfr_rnd_t);
typedef int (*ModelTwo)(mpfr_t, const mpfr_t, const mpfr_t, mpfr_rnd_t);
typedef double (*One)(double);
typedef double (*Two)(double, double);

// A function with its variants. Functions with one parameter have model1 to exact1, and those with two parameters have
// model2 to exact2. The other members are NULL.
typedef struct Subject {
    const char *name;
    ModelOne model1;
    One public1, plain1, exact1;
    ModelTwo model2;
    Two public2, plain2, exact2;
} Subject;

#define SUBJECT_ONE(name)                                                                                              \
    {#name, mpfr_##name, maths_##name, maths_##name##_plain, exact_##name, NULL, NULL, NULL, NULL},
#define SUBJECT_TWO(name)                                                                                              \
    {#name, NULL, NULL, NULL, NULL, mpfr_##name, maths_##name, maths_##name##_plain, exact_##name},
static const Subject subjects[] = {MATHS_FUNCTIONS(SUBJECT_ONE, SUBJECT_TWO)};

static inline double double_from(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline uint64_t bits_from(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Sets MPFR to the range and precision of doubles.
static inline void model_start(void) {
    mpfr_set_default_prec(53);
    mpfr_set_emin(-1073);
    mpfr_set_emax(1024);
}

// Sets r = f(x, y), rounded to the precision of r. Returns MPFR's ternary value: the sign of r - f(x, y).
static inline int model_value(const Subject *subject, mpfr_t r, double x, double y) {
    static mpfr_t a, b;
    static bool ready;
    if (!ready)
        mpfr_inits2(53, a, b, (mpfr_ptr)0);
    ready = true;
    mpfr_set_d(a, x, MPFR_RNDN);
    mpfr_set_d(b, y, MPFR_RNDN);
    return subject->model1 ? subject->model1(r, a, MPFR_RNDN) : subject->model2(r, a, b, MPFR_RNDN);
}

static inline double model(const Subject *subject, double x, double y) {
    static mpfr_t r;
    static bool ready;
    if (!ready)
        mpfr_init(r);
    ready = true;
    mpfr_subnormalize(r, model_value(subject, r, x, y), MPFR_RNDN);
    return mpfr_get_d(r, MPFR_RNDN);
}

// Returns true if both have the same bits or both are NaN.
static inline bool same_number(double a, double b) {
    return (isnan(a) && isnan(b)) || bits_from(a) == bits_from(b);
}

// Compares all variants with the model for the arguments x and y. If `exact_too` is true, also compares the accurate
// path. Prints wrong results and returns their number.
static inline int wrong_cases(const Subject *subject, double x, double y, bool exact_too) {
    double wanted = model(subject, x, y), found[3] = {0};
    if (subject->model1) {
        found[0] = subject->public1(x);
        found[1] = subject->plain1(x);
        found[2] = exact_too ? subject->exact1(x) : wanted;
    } else {
        found[0] = subject->public2(x, y);
        found[1] = subject->plain2(x, y);
        found[2] = exact_too ? subject->exact2(x, y) : wanted;
    }
    static const char *const paths[] = {"", " (plain)", " (accurate path)"};
    int wrong = 0;
    for (int i = 0; i < 3; i++) {
        if (same_number(found[i], wanted))
            continue;
        print_error("%s(%a, %a)%s = %a, not %a\n", subject->name, x, y, paths[i], found[i], wanted);
        wrong++;
    }
    return wrong;
}
