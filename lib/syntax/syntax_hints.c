// syntax_hints.c: see syntax_hints.h.
//
// Patterns are compiled only after an error. Most are excluded before that (cannot_match), because an error has many
// candidates.
#include "syntax/syntax_hints.h"

#include <regex.h>
#include <stdbool.h>
#include <string.h>

static const struct {
    const char *before;
    const char *after;
    Str hint;
} hints[] = {
#define HINT(before, after, hint) {before, after, {hint, sizeof hint - 1}},
#include "syntax/syntax_hint_list.h"
};

enum { MAX_CONTEXT = 300 }; // maximum length of the text that is matched on each side, in bytes

// Returns true if a pattern certainly does not match. This is a quick test for patterns that start with `^` and a
// literal character.
static bool cannot_match(const char *pattern, const char *text) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyz:=,&#-<>`!";
    return pattern[0] == '^' && pattern[1] && strchr(plain, pattern[1]) &&
           (!pattern[2] || !strchr("?*{|", pattern[2])) && pattern[1] != text[0];
}

static bool matches_pattern(const char *pattern, const char *text) {
    regex_t regex;
    if (!*pattern)
        return true;
    if (cannot_match(pattern, text))
        return false;
    if (regcomp(&regex, pattern, REG_EXTENDED | REG_NOSUB) != 0)
        return false;
    bool found = regexec(&regex, text, 0, NULL, 0) == 0;
    regfree(&regex);
    return found;
}

// Returns a hint for a hexadecimal colour such as `#ff8800` or `0xff8800`, or an empty string. In `0xff8800`, the
// lexer reads the 0 as a number.
static Str hex_colour(Arena *arena, const char *before, const char *after) {
    Text out = text_new(arena);
    Str left = str_trim(str_from(before));
    char last = left.len ? left.bytes[left.len - 1] : ' ';
    text_add_c(&out, "a colour is r;g;b, each from 0 to 1: ");
    if (after[0] == '#' && strchr("=;(,", last) && text_add_hex_colour(&out, str_from(after)))
        return text_str(&out);
    const char *hex = strstr(before, "0x");
    return hex && text_add_hex_colour(&out, str_from(hex)) ? text_str(&out) : (Str){0};
}

Str syntax_hint_find(Arena *arena, const Source *source, Span span) {
    SourcePosition at = source_locate(source, span.start);
    const char *line = at.text.bytes, *end = line + at.text.len, *token = source->text.bytes + span.start;
    if (token < line || token > end)
        return (Str){0};
    Str left = {line, (size_t)(token - line)}, right = {token, (size_t)(end - token)};
    if (left.len > MAX_CONTEXT)
        left = (Str){token - MAX_CONTEXT, MAX_CONTEXT};
    if (right.len > MAX_CONTEXT)
        right.len = MAX_CONTEXT;
    if (str_starts_with(right, STR("--")))
        right.len = 0;
    const char *before = str_to_c(arena, left), *after = str_to_c(arena, right);
    Str hint = hex_colour(arena, before, after);
    for (size_t i = 0; !hint.len && i < sizeof hints / sizeof hints[0]; i++)
        if (matches_pattern(hints[i].after, after) && matches_pattern(hints[i].before, before))
            hint = hints[i].hint;
    return hint;
}
