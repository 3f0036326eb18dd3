// check.h: cmocka and the headers it needs, and assertions that name the failed row of a table.
#pragma once

#include "groups.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

static inline void check_text(const char *row, const char *found, const char *wanted, const char *file, int line) {
    if (strcmp(found, wanted) == 0)
        return;
    print_error("%s\n found:  %s\n wanted: %s\n", row, found, wanted);
    _fail(file, line);
}

// Checks that two numbers are equal and have the same sign, or that both are NaN.
static inline void check_number(const char *row, double found, double wanted, const char *file, int line) {
    if ((found == wanted && signbit(found) == signbit(wanted)) || (isnan(found) && isnan(wanted)))
        return;
    print_error("%s\n found:  %.17g\n wanted: %.17g\n", row, found, wanted);
    _fail(file, line);
}

static inline void check_claim(const char *row, bool holds, const char *claim, const char *file, int line) {
    if (holds)
        return;
    print_error("%s\n does not hold: %s\n", row, claim);
    _fail(file, line);
}

// `row`: string that identifies the row of the table.
#define assert_text(row, found, wanted) check_text(row, found, wanted, __FILE__, __LINE__)
#define assert_number(row, found, wanted) check_number(row, found, wanted, __FILE__, __LINE__)
#define assert_claim(row, claim) check_claim(row, claim, #claim, __FILE__, __LINE__)

// A deterministic stream of bits for test data (SplitMix64).
static inline uint64_t next_bits(uint64_t *seed) {
    uint64_t x = *seed += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}
