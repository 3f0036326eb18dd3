// number.h: reading and printing doubles, whatever the host's locale.
#ifndef PETRI_BASE_NUMBER_H
#define PETRI_BASE_NUMBER_H

#include "base/str.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { NUMBER_TEXT = 40 }; // room for any formatted number

// The shortest decimal that reads back as the same double (spec language.md L18.1); returns its length.
size_t number_format(double x, char text[NUMBER_TEXT]);
// Nine significant digits as C's "%.9g", but every nan is "nan" (L6.2); returns its length.
size_t number_format_short(double x, char text[NUMBER_TEXT]);
// Reads decimal digits with optional sign, point and exponent, correctly rounded; underscores are skipped. The caller
// has checked the form.
double number_parse(Str digits);

// floor(x), to the bit (so -0 stays). Without SSE4.1, which we cannot count on, the C library's is a call.
static inline double number_floor(double x) {
    if (!(x > -4503599627370496.0 && x < 4503599627370496.0))
        return floor(x);
    double whole = (double)(int64_t)x;
    return whole == x ? x : whole - (whole > x);
}

// Returns first + n, or `first` itself if n is 0: -0 + 0 would be 0.
static inline double number_counted(double first, uint32_t n) {
    return n ? first + n : first;
}

static inline uint64_t number_bits(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Is none of n numbers inf or nan? x - x is 0 for finite x only; unlike isfinite it vectorizes with every compiler.
static inline bool numbers_finite(const double *numbers, size_t n, size_t stride) {
    bool finite = true;
    for (size_t k = 0; k < n; k++)
        finite &= numbers[k * stride] - numbers[k * stride] == 0;
    return finite;
}

#endif
