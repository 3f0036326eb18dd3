// text.c: the growing string buffer Text; see str.h.
//
// All functions add to a text by text_reserve, which leaves room for a NUL, and add_len, which writes it. They do not
// return errors: if memory runs out, an arena escapes, and a text on the heap ends the process.
#include "base/heap.h"
#include "base/str.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

Text text_new(Arena *arena) {
    return (Text){.arena = arena};
}

void text_free(Text *text) {
    heap_free(text->bytes);
    *text = (Text){0};
}

char *text_reserve(Text *text, size_t more) {
    if (text->capacity - text->len <= more) {
        size_t capacity = text->capacity ? text->capacity * 2 : 64;
        if (capacity <= text->len + more)
            capacity = text->len + more + 1;
        text->bytes = text->arena ? arena_grow(text->arena, text->bytes, text->capacity, capacity)
                                  : heap_resize(text->bytes, capacity);
        if (!text->bytes)
            heap_exhausted();
        text->capacity = capacity;
    }
    return text->bytes + text->len;
}

static void add_len(Text *text, size_t len) {
    text->len += len;
    text->bytes[text->len] = 0;
}

void text_add(Text *text, Str part) {
    char *end = text_reserve(text, part.len);
    if (part.len)
        memcpy(end, part.bytes, part.len);
    add_len(text, part.len);
}

void text_add_c(Text *text, const char *part) {
    text_add(text, str_from(part));
}

void text_add_char(Text *text, char c) {
    *text_reserve(text, 1) = c;
    add_len(text, 1);
}

void text_add_hex(Text *text, const uint8_t *bytes, size_t count) {
    static const char digits[] = "0123456789abcdef";
    for (size_t i = 0; i < count; i++) {
        text_add_char(text, digits[bytes[i] >> 4]);
        text_add_char(text, digits[bytes[i] & 15]);
    }
}

void text_add_code_point(Text *text, uint32_t code_point) {
    add_len(text, utf8_encode(code_point, text_reserve(text, UTF8_MAX)));
}

void text_add_printable(Text *text, Str part, const char *allowed) {
    for (size_t at = 0; at < part.len;) {
        int32_t c = utf8_next(part, &at);
        if (utf8_is_control(c) && (c <= 0 || c > 0x7f || !strchr(allowed, (int)c)))
            text_add_char(text, '?');
        else
            text_add_code_point(text, (uint32_t)c);
    }
}

void text_add_va(Text *text, const char *format, va_list args) {
    assert(format); // avoids a GCC warning in sanitizer builds, where a NULL format seems possible
    va_list again;
    va_copy(again, args);
    int len = vsnprintf(NULL, 0, format, args);
    size_t added = len > 0 ? (size_t)len : 0;
    vsnprintf(text_reserve(text, added), added + 1, format, again);
    va_end(again);
    add_len(text, added);
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

Str str_named_colour(Str name) {
    static const char *const colours[][2] = {{"white", "1"},       {"black", "0"},       {"gray", "0.5"},
                                             {"grey", "0.5"},      {"red", "1;0;0"},     {"green", "0;1;0"},
                                             {"blue", "0;0;1"},    {"yellow", "1;1;0"},  {"cyan", "0;1;1"},
                                             {"magenta", "1;0;1"}, {"orange", "1;0.5;0"}};
    for (size_t i = 0; i < sizeof colours / sizeof colours[0]; i++)
        if (str_equal(name, str_from(colours[i][0])))
            return str_from(colours[i][1]);
    return (Str){0};
}

Str str_format(Arena *arena, const char *format, ...) {
    Text text = text_new(arena);
    va_list args;
    va_start(args, format);
    text_add_va(&text, format, args);
    va_end(args);
    return text_str(&text);
}
