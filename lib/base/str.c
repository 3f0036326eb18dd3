// str.c: string views, and the search for similar names; see str.h.
//
// The bytes of an empty Str can be NULL, so functions of the C library are called only for a length above 0.
#include "base/str.h"

#include <string.h>

Str str_from(const char *text) {
    return (Str){text, strlen(text)};
}

bool str_equal(Str a, Str b) {
    return a.len == b.len && (a.len == 0 || memcmp(a.bytes, b.bytes, a.len) == 0);
}

int str_compare(Str a, Str b) {
    size_t len = a.len < b.len ? a.len : b.len;
    int order = len ? memcmp(a.bytes, b.bytes, len) : 0;
    if (order)
        return order < 0 ? -1 : 1;
    return (a.len > b.len) - (a.len < b.len);
}

char *str_split(char **rest, char separator) {
    char *part = *rest, *end = part ? strchr(part, separator) : NULL;
    if (end)
        *end = '\0';
    *rest = end ? end + 1 : NULL;
    return part;
}

Str str_copy(Arena *arena, Str text) {
    return (Str){str_to_c(arena, text), text.len};
}

char *str_to_c(Arena *arena, Str text) {
    char *copy = arena_alloc(arena, text.len + 1);
    if (text.len)
        memcpy(copy, text.bytes, text.len);
    copy[text.len] = 0;
    return copy;
}

bool str_starts_with(Str text, Str prefix) {
    return text.len >= prefix.len && str_equal((Str){text.bytes, prefix.len}, prefix);
}

bool str_ends_with(Str text, Str suffix) {
    return suffix.len == 0 ||
           (text.len >= suffix.len && str_equal((Str){text.bytes + (text.len - suffix.len), suffix.len}, suffix));
}

Str str_truncate(Str text, size_t max_bytes) {
    if (text.len <= max_bytes)
        return text;
    while (max_bytes > 0 && ((unsigned char)text.bytes[max_bytes] & 0xc0) == 0x80)
        max_bytes--;
    return (Str){text.bytes, max_bytes};
}

int str_word_number(Str word, const char *list) {
    size_t len = 0;
    for (int i = 0; *list; list += len + (list[len] == ' '), i++) {
        len = strcspn(list, " ");
        if (str_equal(word, (Str){list, len}))
            return i;
    }
    return -1;
}

static bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

Str str_trim(Str text) {
    while (text.len && is_space(text.bytes[0]))
        text.bytes++, text.len--;
    while (text.len && is_space(text.bytes[text.len - 1]))
        text.len--;
    return text;
}

int str_edit_distance(Str a, Str b) {
    enum { MAX_LENGTH = 64 };
    if (a.len > MAX_LENGTH || b.len > MAX_LENGTH)
        return MAX_LENGTH;
    // Optimal string alignment. Of its dynamic-programming table, three rows suffice.
    int rows[3][MAX_LENGTH + 1];
    int *before = rows[0], *above = rows[1], *row = rows[2];
    for (size_t j = 0; j <= b.len; j++)
        above[j] = (int)j;
    for (size_t i = 1; i <= a.len; i++) {
        row[0] = (int)i;
        for (size_t j = 1; j <= b.len; j++) {
            int best = above[j - 1] + (a.bytes[i - 1] != b.bytes[j - 1]);
            if (above[j] + 1 < best)
                best = above[j] + 1;
            if (row[j - 1] + 1 < best)
                best = row[j - 1] + 1;
            if (i > 1 && j > 1 && a.bytes[i - 1] == b.bytes[j - 2] && a.bytes[i - 2] == b.bytes[j - 1] &&
                before[j - 2] + 1 < best)
                best = before[j - 2] + 1;
            row[j] = best;
        }
        int *oldest = before;
        before = above;
        above = row;
        row = oldest;
    }
    return above[b.len];
}

StrNearest str_nearest(Str wanted) {
    enum { MAX_LENGTH = 12 };
    int length = wanted.len < MAX_LENGTH ? (int)wanted.len : MAX_LENGTH;
    return (StrNearest){wanted, length < 2 ? 1 : 2 + length / 6, {0}};
}

bool str_try_nearest(StrNearest *nearest, Str name) {
    int distance = str_edit_distance(nearest->wanted, name);
    if (distance >= nearest->limit)
        return false;
    nearest->limit = distance;
    nearest->found = name;
    return true;
}
