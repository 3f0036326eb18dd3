// family.h: what the families of built-ins share; private to lib/builtin.
#ifndef PETRI_BUILTIN_FAMILY_H
#define PETRI_BUILTIN_FAMILY_H

#include "base/cpu.h"
#include "builtin/builtin.h"

#define BUILTIN(name, ...) BuiltinCall builtin_##name;
#include "builtin/builtin_list.h"
#undef BUILTIN

static const double BUILTIN_PI = 3.141592653589793;
static const double BUILTIN_TAU = 6.283185307179586;

// B0.1: numeric with exactly one element.
static inline bool is_scalar(Value v) {
    return v.kind == VALUE_NUMBERS && v.len == 1;
}

static inline bool is_absent(Value v) {
    return v.kind == VALUE_ABSENT;
}

// Numeric of one length, as 3-vectors, quaternions and matrices are.
static inline bool is_numeric_of(Value v, uint32_t len) {
    return v.kind == VALUE_NUMBERS && v.len == len;
}

// A value of the language for an argument that may be absent.
static inline Value value_or(Value v, Value fallback) {
    return is_absent(v) ? fallback : v;
}

// Reports "NAME: result is too long" and gives null.
Value builtin_too_long(BuiltinContext *context, const char *name);

// Texts, at least one, as a vector; their bytes are borrowed.
Value builtin_texts(Arena *arena, const Str *texts, uint32_t count);

// A copy of `len` numbers as a vector.
Value builtin_numbers(Arena *arena, const double *numbers, uint32_t len);

// f of each element; null unless x is numeric (B1.1).
Value builtin_each(Arena *arena, Value x, double (*f)(double));

#define ELEMENT_WISE(name, function)                                                                                   \
    Value name(BuiltinContext *context, const Value *args, uint32_t count) {                                           \
        return builtin_each(context->arena, args[0], function);                                                        \
    }

// The same with a function that takes many numbers at once and gives the bits of f (maths/arrays.h).
typedef void BuiltinArrayCall(CpuLevel level, const double *x, size_t count, double *to);
Value builtin_each_array(Arena *arena, Value x, double (*f)(double), BuiltinArrayCall *array_call);

// f of the `count` elements at each position of `count` vectors, element-wise with repetition (B0.4); null unless all
// are numeric, or if there are none.
Value builtin_repeat(Arena *arena, const Value *args, uint32_t count, double (*f)(const double *x, uint32_t count));

// Stable ascending sorts (B3.3). The result is `numbers` or another array of the arena; with a nan the order is any.
double *builtin_sort_numbers(Arena *arena, double *numbers, uint32_t len);
Str *builtin_sort_texts(Arena *arena, Str *texts, uint32_t len);

// Reads digits with single underscores between them, as far as they go; returns how many bytes that is.
size_t builtin_scan_digits(Str text);
// Is a text an integer: such digits, perhaps with a sign and white space around?
bool builtin_is_integer(Str text);

#endif
