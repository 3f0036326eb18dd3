// vector.c: the vector builder; see value.h.
//
// A single part is returned as it is, without a copy. Elements are stored as numbers until the first one that is not a
// number; then all are converted once.
#include "value/value.h"

#include <string.h>

Vector vector_new(Arena *arena) {
    return (Vector){.arena = arena};
}

// Reserves memory for `more` elements. If the vector would exceed VALUE_MAX_LEN, sets `overflow` and returns false.
static bool vector_reserve(Vector *vector, uint32_t more) {
    if (vector->overflow || more > VALUE_MAX_LEN - vector->len) {
        vector->overflow = true;
        return false;
    }
    if (vector->capacity - vector->len >= more)
        return true;
    size_t size = vector->mixed ? sizeof(Item) : sizeof(double);
    uint32_t capacity = vector->capacity ? vector->capacity * 2 : 4;
    if (capacity < vector->len + more)
        capacity = vector->len + more;
    vector->as.items = arena_grow(vector->arena, vector->as.items, vector->capacity * size, capacity * size);
    vector->capacity = capacity;
    return true;
}

static void vector_make_mixed(Vector *vector) {
    if (vector->mixed)
        return;
    Item *items = arena_alloc_array(vector->arena, vector->capacity, sizeof *items);
    for (uint32_t i = 0; i < vector->len; i++)
        items[i] = (Item){ITEM_NUMBER, .as.number = vector->as.numbers[i]};
    vector->as.items = items;
    vector->mixed = true;
}

static void append_elements(Vector *vector, Value part) {
    if (part.kind == VALUE_MIXED)
        vector_make_mixed(vector);
    if (part.len == 0 || !vector_reserve(vector, part.len))
        return;
    if (part.len >= BUDGET_NUMBERS)
        arena_charge(vector->arena, part.len / BUDGET_NUMBERS);
    if (!vector->mixed)
        memcpy(vector->as.numbers + vector->len, value_numbers(&part), part.len * sizeof(double));
    else if (part.kind == VALUE_MIXED)
        memcpy(vector->as.items + vector->len, part.as.items, part.len * sizeof(Item));
    else
        for (uint32_t i = 0; i < part.len; i++)
            vector->as.items[vector->len + i] = (Item){ITEM_NUMBER, .as.number = value_numbers(&part)[i]};
    vector->len += part.len;
}

// Stores the first part separately, so that composing a single value needs no copy and preserves a stream.
void vector_add(Vector *vector, Value part) {
    vector->several = vector->any;
    vector->any = true;
    if (value_is_null(part))
        return;
    if (vector->parts++ == 0) {
        vector->first = part;
        return;
    }
    if (vector->parts == 2)
        append_elements(vector, vector->first);
    if (value_is_number(part) && !vector->mixed && vector->len < vector->capacity)
        vector->as.numbers[vector->len++] = part.as.number;
    else
        append_elements(vector, part);
}

void vector_add_number(Vector *vector, double x) {
    vector_add(vector, value_number(x));
}

void vector_add_item(Vector *vector, Item item) {
    if (item.type == ITEM_NUMBER)
        vector_add_number(vector, item.as.number);
    else if (vector->parts == 0)
        vector_add(vector, value_item(vector->arena, item));
    else
        vector_add(vector, (Value){.len = 1, .kind = VALUE_MIXED, .as.items = &item});
}

Value vector_finish(Vector *vector) {
    if (vector->overflow)
        return VALUE_NULL;
    if (vector->parts == 0 || (vector->several && vector->parts == 1 && vector->first.kind == VALUE_STREAM))
        return VALUE_NULL;
    if (vector->parts == 1)
        return vector->first;
    if (!vector->mixed)
        return value_numbers_view(vector->as.numbers, vector->len);
    return (Value){.len = vector->len, .kind = VALUE_MIXED, .as.items = vector->as.items};
}
