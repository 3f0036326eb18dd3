// line_diff.c: see line_diff.h.
#include "golden/line_diff.h"

#include "golden/golden.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

// CONTEXT: number of equal lines around a difference. MAX_LINES: maximum number of printed lines. MAX_TABLE: largest
// table for the longest common subsequence; if more would be needed, all lines between the first and the last
// difference count as changed.
enum { CONTEXT = 3, MAX_LINES = 40, MAX_COMPARED = 1 << 20, MAX_WIDTH = 200 };

typedef struct Lines {
    Str *items;
    size_t count;
} Lines;

static Lines split_lines(Str text) {
    Lines lines = {.items = memory_calloc(sizeof *lines.items)}; // never NULL
    const Text whole = {.bytes = (char *)text.bytes, .len = text.len};
    size_t at = 0;
    for (Str line; text_next_line(&whole, &at, &line);) {
        if ((lines.count & (lines.count + 1)) == 0) // there is room for the next power of two
            lines.items = memory_realloc(lines.items, 2 * (lines.count + 1) * sizeof *lines.items);
        lines.items[lines.count++] = line;
    }
    return lines;
}

static bool same(Str a, Str b, double tolerance) {
    LineDifference where;
    return line_same(a, b, tolerance, &where);
}

static void add_edit(LineDiff *diff, Edit edit) {
    if (diff->count == diff->capacity) {
        diff->capacity = diff->capacity == 0 ? 64 : 2 * diff->capacity;
        diff->edits = memory_realloc(diff->edits, diff->capacity * sizeof *diff->edits);
    }
    diff->edits[diff->count++] = edit;
}

static void add_edits(LineDiff *diff, char sign, const Str *lines, size_t count, int64_t section) {
    for (size_t i = 0; i < count; i++)
        add_edit(diff, (Edit){sign, lines[i], section});
}

// Two lists of lines, and how to compare them.
typedef struct Pair {
    const Str *a;
    const Str *b;
    size_t rows;    // number of lines in `a`
    size_t columns; // number of lines in `b`
    double tolerance;
    int64_t section;
} Pair;

// Adds the edits between two lists of lines, from a table of the lengths of longest common subsequences: row i, column
// j is that of the lines from i and from j.
static void add_shortest(LineDiff *diff, const Pair *pair) {
    size_t rows = pair->rows, columns = pair->columns, width = columns + 1, i, j;
    uint32_t *table = memory_calloc((rows + 1) * width * sizeof *table);
    for (i = rows; i-- > 0;)
        for (j = columns; j-- > 0;) {
            uint32_t down = table[(i + 1) * width + j], right = table[i * width + j + 1];
            table[i * width + j] = same(pair->a[i], pair->b[j], pair->tolerance) ? table[(i + 1) * width + j + 1] + 1
                                   : down > right                                ? down
                                                                                 : right;
        }
    for (i = 0, j = 0; i < rows || j < columns;) {
        if (i < rows && j < columns && same(pair->a[i], pair->b[j], pair->tolerance)) {
            add_edit(diff, (Edit){' ', pair->a[i++], pair->section});
            j++;
        } else if (j == columns || (i < rows && table[(i + 1) * width + j] >= table[i * width + j + 1])) {
            add_edit(diff, (Edit){'-', pair->a[i++], pair->section});
        } else {
            add_edit(diff, (Edit){'+', pair->b[j++], pair->section});
        }
    }
    free(table);
}

void line_diff_add(LineDiff *diff, Str expected, Str got, double tolerance, int64_t section) {
    Lines a = split_lines(expected), b = split_lines(got);
    size_t start = 0, end = 0, shorter = a.count < b.count ? a.count : b.count;
    while (start < shorter && same(a.items[start], b.items[start], tolerance))
        start++;
    while (end < shorter - start && same(a.items[a.count - end - 1], b.items[b.count - end - 1], tolerance))
        end++;
    Pair middle = {a.items + start, b.items + start, a.count - start - end, b.count - start - end, tolerance, section};
    add_edits(diff, ' ', a.items, start, section);
    size_t pairs = middle.rows > 0 ? middle.columns : 0;
    if (pairs <= (MAX_COMPARED - diff->compared) / (middle.rows + 1)) {
        diff->compared += middle.rows * pairs;
        add_shortest(diff, &middle);
    } else {
        add_edits(diff, '-', middle.a, middle.rows, section);
        add_edits(diff, '+', middle.b, middle.columns, section);
    }
    add_edits(diff, ' ', a.items + a.count - end, end, section);
    free(a.items);
    free(b.items);
}

