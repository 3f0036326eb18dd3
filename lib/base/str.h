// str.h: sized slices of UTF-8 text, a growing text buffer, and UTF-8 itself.
#ifndef PETRI_BASE_STR_H
#define PETRI_BASE_STR_H

#include "base/arena.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>

// A borrowed run of bytes; need not end in NUL and may contain it.
typedef struct Str {
    const char *bytes;
    size_t len;
} Str;

#define STR(literal) ((Str){literal, sizeof(literal) - 1})
// What the format %.*s takes.
#define STR_ARGS(str) (int)(str).len, (str).bytes

Str str_from(const char *text);
bool str_equal(Str a, Str b);
// -1, 0 or 1 by bytes, which for UTF-8 is the order of code points; a prefix comes first.
int str_compare(Str a, Str b);
// A copy, followed by a NUL byte.
Str str_copy(Arena *arena, Str text);
char *str_to_c(Arena *arena, Str text);
bool str_starts_with(Str text, Str prefix);
bool str_ends_with(Str text, Str suffix);
// The text, or as many whole characters of it as `most` bytes hold.
Str str_truncate(Str text, size_t max_bytes);
// Which of the words of a list, which spaces part, it is, from 0; -1 if it is none.
int str_word_number(Str word, const char *list);
// Text without white space (space, tab, CR, LF, VT, FF) at both ends.
Str str_trim(Str text);

// Number of edits (insert, delete, replace, swap of neighbours) that turn a into b, for "did you mean"; names longer
// than 64 bytes are taken as far apart.
int str_edit_distance(Str a, Str b);

// The nearest of some names to one that is not there. `limit` is a distance that is too far, at first.
typedef struct StrNearest {
    Str wanted;
    int limit;
    Str found; // empty: none was near
} StrNearest;
// Looks at one more name; true if it is the nearest so far.
bool str_try_nearest(StrNearest *nearest, Str name);

// Text under construction. `bytes` lives in the arena; `text_str` is valid until the next append.
typedef struct Text {
    Arena *arena;
    char *bytes;
    size_t len;
    size_t capacity;
} Text;

Text text_new(Arena *arena);
void text_add(Text *text, Str part);
void text_add_c(Text *text, const char *part);
void text_add_char(Text *text, char c);
void text_add_code_point(Text *text, uint32_t code_point);
void text_add_format(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_add_va(Text *text, const char *format, va_list args) __attribute__((format(printf, 2, 0)));
Str text_str(const Text *text);

// Its value, or -1.
int str_hex_digit(char c);
// Appends the colour that a text such as #f80, #ff8800 or 0xff8800 begins with (alpha may follow) as r;g;b of numbers
// from 0 to 1; false, with nothing appended, if it begins with none.
bool text_add_hex_colour(Text *text, Str hex);

// Formatted text in an arena.
Str str_format(Arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));

enum { UTF8_MAX = 4 };
// Decodes the code point at `*at` and advances; returns -1 for ill-formed UTF-8 (surrogates and overlong forms
// included) and then advances by one byte.
int32_t utf8_next(Str text, size_t *at);
// Whether a terminal might obey it: a control character, or what utf8_next says of ill-formed bytes.
bool utf8_is_control(int32_t code_point);
// Writes 1 to 4 bytes and returns how many. The code point must be at most 0x10FFFF.
size_t utf8_encode(uint32_t code_point, char bytes[UTF8_MAX]);
// Offset of the first ill-formed byte, or text.len.
size_t utf8_find_error(Str text);
// Number of code points; ill-formed bytes count one each.
size_t utf8_length(Str text);

#endif
