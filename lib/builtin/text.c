// text.c: characters and strings (spec builtins.md B12).
#include "builtin/family.h"

#include <math.h>
#include <string.h>

Value builtin_chr(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_numeric(args[0]))
        return VALUE_NULL;
    const double *x = value_numbers(&args[0]);
    Text text = text_new(context->arena);
    for (uint32_t i = 0; i < args[0].len; i++) {
        arena_charge_chunk(context->arena, i, 1);
        double code_point = floor(x[i]);
        // Surrogates are not characters and cannot be encoded in UTF-8 (E7).
        if (!(code_point >= 0 && code_point <= 0x10ffff) || (code_point >= 0xd800 && code_point <= 0xdfff))
            return builtin_error(context, "chr", "the argument is not a Unicode code point");
        text_add_code_point(&text, (uint32_t)code_point);
    }
    return value_string(context->arena, text_str(&text));
}

Value builtin_ord(BuiltinContext *context, const Value *args, uint32_t count) {
    Str text = value_text(context->arena, context->symbols, args[0]);
    arena_charge(context->arena, text.len / 8);
    size_t len = utf8_length(text);
    if (len > VALUE_MAX_LEN)
        return builtin_too_long(context, "ord");
    if (len == 0)
        return VALUE_NULL;
    double *result = arena_alloc_array(context->arena, len, sizeof *result);
    size_t at = 0;
    for (size_t i = 0; i < len; i++)
        result[i] = utf8_next(text, &at);
    return value_numbers_view(result, (uint32_t)len);
}

// Returns the index of the first separator at or after `at`, or text.len if there is none. The separator must not be
// empty.
static size_t find_separator(Str text, Str separator, size_t at) {
    while (separator.len <= text.len - at) {
        const char *first = memchr(text.bytes + at, separator.bytes[0], text.len - at - separator.len + 1);
        if (!first)
            break;
        if (memcmp(first, separator.bytes, separator.len) == 0)
            return (size_t)(first - text.bytes);
        at = (size_t)(first - text.bytes) + 1;
    }
    return text.len;
}

// Returns the number of parts between separators, not counting empty parts at the end.
static size_t count_pieces(Str text, Str separator) {
    size_t pieces = 0, kept = 0;
    for (size_t at = 0; at <= text.len; pieces++) {
        size_t end = find_separator(text, separator, at);
        if (end > at)
            kept = pieces + 1;
        at = end < text.len ? end + separator.len : text.len + 1;
    }
    return kept;
}

// Returns the first `len` parts of the text. The bytes of the parts are not copied, so the parts live only as long as
// the bytes of `text`.
static Value split_text(Arena *arena, Str text, Str separator, uint32_t len) {
    Str *pieces = arena_alloc_array(arena, len, sizeof *pieces);
    size_t at = 0;
    for (uint32_t i = 0; i < len; i++) {
        size_t end = find_separator(text, separator, at);
        pieces[i] = (Str){text.bytes + at, end - at};
        at = end + separator.len;
    }
    return builtin_texts(arena, pieces, len);
}

Value builtin_split(BuiltinContext *context, const Value *args, uint32_t count) {
    if (args[0].len == 0 || (!is_absent(args[1]) && args[1].len == 0))
        return VALUE_NULL;
    Str text = value_text(context->arena, context->symbols, args[0]);
    Str separator = is_absent(args[1]) ? STR("\n") : value_text(context->arena, context->symbols, args[1]);
    if (separator.len == 0)
        return builtin_error(context, "split", "the separator is empty");
    arena_charge(context->arena, text.len / 8);
    size_t pieces = count_pieces(text, separator);
    if (pieces == 0)
        return builtin_error(context, "split", "the text contains only separators");
    if (pieces > VALUE_MAX_LEN)
        return builtin_too_long(context, "split");
    return split_text(context->arena, text, separator, (uint32_t)pieces);
}

Value builtin_concat(BuiltinContext *context, const Value *args, uint32_t count) {
    if (args[0].len == 0)
        return VALUE_NULL;
    if (args[0].len == 1 && args[0].kind == VALUE_MIXED && args[0].as.items[0].type == ITEM_STRING)
        return args[0];
    return value_string(context->arena, value_text(context->arena, context->symbols, args[0]));
}
