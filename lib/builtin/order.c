// order.c: extremes, sorting and counting (spec builtins.md B3.2 to B3.4).
#include "builtin/family.h"

#include <string.h>

// --- extremes (B3.2)

static const uint32_t NO_POSITION = UINT32_MAX;

// Returns the index of the first smallest (sign -1) or largest (sign 1) number, or 0 if x[0] is NaN.
static uint32_t extreme_number(const double *x, uint32_t len, int sign) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < len; i++)
        if (sign < 0 ? x[i] < x[best] : x[i] > x[best])
            best = i;
    return best;
}

// Like extreme_number, for a mixed vector. Returns NO_POSITION if two elements cannot be ordered.
static uint32_t extreme_item(const Item *items, uint32_t len, int sign) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < len; i++) {
        Item a = items[i], b = items[best];
        bool better;
        if (a.type == ITEM_NUMBER && b.type == ITEM_NUMBER)
            better = sign < 0 ? a.as.number < b.as.number : a.as.number > b.as.number;
        else if (a.type == ITEM_STRING && b.type == ITEM_STRING)
            better = str_compare(a.as.string->text, b.as.string->text) == sign;
        else
            return NO_POSITION;
        if (better)
            best = i;
    }
    return best;
}

// Returns the index of the smallest (sign -1) or largest (sign 1) argument in the order of L5.5. Returns NO_POSITION if
// two arguments are incomparable.
static uint32_t extreme_argument(Arena *arena, const Value *args, uint32_t count, int sign) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < count; i++) {
        int order = value_compare(arena, args[i], args[best]);
        if (order == VALUE_INCOMPARABLE)
            return NO_POSITION;
        if (order == sign)
            best = i;
    }
    return best;
}

static Value find_extreme(BuiltinContext *context, const char *name, const Value *args, uint32_t count, int sign,
                          bool position) {
    uint32_t best;
    if (count > 1) {
        best = extreme_argument(context->arena, args, count, sign);
        if (best == NO_POSITION)
            return VALUE_NULL;
        return position ? value_number(best) : args[best];
    }
    if (args[0].len == 0)
        return VALUE_NULL;
    if (args[0].kind == VALUE_NUMBERS) {
        best = extreme_number(value_numbers(&args[0]), args[0].len, sign);
    } else {
        best = extreme_item(args[0].as.items, args[0].len, sign);
        if (best == NO_POSITION)
            return builtin_error(context, name, "the elements must be all numbers or all strings");
    }
    return position ? value_number(best) : value_element(args[0], best);
}

BUILTIN_IS(min, find_extreme(context, "min", args, count, -1, false))
BUILTIN_IS(max, find_extreme(context, "max", args, count, 1, false))
BUILTIN_IS(minindex, find_extreme(context, "minindex", args, count, -1, true))
BUILTIN_IS(maxindex, find_extreme(context, "maxindex", args, count, 1, true))

// --- sorting (B3.3)

// Merges the ascending runs from[low … middle-1] and from[middle … high-1] into `to`. The element from the right run is
// taken only if it is less. This makes the sort stable and keeps indices within bounds even if there are NaNs.
typedef void Merge(Arena *arena, void *to, const void *from, uint32_t low, uint32_t middle, uint32_t high);

static void merge_numbers(Arena *arena, void *to, const void *from, uint32_t low, uint32_t middle, uint32_t high) {
    const double *x = from;
    double *y = to;
    for (uint32_t i = low, j = middle, k = low; k < high; k++) {
        y[k] = i < middle && (j == high || !(x[j] < x[i])) ? x[i++] : x[j++];
        arena_charge_chunk(arena, k, 0); // merge_sort charges the work
    }
}

static void merge_texts(Arena *arena, void *to, const void *from, uint32_t low, uint32_t middle, uint32_t high) {
    const Str *x = from;
    Str *y = to;
    for (uint32_t i = low, j = middle, k = low; k < high; k++) {
        y[k] = i < middle && (j == high || str_compare(x[j], x[i]) >= 0) ? x[i++] : x[j++];
        arena_charge_chunk(arena, k, 2); // more work, because texts may be long
    }
}

// Sorts `items` by merging runs of increasing length. `other` is an array of the same size for temporary data. Returns
// the one of these two arrays that holds the result.
static void *merge_sort(Arena *arena, void *items, void *other, uint32_t len, Merge *merge) {
    for (uint64_t width = 1; width < len; width *= 2) {
        arena_charge(arena, 1 + len / 2);
        for (uint64_t low = 0; low < len; low += 2 * width) {
            uint64_t middle = low + width < len ? low + width : len;
            uint64_t high = low + 2 * width < len ? low + 2 * width : len;
            merge(arena, other, items, (uint32_t)low, (uint32_t)middle, (uint32_t)high);
        }
        void *sorted = other;
        other = items;
        items = sorted;
    }
    return items;
}

