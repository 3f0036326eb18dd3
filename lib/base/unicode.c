// unicode.c: see unicode.h.
#include "base/unicode.h"

#include "base/unicode_tables.h"

#include <stddef.h>

static bool in_ranges(uint32_t code_point, const UnicodeRange *ranges, size_t count) {
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (ranges[middle].last < code_point)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && ranges[low].first <= code_point;
}

#define IN(code_point, table) in_ranges(code_point, table, sizeof(table) / sizeof(table)[0])

bool unicode_starts_name(uint32_t code_point) {
    return code_point == '_' || IN(code_point, alphabetic);
}

bool unicode_continues_name(uint32_t code_point) {
    return unicode_starts_name(code_point) || IN(code_point, digits);
}

bool unicode_is_printable(uint32_t code_point) {
    if (code_point < 0x80)
        return code_point >= 0x20 && code_point < 0x7f;
    return !IN(code_point, unprintable);
}
