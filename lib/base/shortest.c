// shortest.c: see shortest.h.
//
// The method is Schubfach (R. Giulietti, "The Schubfach way to render doubles", 2021). A double x = c 2^q has an
// interval of reals that parse as x. With the largest power 10^k that is not longer than this interval, the interval
// has at least one multiple of 10^k and at most one of 10^(k+1). The latter is the shortest decimal if it exists; else
// the multiple of 10^k that is nearest to x is.
//
// x and the ends of the interval are computed in units of 10^k / 4 and rounded to odd: rounded down, then made odd if
// they were not integers. So they compare with multiples of 4 as the exact values do. Their products with a rounded
// power of ten have errors below 2^-68, and exact values that are not integers are at least 2^-66 above and 2^-62 below
// integers, which tests/unit/base/check_powers.py proves for all doubles.
#include "base/shortest.h"

#include "base/wide.h"

#include <stdbool.h>
#include <string.h>

enum { MIN_POWER = -292 };

// The first 128 bits of 10^MIN_POWER and the following powers of ten, high word first, rounded up.
static const uint64_t powers[][2] = {
#include "base/powers_of_ten.h"
};

// Returns x * power / 2^128, rounded to odd.
static uint64_t multiply(uint64_t x, const uint64_t power[2]) {
    Wide lower = wide_multiply_add(x, power[1], 0), upper = wide_multiply_add(x, power[0], lower.high);
    return upper.high | (upper.low != 0 || lower.low >> 61 != 0);
}

// Return floor(log10(2^q)), floor(log10(3/4 2^q)) and floor(log2(10^k)). The shifts round down.
static int log10_of_power(int q) {
    return q * 315653 >> 20;
}
static int log10_of_three_quarters(int q) {
    return (q * 315653 - 131005) >> 20;
}
static int log2_of_ten_power(int k) {
    return k * 108853 >> 15;
}

Decimal number_shortest(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    uint64_t significand = bits & ((UINT64_C(1) << 52) - 1);
    int field = (int)(bits >> 52), q = (field > 0 ? field : 1) - 1075;
    // At a power of two, the next lower double is nearer than the next higher one.
    bool uneven = significand == 0 && field > 1;
    significand |= (uint64_t)(field > 0) << 52;
    int k = uneven ? log10_of_three_quarters(q) : log10_of_power(q), shift = q + log2_of_ten_power(-k) + 1;
    const uint64_t *power = powers[-k - MIN_POWER];
    uint64_t fours = 4 * significand;
    uint64_t lower = multiply((fours - (uneven ? 1 : 2)) << shift, power);
    uint64_t exact = multiply(fours << shift, power);
    uint64_t upper = multiply((fours + 2) << shift, power);
    // The ends of the interval parse as x only if the significand is even.
    lower += significand & 1;
    upper -= significand & 1;
    // Without branches, because for most doubles it is a matter of chance which of the four decimals is the shortest.
    uint64_t below = exact / 4, above = below + 1, middle = 2 * (below + above);
    bool has_below = 4 * below >= lower, has_above = 4 * above <= upper;
    bool nearer_below = (exact < middle) | ((exact == middle) & (below % 2 == 0));
    uint64_t digits = below + !(has_below & (nearer_below | !has_above));
    uint64_t tens_below = below / 10 * 10, tens_above = tens_below + 10; // multiples of 10^(k+1), in units of 10^k
    digits = 4 * tens_above <= upper ? tens_above : digits;
    digits = 4 * tens_below >= lower ? tens_below : digits;
    return (Decimal){digits, k};
}
