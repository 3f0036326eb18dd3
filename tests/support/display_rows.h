// display_rows.h: reads display lists of any kind, with a reader that is made from petri-display-list.inc as a host
// can make one.
#pragma once

#include "petri-draw.h"

// Returns how many numbers the command at n has, with its kind. Returns 0 if there is no such command.
static inline size_t display_row_size(const double *n) {
    size_t at = 1;
    switch ((int)*n) {
#define NUMBER(name) at += 1;
#define FLAG(name) at += 1;
#define ALPHA(name) at += 1;
#define WORD(name, words) at += 1;
#define PAIR(name) at += 2;
#define NUMBERS(name, count) at += count;
#define COLOUR(name) at += 4;
#define MATRIX(name) at += 6;
#define STOPS(name) at += 1 + 5 * (size_t)n[at];
#define LIST(name) at += 1 + (size_t)n[at];
#define STRING(name) LIST(name)
#define PATH(name) LIST(name)
#define FILTER(name) LIST(name)
#define EFFECT(name) LIST(name)
#define PIXELS(name) at += 2 + (size_t)(n[at] * n[at + 1]);
#define PAINT(name) at += display_row_size(n + at);
#define PETRI_COMMAND(name, operands, text)                                                                            \
    case PETRI_DRAW_##name:                                                                                            \
        operands return at;
#include "petri-display-list.inc"
    default:
        return 0;
    }
}
#undef NUMBER
#undef FLAG
#undef ALPHA
#undef WORD
#undef PAIR
#undef NUMBERS
#undef COLOUR
#undef MATRIX
#undef STOPS
#undef LIST
#undef STRING
#undef PATH
#undef FILTER
#undef EFFECT
#undef PIXELS
#undef PAINT
