// number.h: locale-independent conversion between doubles and text.
#pragma once

#include "base/str.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { NUMBER_TEXT = 40 }; // size in bytes of a buffer for any formatted number

// Writes the shortest decimal that parses as the same double (spec language.md L18.1). Returns its length.
size_t number_format(double x, char text[NUMBER_TEXT]);
// Appends that decimal.
void text_add_number(Text *text, double x);
// Writes nine significant digits like C's "%.9g", but every NaN as "nan" (L6.2). Returns the length.
size_t number_format_short(double x, char text[NUMBER_TEXT]);
// Parses a well-formed decimal number with optional sign, point and exponent. Underscores are skipped. The result is
// correctly rounded; NaN if out of memory.
double number_parse(Str digits);

// Returns floor(x), which is -0 for x = -0. Faster than the C library's floor, which is a function call if the compiler
// cannot use SSE4.1.
static inline double number_floor(double x) {
    if (!(x > -4503599627370496.0 && x < 4503599627370496.0))
        return floor(x);
    double whole = (double)(int64_t)x;
    return whole == x ? x : whole - (whole > x);
}

// Returns first + n. If n is 0, returns `first` itself, because -0 + 0 would be 0.
static inline double number_counted(double first, uint32_t n) {
    return n ? first + n : first;
}

static inline uint64_t number_bits(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

// Returns true if the n numbers numbers[k * stride] are finite. Uses x - x == 0 instead of isfinite, because every
// compiler vectorises it.
static inline bool numbers_finite(const double *numbers, size_t n, size_t stride) {
    bool finite = true;
    for (size_t k = 0; k < n; k++)
        finite &= numbers[k * stride] - numbers[k * stride] == 0;
    return finite;
}
