// double_bits.h: access to the bits of doubles. Calls no function of the C library.
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define DOUBLE_SIGN (UINT64_C(1) << 63)
#define DOUBLE_ONE (UINT64_C(1) << 52) // hidden bit of the mantissa
#define DOUBLE_INFINITY __builtin_inf()
#define DOUBLE_NAN __builtin_nan("")

static inline uint64_t double_bits(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double double_from_bits(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline bool double_is_negative(double x) {
    return double_bits(x) >> 63;
}

static inline double double_absolute(double x) {
    return double_from_bits(double_bits(x) & ~DOUBLE_SIGN);
}

static inline double double_with_sign(double x, double sign) {
    return double_from_bits((double_bits(x) & ~DOUBLE_SIGN) | (double_bits(sign) & DOUBLE_SIGN));
}

static inline bool double_is_nan(double x) {
    return x != x;
}

// Returns true if x is neither infinite nor NaN.
static inline bool double_is_finite(double x) {
    return double_absolute(x) < DOUBLE_INFINITY;
}

// Finds m and *exponent with |x| = m * 2^*exponent and 2^52 ≤ m < 2^53. Returns m. x must be finite and not 0.
static inline uint64_t double_split(double x, int *exponent) {
    uint64_t m = double_bits(x) & (DOUBLE_ONE - 1);
    int field = (int)(double_bits(x) >> 52 & 0x7ff);
    if (field) {
        *exponent = field - 1075;
        return m | DOUBLE_ONE;
    }
    int shift = __builtin_clzll(m) - 11;
    *exponent = -1074 - shift;
    return m << shift;
}

// Returns e with 2^e ≤ |x| < 2^(e + 1). x must be finite and not 0.
static inline int double_exponent(double x) {
    int exponent;
    double_split(x, &exponent);
    return exponent + 52;
}
