// family.c: see family.h.
//
// Long vectors are computed and charged in chunks of BUDGET_CHUNK, so that an interrupt is noticed soon. Array
// functions have the same bits as the functions of single numbers that they replace.
#include "builtin/family.h"

Value builtin_error(BuiltinContext *context, const char *name, const char *format, ...) {
    enum { ERROR_WORK = 50 }; // work units charged for each diagnostic, including repeated ones
    if (!context->report_error)
        return VALUE_NULL;
    arena_charge(context->arena, ERROR_WORK);
    Text text = text_new(context->arena);
    text_add_format(&text, "%s: ", name);
    va_list args;
    va_start(args, format);
    text_add_va(&text, format, args);
    va_end(args);
    context->report_error(context->user_data, text_str(&text));
    return VALUE_NULL;
}

// Minimum length for which an array function is called; shorter vectors are computed element by element.
enum { BUILTIN_MIN_ARRAY = 4 };

Value builtin_too_long(BuiltinContext *context, const char *name) {
    return builtin_error(context, name, "result is too long");
}

Value builtin_texts(Arena *arena, const Str *texts, uint32_t count) {
    String *strings = arena_alloc_array(arena, count, sizeof *strings);
    Item *items = arena_alloc_array(arena, count, sizeof *items);
    for (uint32_t i = 0; i < count; i++) {
        strings[i].text = texts[i];
        items[i] = (Item){ITEM_STRING, .as.string = &strings[i]};
    }
    return (Value){.len = count, .kind = VALUE_MIXED, .as.items = items};
}

Value builtin_numbers(Arena *arena, const double *numbers, uint32_t len) {
    if (len <= 1)
        return value_numbers_view(numbers, len);
    return value_numbers_view(arena_copy(arena, numbers, len * sizeof *numbers), len);
}

Value builtin_each(Arena *arena, Value x, double (*f)(double)) {
    if (!value_is_numeric(x))
        return VALUE_NULL;
    if (x.len == 1)
        return value_number(f(x.as.number));
    double *result = arena_alloc_array(arena, x.len, sizeof *result);
    for (uint32_t i = 0; i < x.len; i++) {
        result[i] = f(x.as.numbers[i]);
        arena_charge_chunk(arena, i, 1);
    }
    return value_numbers_view(result, x.len);
}

Value builtin_each_array(Arena *arena, Value x, double (*f)(double), BuiltinArrayCall *array_call) {
    if (x.len < BUILTIN_MIN_ARRAY || !value_is_numeric(x))
        return builtin_each(arena, x, f);
    double *result = arena_alloc_array(arena, x.len, sizeof *result);
    for (uint32_t at = 0; at < x.len; at += BUDGET_CHUNK) {
        uint32_t count = x.len - at < BUDGET_CHUNK ? x.len - at : BUDGET_CHUNK;
        arena_charge(arena, count / 2);
        array_call(x.as.numbers + at, count, result + at);
    }
    return value_numbers_view(result, x.len);
}

Value builtin_repeat(Arena *arena, const Value *args, uint32_t count, double (*f)(const double *x, uint32_t count)) {
    // Nearly all calls have two or three arguments, so stack_parts is usually large enough.
    enum { MAX_ON_STACK = 8 };
    double stack_parts[MAX_ON_STACK];
    uint32_t len = 0;
    for (uint32_t k = 0; k < count; k++) {
        if (!value_is_numeric(args[k]))
            return VALUE_NULL;
        len = args[k].len > len ? args[k].len : len;
        stack_parts[k % MAX_ON_STACK] = args[k].as.number;
    }
    if (len == 0)
        return VALUE_NULL;
    if (len == 1 && count <= MAX_ON_STACK)
        return value_number(f(stack_parts, count));
    uint32_t stack_at[MAX_ON_STACK] = {0};
    double *result = len > 1 ? arena_alloc_array(arena, len, sizeof *result) : NULL, single = 0;
    double *parts = count <= MAX_ON_STACK ? stack_parts : arena_alloc_array(arena, count, sizeof *parts);
    uint32_t *at = count <= MAX_ON_STACK ? stack_at : arena_alloc_array(arena, count, sizeof *at);
    for (uint32_t k = 0; k < count; k++)
        at[k] = 0;
    for (uint32_t i = 0; i < len; i++) {
        if (i % BUDGET_CHUNK == BUDGET_CHUNK - 1)
            arena_charge(arena, (uint64_t)BUDGET_CHUNK / 4 * count);
        for (uint32_t k = 0; k < count; k++) {
            parts[k] = value_numbers(&args[k])[at[k]];
            at[k] = at[k] + 1 == args[k].len ? 0 : at[k] + 1;
        }
        *(result ? &result[i] : &single) = f(parts, count);
    }
    return result ? value_numbers_view(result, len) : value_number(single);
}

static bool is_ascii_digit(char c) {
    return c >= '0' && c <= '9';
}

size_t builtin_scan_digits(Str text) {
    size_t at = 0;
    while (at < text.len &&
           (is_ascii_digit(text.bytes[at]) || (text.bytes[at] == '_' && at > 0 && text.bytes[at - 1] != '_' &&
                                               at + 1 < text.len && is_ascii_digit(text.bytes[at + 1]))))
        at++;
    return at;
}

bool builtin_is_integer(Str text) {
    text = str_trim(text);
    if (text.len && (text.bytes[0] == '-' || text.bytes[0] == '+'))
        text = (Str){text.bytes + 1, text.len - 1};
    return text.len > 0 && builtin_scan_digits(text) == text.len;
}
