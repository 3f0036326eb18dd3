// golden_line.h: whether two lines of output mean the same.
//
// Lines are compared token by token: words and signs as they are, strings by what they stand for, whatever their
// quotes, and numbers as numbers. With a tolerance R, the numbers a and b of one value agree if
//     max |a_i - b_i| <= R * max(1, max |a_i|, max |b_i|)
// but a key of the state and a hash are always compared exactly.
#ifndef PETRI_SRC_GOLDEN_LINE_H
#define PETRI_SRC_GOLDEN_LINE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Slice {
    const char *text;
    size_t length;
} Slice;

// Where two lines first differ, as offsets into them.
typedef struct LineDifference {
    size_t expected_at;
    size_t got_at;
} LineDifference;

// A tolerance of 0 means exactly; nan agrees with nan and -0 with 0.
bool line_same(Slice expected, Slice got, double tolerance, LineDifference *difference);

#endif