// Like builtin_sort_texts. If there is a NaN, the order is unspecified.
static double *sort_numbers(Arena *arena, double *numbers, uint32_t len) {
    return merge_sort(arena, numbers, arena_alloc_array(arena, len, sizeof *numbers), len, merge_numbers);
}

Str *builtin_sort_texts(Arena *arena, Str *texts, uint32_t len) {
    return merge_sort(arena, texts, arena_alloc_array(arena, len, sizeof *texts), len, merge_texts);
}

// Returns true if every element of a mixed vector is a string.
static bool all_texts(Value v) {
    for (uint32_t i = 0; i < v.len; i++)
        if (v.as.items[i].type != ITEM_STRING)
            return false;
    return true;
}

Value builtin_sort(BuiltinContext *context, const Value *args, uint32_t count) {
    Arena *arena = context->arena;
    Value v = args[0];
    if (v.len < 2)
        return v.len ? v : VALUE_NULL;
    if (v.kind == VALUE_NUMBERS) {
        double *numbers = arena_copy(arena, v.as.numbers, v.len * sizeof *numbers);
        return value_numbers_view(sort_numbers(arena, numbers, v.len), v.len);
    }
    if (!all_texts(v))
        return builtin_error(context, "sort", "the elements must be all numbers or all strings");
    Str *texts = arena_alloc_array(arena, v.len, sizeof *texts);
    for (uint32_t i = 0; i < v.len; i++)
        texts[i] = v.as.items[i].as.string->text;
    return builtin_texts(arena, builtin_sort_texts(arena, texts, v.len), v.len);
}

// --- counting (B3.4)

// The elements of ys, separated by type. Numbers and texts are sorted, because counting in long vectors then takes only
// O(n log n) time.
typedef struct Census {
    double *numbers; // ascending, without NaN, which equals nothing
    Str *texts;      // ascending
    Item *others;    // nodes and functions
    uint32_t number_count, text_count, other_count;
} Census;

enum { COUNT_WORK = 10 }; // work units of a binary search

static Census read_census(Arena *arena, const Value *v) {
    Census census = {.numbers = arena_alloc_array(arena, v->len, sizeof(double))};
    if (v->kind == VALUE_MIXED) {
        census.texts = arena_alloc_array(arena, v->len, sizeof(Str));
        census.others = arena_alloc_array(arena, v->len, sizeof(Item));
    }
    for (uint32_t i = 0; i < v->len; i++) {
        Item item = value_at(v, i);
        arena_charge_chunk(arena, i, 1);
        if (item.type == ITEM_STRING)
            census.texts[census.text_count++] = item.as.string->text;
        else if (item.type != ITEM_NUMBER)
            census.others[census.other_count++] = item;
        else if (item.as.number == item.as.number)
            census.numbers[census.number_count++] = item.as.number;
    }
    census.numbers = sort_numbers(arena, census.numbers, census.number_count);
    if (census.text_count)
        census.texts = builtin_sort_texts(arena, census.texts, census.text_count);
    return census;
}

// Returns the number of elements of census->numbers that are less than x or, if `inclusive`, less than or equal to x.
static uint32_t numbers_below(const Census *census, double x, bool inclusive) {
    uint32_t low = 0, high = census->number_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (inclusive ? census->numbers[middle] <= x : census->numbers[middle] < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static uint32_t texts_below(const Census *census, Str text, bool inclusive) {
    uint32_t low = 0, high = census->text_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (str_compare(census->texts[middle], text) < (inclusive ? 1 : 0))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static uint32_t census_count(Arena *arena, const Census *census, Item item) {
    if (item.type == ITEM_NUMBER) {
        if (item.as.number != item.as.number)
            return 0;
        return numbers_below(census, item.as.number, true) - numbers_below(census, item.as.number, false);
    }
    if (item.type == ITEM_STRING)
        return texts_below(census, item.as.string->text, true) - texts_below(census, item.as.string->text, false);
    uint32_t found = 0;
    for (uint32_t i = 0; i < census->other_count; i++)
        found += item_equal(arena, item, census->others[i]);
    return found;
}

Value builtin_count(BuiltinContext *context, const Value *args, uint32_t count) {
    Arena *arena = context->arena;
    if (args[0].len == 0)
        return VALUE_NULL;
    double *result = arena_alloc_array(arena, args[0].len, sizeof *result);
    ArenaMark scratch = arena_mark(arena);
    Census census = read_census(arena, &args[1]);
    for (uint32_t i = 0; i < args[0].len; i++) {
        result[i] = census_count(arena, &census, value_at(&args[0], i));
        arena_charge_chunk(arena, i, COUNT_WORK);
    }
    arena_rewind(arena, scratch);
    return value_numbers_view(result, args[0].len);
}