void line_diff_skip(LineDiff *diff, Str expected, int64_t section) {
    Lines lines = split_lines(expected);
    add_edits(diff, ' ', lines.items, lines.count, section);
    free(lines.items);
}

// The printed part of a diff.
typedef struct Printer {
    Text *text;
    const char *heading;
    size_t printed;      // number of printed lines
    size_t left_out;     // number of lines with - or + that were not printed
    uint32_t numbers[2]; // of the next line in both texts
} Printer;

static void print_edit(Printer *printer, const Edit *edit) {
    if (printer->printed == MAX_LINES) {
        printer->left_out += edit->sign == ' ' ? 0 : 1;
        return;
    }
    size_t shown = edit->line.len > MAX_WIDTH ? MAX_WIDTH : edit->line.len;
    while (shown < edit->line.len && shown > 0 && ((unsigned char)edit->line.bytes[shown] & 0xC0U) == 0x80U)
        shown--; // do not split a UTF-8 character
    text_add_format(printer->text, "%c%.*s%s\n", edit->sign, (int)shown, edit->line.bytes,
                    shown < edit->line.len ? "..." : "");
    printer->printed++;
}

static void advance(Printer *printer, const Edit *edits, size_t count) {
    for (size_t i = 0; i < count; i++) {
        printer->numbers[0] += edits[i].sign != '+' ? 1 : 0;
        printer->numbers[1] += edits[i].sign != '-' ? 1 : 0;
    }
}

static void print_hunk(Printer *printer, const Edit *edits, size_t count, int64_t section) {
    uint32_t before[] = {printer->numbers[0], printer->numbers[1]};
    advance(printer, edits, count);
    uint32_t lengths[] = {printer->numbers[0] - before[0], printer->numbers[1] - before[1]};
    if (printer->printed < MAX_LINES) {
        text_add_format(printer->text, "@@ -%" PRIu32 ",%" PRIu32 " +%" PRIu32 ",%" PRIu32 " @@ %s",
                        before[0] - (lengths[0] == 0), lengths[0], before[1] - (lengths[1] == 0), lengths[1],
                        printer->heading);
        text_add_format(printer->text, section < 0 ? "\n" : " %" PRId64 "\n", section);
    }
    for (size_t i = 0; i < count; i++)
        print_edit(printer, &edits[i]);
}

// Returns the end of the hunk whose first change is `first`: differences with few equal lines between them are one
// hunk.
static size_t end_of_hunk(const LineDiff *diff, size_t first) {
    size_t last = first;
    for (size_t i = first; i < diff->count && i <= last + 2 * CONTEXT + 1; i++)
        last = diff->edits[i].sign != ' ' ? i : last;
    return last + CONTEXT + 1 < diff->count ? last + CONTEXT + 1 : diff->count;
}

void line_diff_print(LineDiff *diff, uint32_t first, const char *heading, Text *text) {
    Printer printer = {.text = text, .heading = heading, .numbers = {first, first}};
    const Edit *edits = diff->edits;
    size_t done = 0;
    text_add_c(text, "--- recorded\n+++ now\n");
    for (size_t i = 0; i < diff->count; i++) {
        if (edits[i].sign == ' ')
            continue;
        size_t start = i > done + CONTEXT ? i - CONTEXT : done, end = end_of_hunk(diff, i);
        advance(&printer, edits + done, start - done);
        print_hunk(&printer, edits + start, end - start, edits[i].section);
        done = end;
        i = end - 1;
    }
    if (printer.left_out > 0)
        text_add_format(text, "... %zu more %s\n", printer.left_out,
                        printer.left_out == 1 ? "line differs" : "lines differ");
    free(diff->edits);
    *diff = (LineDiff){0};
}
