// str.c: see str.h.
#include "base/str.h"

#include <assert.h>
#include <stdio.h>
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

bool str_try_nearest(StrNearest *nearest, Str name) {
    int distance = str_edit_distance(nearest->wanted, name);
    if (distance >= nearest->limit)
        return false;
    nearest->limit = distance;
    nearest->found = name;
    return true;
}

Text text_new(Arena *arena) {
    return (Text){.arena = arena};
}

static char *text_reserve(Text *text, size_t more) {
    if (text->capacity - text->len < more) {
        size_t capacity = text->capacity ? text->capacity * 2 : 64;
        if (capacity < text->len + more)
            capacity = text->len + more;
        text->bytes = arena_grow(text->arena, text->bytes, text->capacity, capacity);
        text->capacity = capacity;
    }
    return text->bytes + text->len;
}

void text_add(Text *text, Str part) {
    if (part.len)
        memcpy(text_reserve(text, part.len), part.bytes, part.len);
    text->len += part.len;
}

void text_add_c(Text *text, const char *part) {
    text_add(text, str_from(part));
}

void text_add_char(Text *text, char c) {
    *text_reserve(text, 1) = c;
    text->len++;
}

void text_add_code_point(Text *text, uint32_t code_point) {
    text->len += utf8_encode(code_point, text_reserve(text, UTF8_MAX));
}

void text_add_va(Text *text, const char *format, va_list args) {
    assert(format); // avoids a GCC warning in sanitizer builds, where a NULL format seems possible
    va_list again;
    va_copy(again, args);
    int len = vsnprintf(NULL, 0, format, args);
    if (len > 0) {
        vsnprintf(text_reserve(text, (size_t)len + 1), (size_t)len + 1, format, again);
        text->len += (size_t)len;
    }
    va_end(again);
}

void text_add_format(Text *text, const char *format, ...) {
    va_list args;
    va_start(args, format);
    text_add_va(text, format, args);
    va_end(args);
}

Str text_str(const Text *text) {
    return (Str){text->bytes, text->len};
}

int str_hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

// Appends a colour component from 0 to 255 as a number from 0 to 1 with up to three decimals.
static void add_component(Text *text, unsigned part) {
    char digits[8];
    int len = snprintf(digits, sizeof digits, "%u.%03u", part / 255, (part % 255 * 1000 + 127) / 255);
    while (digits[len - 1] == '0')
        len--;
    len -= digits[len - 1] == '.';
    text_add(text, (Str){digits, (size_t)len});
}

bool text_add_hex_colour(Text *text, Str hex) {
    size_t skip = str_starts_with(hex, STR("#")) ? 1 : str_starts_with(hex, STR("0x")) ? 2 : 0, count = 0;
    unsigned digits[8];
    for (; skip + count < hex.len && str_hex_digit(hex.bytes[skip + count]) >= 0; count++)
        if (count < 8)
            digits[count] = (unsigned)str_hex_digit(hex.bytes[skip + count]);
    char next = skip + count < hex.len ? hex.bytes[skip + count] : ' ';
    bool ends = !(next == '_' || (next >= '0' && next <= '9') || ((next | 32) >= 'a' && (next | 32) <= 'z'));
    if (!skip || !ends || !(count == 3 || count == 4 || count == 6 || count == 8))
        return false;
    size_t each = count > 4 ? 2 : 1;
    for (size_t i = 0; i < count; i += each) {
        if (i > 0)
            text_add_c(text, ";");
        add_component(text, each == 2 ? digits[i] * 16 + digits[i + 1] : digits[i] * 17);
    }
    return true;
}

Str str_format(Arena *arena, const char *format, ...) {
    Text text = text_new(arena);
    va_list args;
    va_start(args, format);
    text_add_va(&text, format, args);
    va_end(args);
    return text_str(&text);
}

int32_t utf8_next(Str text, size_t *at) {
    const unsigned char *bytes = (const unsigned char *)text.bytes + *at;
    size_t left = text.len - *at;
    unsigned char lead = bytes[0];
    (*at)++;
    if (lead < 0x80)
        return lead;
    int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
    if (lead < 0xc2 || lead > 0xf4 || left <= (size_t)more)
        return -1;
    int32_t code_point = lead & (0x3f >> more);
    for (int i = 1; i <= more; i++) {
        if ((bytes[i] & 0xc0) != 0x80)
            return -1;
        code_point = code_point << 6 | (bytes[i] & 0x3f);
    }
    static const int32_t min_code_point[4] = {0, 0x80, 0x800, 0x10000};
    if (code_point < min_code_point[more] || code_point > 0x10ffff || (code_point >= 0xd800 && code_point <= 0xdfff))
        return -1;
    *at += (size_t)more;
    return code_point;
}

bool utf8_is_control(int32_t c) {
    return c < 0x20 || (c >= 0x7f && c < 0xa0);
}

size_t utf8_encode(uint32_t code_point, char bytes[UTF8_MAX]) {
    if (code_point < 0x80) {
        bytes[0] = (char)code_point;
        return 1;
    }
    size_t more = code_point < 0x800 ? 1 : code_point < 0x10000 ? 2 : 3;
    static const unsigned char marks[4] = {0, 0xc0, 0xe0, 0xf0};
    for (size_t i = more; i > 0; i--, code_point >>= 6)
        bytes[i] = (char)(0x80 | (code_point & 0x3f));
    bytes[0] = (char)(marks[more] | code_point);
    return more + 1;
}

size_t utf8_find_error(Str text) {
    for (size_t at = 0; at < text.len;) {
        size_t start = at;
        if (utf8_next(text, &at) < 0)
            return start;
    }
    return text.len;
}

size_t utf8_length(Str text) {
    size_t count = 0;
    for (size_t at = 0; at < text.len; count++)
        utf8_next(text, &at);
    return count;
}
