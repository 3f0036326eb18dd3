// family.h: helpers shared by the built-ins; private to lib/builtin.
#pragma once

#include "builtin/builtin.h"
#include "maths/arrays.h"

#define BUILTIN(name, ...) BuiltinCall builtin_##name;
#include "builtin/builtin_list.h"
#undef BUILTIN

static const double BUILTIN_PI = 3.141592653589793;
static const double BUILTIN_TAU = 6.283185307179586;

static inline bool is_absent(Value v) {
    return v.kind == VALUE_ABSENT;
}

// Returns true if v is a numeric vector with `len` elements, such as a 3-vector, quaternion or matrix.
static inline bool is_numeric_of(Value v, uint32_t len) {
    return v.kind == VALUE_NUMBERS && v.len == len;
}

// Returns the value of an argument, or `default_value` if it is absent.
static inline Value value_or(Value v, Value default_value) {
    return is_absent(v) ? default_value : v;
}

// Reports "NAME: result is too long" and returns null.
Value builtin_too_long(BuiltinContext *context, const char *name);

// Returns a vector of `count` strings. `count` must be at least 1. The bytes of the strings are not copied.
Value builtin_texts(Arena *arena, const Str *texts, uint32_t count);

// Returns a vector that contains a copy of `len` numbers.
Value builtin_numbers(Arena *arena, const double *numbers, uint32_t len);

// Applies f to each element of x. Returns null if x is not numeric (B1.1).
Value builtin_each(Arena *arena, Value x, double (*f)(double));

// Defines a built-in that returns an expression of its parameters context, args and count.
#define BUILTIN_IS(name, expression)                                                                                   \
    Value builtin_##name(BuiltinContext *context, const Value *args, uint32_t count) {                                 \
        return expression;                                                                                             \
    }
#define ELEMENT_WISE(name, function) BUILTIN_IS(name, builtin_each(context->arena, args[0], function))

// builtin_each_array is like builtin_each, but calls `array_call` for long vectors. The results of `array_call` must be
// bit-identical to those of f (maths/arrays.h).
typedef void BuiltinArrayCall(const double *x, size_t count, double *to);
Value builtin_each_array(Arena *arena, Value x, double (*f)(double), BuiltinArrayCall *array_call);

// Returns a vector whose element i is f applied to the elements i of `count` vectors. Shorter vectors are repeated
// (B0.4). Returns null if there are no vectors, or if any of them is not numeric.
Value builtin_repeat(Arena *arena, const Value *args, uint32_t count, double (*f)(const double *x, uint32_t count));

// Sorts stably in ascending order (B3.3). Returns the sorted array, which is either the argument or another array in
// the arena.
Str *builtin_sort_texts(Arena *arena, Str *texts, uint32_t len);

// Returns the length of the longest prefix of the text that consists of digits, with or without single underscores
// between them.
size_t builtin_scan_digits(Str text);
// Returns true if the text is an integer: digits as in builtin_scan_digits, with an optional sign and surrounding white
// space.
bool builtin_is_integer(Str text);

// These functions return the noise at the point c, which has two, three or four coordinates. `permutation` contains the
// numbers 0 to 255.
double noise_point_2(const uint8_t *permutation, const double *c);
double noise_point_3(const uint8_t *permutation, const double *c);
double noise_point_4(const uint8_t *permutation, const double *c);

// Returns the constants with which ArraysIsa.plane_noise computes the same results as noise_point_2.
PlaneNoise noise_plane(void);
