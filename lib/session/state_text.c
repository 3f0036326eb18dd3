// state_text.c: comparison of the texts of two state files.
#include "base/heap.h"
#include "session/recorder.h"

#include <stdlib.h>
#include <string.h>

// Returns the length of the unit at the start of a text: a line, with the lines of particles that follow it.
static size_t unit_length(Str text) {
    size_t len = 0;
    do {
        const char *end = memchr(text.bytes + len, '\n', text.len - len);
        len = end ? (size_t)(end + 1 - text.bytes) : text.len;
    } while (len < text.len && str_starts_with((Str){text.bytes + len, text.len - len}, STR("particle ")));
    return len;
}

// Returns true for the last line, whose hash depends on the order, and for a system without particles.
static bool is_ignored(Str unit) {
    bool is_line = memchr(unit.bytes, '\n', unit.len) == unit.bytes + unit.len - 1;
    return str_starts_with(unit, STR("end ")) || (is_line && str_starts_with(unit, STR("system ")));
}

static int compare_units(const void *a, const void *b) {
    const Str *one = a, *other = b;
    int order = memcmp(one->bytes, other->bytes, one->len < other->len ? one->len : other->len);
    return order ? order : (one->len > other->len) - (one->len < other->len);
}

// Returns the sorted units of a text, which the caller frees, or NULL if out of memory.
static Str *sort_units(Str text, size_t *count) {
    size_t capacity = 1;
    for (size_t i = 0; i < text.len; i++)
        capacity += text.bytes[i] == '\n';
    Str *units = heap_alloc(capacity * sizeof *units);
    *count = 0;
    while (units && text.len > 0) {
        Str unit = {text.bytes, unit_length(text)};
        if (!is_ignored(unit))
            units[(*count)++] = unit;
        text = (Str){text.bytes + unit.len, text.len - unit.len};
    }
    if (units)
        qsort(units, *count, sizeof *units, compare_units);
    return units;
}

bool recorder_states_equal(Str one, Str other) {
    if (str_equal(one, other))
        return true;
    size_t counts[2];
    Str *units[2] = {sort_units(one, &counts[0]), sort_units(other, &counts[1])};
    bool same = units[0] && units[1] && counts[0] == counts[1];
    for (size_t i = 0; same && i < counts[0]; i++)
        same = str_equal(units[0][i], units[1][i]);
    heap_free(units[0]);
    heap_free(units[1]);
    return same;
}
