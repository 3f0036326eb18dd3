// diff.c: see diff.h.
#include "repl/diff.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CELLS = 4000000, MOST_NAMES = 6 };

typedef struct Line {
    const char *text;
    size_t length;
} Line;

typedef struct Lines {
    Line *items;
    size_t count;
} Lines;

static Lines split(const Bytes *text) {
    Lines lines = {0};
    size_t capacity = 0;
    for (size_t at = 0; at < text->length;) {
        const char *start = text->data + at;
        const char *end = memchr(start, '\n', text->length - at);
        size_t length = end == NULL ? text->length - at : (size_t)(end - start);
        if (lines.count == capacity) {
            capacity = capacity == 0 ? 64 : capacity * 2;
            lines.items = memory_resized(lines.items, capacity * sizeof *lines.items);
        }
        lines.items[lines.count++] = (Line){start, length};
        at += length + 1;
    }
    return lines;
}

static bool same(const Line *a, const Line *b) {
    return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}

// The name that a line binds, if it looks like one that does.
static Line bound_name(const Line *line) {
    static const char *const words[] = {"let ", "func "};
    size_t at = 0;
    while (at < line->length && (line->text[at] == ' ' || line->text[at] == '\t')) {
        at++;
    }
    for (size_t i = 0; i < 2; i++) {
        size_t length = strlen(words[i]);
        at += line->length - at > length && memcmp(line->text + at, words[i], length) == 0 ? length : 0;
    }
    size_t end = at;
    while (end < line->length && (line->text[end] == '_' || (unsigned char)line->text[end] >= 0x80 ||
                                  strchr("=(;!@#$:%&|<>*/+-.,)[]{}'\" \t", line->text[end]) == NULL)) {
        end++;
    }
    bool binds = end > at && end < line->length && strchr("=(;", line->text[end]) != NULL;
    return (Line){line->text + at, binds ? end - at : 0};
}

typedef struct Names {
    Line items[MOST_NAMES];
    size_t count;
} Names;

static void add_name(Names *names, const Line *line) {
    Line name = bound_name(line);
    bool known = name.length == 0 || names->count == MOST_NAMES;
    for (size_t i = 0; i < names->count && !known; i++) {
        known = same(&names->items[i], &name);
    }
    if (!known) {
        names->items[names->count++] = name;
    }
}

// lengths[i][j]: of the longest common subsequence of the lines from i and from j on.
static uint32_t *common_lengths(const Line *a, size_t rows, const Line *b, size_t columns) {
    uint32_t *lengths = memory_zeroed((rows + 1) * (columns + 1) * sizeof *lengths);
    for (size_t i = rows; i-- > 0;) {
        uint32_t *row = lengths + i * (columns + 1), *next = row + columns + 1;
        for (size_t j = columns; j-- > 0;) {
            row[j] = same(&a[i], &b[j]) ? next[j + 1] + 1 : next[j] > row[j + 1] ? next[j] : row[j + 1];
        }
    }
    return lengths;
}

typedef struct Counts {
    size_t added;
    size_t removed;
} Counts;

static Counts compare(const Line *a, size_t rows, const Line *b, size_t columns, Names *names) {
    Counts counts = {0};
    bool small = rows == 0 || columns < MOST_CELLS / rows;
    uint32_t *lengths = small ? common_lengths(a, rows, b, columns) : NULL;
    size_t i = 0, j = 0;
    while (i < rows || j < columns) {
        if (lengths != NULL && i < rows && j < columns && same(&a[i], &b[j])) {
            i++;
            j++;
        } else if (j < columns && (i == rows || lengths == NULL ||
                                   lengths[i * (columns + 1) + j + 1] >= lengths[(i + 1) * (columns + 1) + j])) {
            add_name(names, &b[j++]);
            counts.added++;
        } else {
            add_name(names, &a[i++]);
            counts.removed++;
        }
    }
    free(lengths);
    return counts;
}

static void add_count(Bytes *what, size_t count, const char *verb) {
    bool first = what->length == 0;
    if (count > 0) {
        bytes_format(what, "%s%zu %s%s", first ? "" : ", ", count, !first ? "" : count == 1 ? "line " : "lines ", verb);
    }
}

void diff_describe(const Bytes *before, const Bytes *after, Bytes *what) {
    Lines a = split(before), b = split(after);
    size_t start = 0, rows = a.count, columns = b.count;
    while (start < rows && start < columns && same(&a.items[start], &b.items[start])) {
        start++;
    }
    while (rows > start && columns > start && same(&a.items[rows - 1], &b.items[columns - 1])) {
        rows--;
        columns--;
    }
    Names names = {0};
    Counts counts = {0};
    if (rows > start || columns > start) {
        counts = compare(a.items + start, rows - start, b.items + start, columns - start, &names);
    }
    add_count(what, counts.added, "added");
    add_count(what, counts.removed, "removed");
    for (size_t i = 0; i < names.count; i++) {
        bytes_format(what, "%s%.*s", i == 0 ? " (" : ", ", (int)names.items[i].length, names.items[i].text);
    }
    bytes_format(what, "%s", names.count == 0 ? "" : ")");
    free(a.items);
    free(b.items);
}
