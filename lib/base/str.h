// str.h: string views, a growing string buffer, and UTF-8.
#pragma once

#include "base/arena.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>

// A view of bytes, usually UTF-8, that does not own them. The bytes may contain NUL and need not be NUL-terminated.
typedef struct Str {
    const char *bytes;
    size_t len;
} Str;

#define STR(literal) ((Str){literal, sizeof(literal) - 1})
// Arguments for the format %.*s.
#define STR_ARGS(str) (int)(str).len, (str).bytes

Str str_from(const char *text);
bool str_equal(Str a, Str b);
// Returns -1, 0 or 1. Compares bytes, which for UTF-8 is the order of code points. A prefix sorts before
// the longer string.
int str_compare(Str a, Str b);
// str_copy and str_to_c return a copy that is followed by a NUL byte.
Str str_copy(Arena *arena, Str text);
char *str_to_c(Arena *arena, Str text);
bool str_starts_with(Str text, Str prefix);
bool str_ends_with(Str text, Str suffix);
// Returns the longest prefix of at most max_bytes bytes that does not end within a character.
Str str_truncate(Str text, size_t max_bytes);
// Returns the index of a word in a space-separated list, or -1 if the list does not contain it.
int str_word_number(Str word, const char *list);
// Ends the text *rest at the first separator. Returns the part before it, and sets *rest to the part after it, or to
// NULL if there is no separator. Returns NULL if *rest is NULL.
char *str_split(char **rest, char separator);
// Returns the text without white space (space, tab, CR, LF, VT, FF) at both ends.
Str str_trim(Str text);

// Returns the number of edits (insertion, deletion, replacement, swap of adjacent bytes) that turn a into b, for
// "did you mean" hints. Returns 64 if a or b is longer than 64 bytes.
int str_edit_distance(Str a, Str b);

// A search for the existing name that is most similar to an unknown name.
typedef struct StrNearest {
    Str wanted; // the unknown name
    int limit;  // a name must have a smaller edit distance to be accepted; after a match, the distance of `found`
    Str found;  // nearest name; empty: none within the limit
} StrNearest;
// Starts a search. Longer names can differ more; no other name of one byte is similar.
StrNearest str_nearest(Str wanted);
// Considers one existing name. Returns true if it is the nearest so far.
bool str_try_nearest(StrNearest *nearest, Str name);

// A growing string buffer. A zeroed struct is an empty text on the heap. The result of text_str is valid until the next
// append.
typedef struct Text {
    Arena *arena;    // where the bytes are; NULL: on the heap (text_free frees them)
    char *bytes;     // NUL-terminated; NULL until the first append, which may be empty
    size_t len;      // without the NUL
    size_t capacity; // of `bytes`
} Text;

Text text_new(Arena *arena);
void text_free(Text *text); // frees a text on the heap; it is then empty
// Ensures space for `more` bytes and a NUL after text->len. Returns the address of that space.
char *text_reserve(Text *text, size_t more);
void text_add(Text *text, Str part);
void text_add_c(Text *text, const char *part);
void text_add_char(Text *text, char c);
// Adds two hexadecimal digits for each byte.
void text_add_hex(Text *text, const uint8_t *bytes, size_t count);
void text_add_code_point(Text *text, uint32_t code_point);
// Adds a text. Writes '?' for ill-formed UTF-8 and for control characters that are not in `allowed`, because they must
// not reach a terminal.
void text_add_printable(Text *text, Str part, const char *allowed);
void text_add_format(Text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_add_va(Text *text, const char *format, va_list args) __attribute__((format(printf, 2, 0)));
Str text_str(const Text *text);

// Returns the value of a hexadecimal digit, or -1.
int str_hex_digit(char c);
// Converts a hexadecimal colour at the start of `hex`, such as #f80, #ff8800 or 0xff8800, optionally with alpha.
// Appends its components as numbers from 0 to 1, separated by ';'. Returns false, with nothing appended, if there is no
// colour.
bool text_add_hex_colour(Text *text, Str hex);
// Returns the components of a colour with a common English name, such as "1;0;0" for "red". Returns an empty string for
// other names.
Str str_named_colour(Str name);

// Returns a formatted string in the arena. It is followed by a NUL byte.
Str str_format(Arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));

enum { UTF8_MAX = 4 };
// Decodes the code point at *at and advances *at. For ill-formed UTF-8, including surrogates and overlong forms,
// returns -1 and advances by one byte.
int32_t utf8_next(Str text, size_t *at);
// Returns true for control characters and for -1, the result of utf8_next for ill-formed bytes. None of these must
// reach a terminal.
bool utf8_is_control(int32_t code_point);
// Writes 1 to 4 bytes and returns how many. The code point must be at most 0x10FFFF.
size_t utf8_encode(uint32_t code_point, char bytes[UTF8_MAX]);
// Returns the offset of the first ill-formed byte, or text.len.
size_t utf8_find_error(Str text);
// Returns the number of code points. Each ill-formed byte counts as one.
size_t utf8_length(Str text);
