// line_diff.h: the difference of two texts as a unified diff.
#pragma once

#include "cli/memory.h"

#include <stdint.h>

// A line of the diff.
typedef struct Edit {
    char sign; // '-', '+', or ' ' for a line of both texts
    Str line;  // part of one of the texts
    int64_t section;
} Edit;

// A unified diff, which is collected section by section, such as frame by frame. Zero-initialised.
typedef struct LineDiff {
    Edit *edits;
    size_t count;
    size_t capacity;
    size_t compared; // number of pairs of lines that were compared
} LineDiff;

// Adds the difference of two sections of the texts, which must live as long as the diff. Numbers are compared as
// line_same does.
void line_diff_add(LineDiff *diff, Str expected, Str got, double tolerance, int64_t section);
// Adds a section whose lines count as equal.
void line_diff_skip(LineDiff *diff, Str expected, int64_t section);
// Adds the diff as text, with up to three equal lines around each difference, and frees it. `first` is the number of
// the first line. `heading` is put before the number of a section. After some lines, only their number is printed.
void line_diff_print(LineDiff *diff, uint32_t first, const char *heading, Text *text);
