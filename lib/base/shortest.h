// shortest.h: the shortest decimal of a double.
#pragma once

#include <stdint.h>

// The number `digits` * 10^exponent.
typedef struct Decimal {
    uint64_t digits; // at most 17
    int exponent;
} Decimal;

// Returns the decimal that parses as x and has the fewest digits, apart from zeros at its end; of several, the nearest
// to x. x must be finite and positive.
Decimal number_shortest(double x);
