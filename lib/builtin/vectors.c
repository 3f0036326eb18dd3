// vectors.c: length, interleaving and sums of vectors (spec builtins.md B3.1, B3.5, B3.6).
#include "builtin/family.h"

#include <math.h>

BUILTIN_IS(len, value_number(args[0].len))

static Value zip_numbers(Arena *arena, const Value *parts, uint32_t count, uint32_t len) {
    double *result = arena_alloc_array(arena, (size_t)len * count, sizeof *result);
    for (uint32_t k = 0; k < count; k++) {
        const double *from = value_numbers(&parts[k]);
        for (uint32_t i = 0, j = 0; i < len; i++) {
            result[(size_t)i * count + k] = from[j];
            j = j + 1 == parts[k].len ? 0 : j + 1;
        }
    }
    return value_numbers_view(result, len * count);
}

static Value zip_items(Arena *arena, const Value *parts, uint32_t count, uint32_t len) {
    Item *result = arena_alloc_array(arena, (size_t)len * count, sizeof *result);
    for (uint32_t k = 0; k < count; k++)
        for (uint32_t i = 0, j = 0; i < len; i++) {
            result[(size_t)i * count + k] = value_at(&parts[k], j);
            j = j + 1 == parts[k].len ? 0 : j + 1;
        }
    return (Value){.len = len * count, .kind = VALUE_MIXED, .as.items = result};
}

// The result is mixed if any argument is mixed, because the result contains every element of every argument (B3.5).
Value builtin_zip(BuiltinContext *context, const Value *args, uint32_t count) {
    Value *parts = arena_alloc_array(context->arena, count, sizeof *parts);
    uint32_t kept = 0, len = 0;
    bool mixed = false;
    for (uint32_t k = 0; k < count; k++) {
        if (args[k].len == 0)
            continue;
        parts[kept++] = args[k];
        len = args[k].len > len ? args[k].len : len;
        mixed = mixed || args[k].kind == VALUE_MIXED;
    }
    if (kept <= 1)
        return kept ? parts[0] : VALUE_NULL;
    if ((uint64_t)len * kept > VALUE_MAX_LEN)
        return builtin_too_long(context, "zip");
    return mixed ? zip_items(context->arena, parts, kept, len) : zip_numbers(context->arena, parts, kept, len);
}

// Checks the two arguments of the functions of B3.6: the first must be numbers or null, and the second a width of at
// least 1. Sets *width to the truncated width, which may be infinite. Returns false if an argument is invalid.
static bool sum_arguments(const Value *args, double *width) {
    Value w = value_or(args[1], value_number(1));
    if (args[0].kind == VALUE_MIXED || !value_is_number(w))
        return false;
    *width = trunc(w.as.number);
    return *width >= 1;
}

typedef enum Fold { FOLD_SUM, FOLD_PRODUCT, FOLD_MEAN } Fold;

// Computes k results, where k is the width (the second argument). Element i of the first argument contributes to result
// i mod k.
static Value fold_vector(BuiltinContext *context, const char *name, const Value *args, Fold kind) {
    double width;
    if (!sum_arguments(args, &width))
        return VALUE_NULL;
    if (width > VALUE_MAX_LEN)
        return builtin_too_long(context, name);
    uint32_t k = (uint32_t)width, len = args[0].len;
    double single, *result = k == 1 ? &single : arena_alloc_array(context->arena, k, sizeof *result);
    for (uint32_t j = 0; j < k; j++)
        result[j] = kind == FOLD_PRODUCT ? 1 : 0;
    const double *x = len ? value_numbers(&args[0]) : NULL;
    for (uint32_t i = 0, j = 0; i < len; i++) {
        result[j] = kind == FOLD_PRODUCT ? result[j] * x[i] : result[j] + x[i];
        j = j + 1 == k ? 0 : j + 1;
    }
    // Result j is computed from len / k elements (j, j + k, …), or from one more if j < len % k.
    for (uint32_t j = 0; kind == FOLD_MEAN && j < k && j < len; j++)
        result[j] = result[j] / (len / k + (j < len % k));
    return value_numbers_view(result, k);
}

BUILTIN_IS(sum, fold_vector(context, "sum", args, FOLD_SUM))
BUILTIN_IS(product, fold_vector(context, "product", args, FOLD_PRODUCT))
BUILTIN_IS(mean, fold_vector(context, "mean", args, FOLD_MEAN))

Value builtin_accumulate(BuiltinContext *context, const Value *args, uint32_t count) {
    double width;
    if (!sum_arguments(args, &width) || !value_is_numeric(args[0]))
        return VALUE_NULL;
    uint32_t len = args[0].len, k = width < len ? (uint32_t)width : len;
    if (len == 1)
        return args[0];
    const double *x = value_numbers(&args[0]);
    double *result = arena_alloc_array(context->arena, len, sizeof *result);
    for (uint32_t i = 0; i < k; i++)
        result[i] = x[i];
    for (uint32_t i = k; i < len; i++)
        result[i] = result[i - k] + x[i];
    return value_numbers_view(result, len);
}
