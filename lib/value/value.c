// value.c: construction of vectors, and access to their elements; see value.h.
//
// Every function keeps the invariants of value.h. In particular, a part of a mixed vector that has only numbers becomes
// a numeric vector.
#include "value/value.h"

#include "base/number.h"
#include "value/node.h"
#include "value/stream.h"

#include <math.h>
#include <string.h>

const String *value_new_string(Arena *arena, Str text) {
    String *string = arena_alloc(arena, sizeof *string);
    string->text = str_copy(arena, text);
    return string;
}

Value value_string(Arena *arena, Str text) {
    return value_item(arena, (Item){ITEM_STRING, .as.string = value_new_string(arena, text)});
}

Value value_function(Arena *arena, const Function *function) {
    return value_item(arena, (Item){ITEM_FUNCTION, .as.function = function});
}

static bool item_true(Item item) {
    switch (item.type) {
    case ITEM_NUMBER:
        return item.as.number != 0; // NaN is true
    case ITEM_STRING:
        return item.as.string->text.len > 0;
    default:
        return true;
    }
}

bool value_true(Value v) {
    if (v.kind == VALUE_STREAM)
        return true;
    for (uint32_t i = 0; i < v.len; i++)
        if (item_true(value_at(&v, i)))
            return true;
    return false;
}

uint32_t value_wrap_index(double x, uint32_t n) {
    if (x >= 0 && x < n)
        return (uint32_t)x;
    if (!isfinite(x))
        x = -2147483648.0;
    double rest = fmod(floor(x), n); // exact; has the sign of x
    return rest < 0 ? (uint32_t)(rest + n) : (uint32_t)rest;
}

Value value_index(Arena *arena, Value v, Value index) {
    if (!value_is_numeric(index) || v.len == 0)
        return VALUE_NULL;
    const double *at = value_numbers(&index);
    if (index.len == 1)
        return value_element(v, value_wrap_index(at[0], v.len));
    if (v.kind == VALUE_NUMBERS) {
        const double *from = value_numbers(&v);
        double *numbers = arena_alloc_array(arena, index.len, sizeof *numbers);
        for (uint32_t i = 0; i < index.len; i++)
            numbers[i] = from[value_wrap_index(at[i], v.len)];
        return value_numbers_view(numbers, index.len);
    }
    Vector vector = vector_new(arena);
    for (uint32_t i = 0; i < index.len; i++)
        vector_add_item(&vector, v.as.items[value_wrap_index(at[i], v.len)]);
    return vector_finish(&vector);
}

Value value_element(Value v, uint32_t k) {
    if (v.kind == VALUE_STREAM)
        return value_number(value_stream_item(v, k));
    if (v.len == 0)
        return VALUE_NULL;
    k %= v.len;
    if (v.kind == VALUE_NUMBERS)
        return value_number(value_numbers(&v)[k]);
    const Item *item = &v.as.items[k];
    if (item->type == ITEM_NUMBER)
        return value_number(item->as.number);
    return (Value){.len = 1, .kind = VALUE_MIXED, .as.items = item};
}

Value value_slice(Arena *arena, Value v, uint32_t start, uint32_t count) {
    if (count == 0)
        return VALUE_NULL;
    if (v.kind == VALUE_NUMBERS)
        return value_numbers_view(value_numbers(&v) + start, count);
    if (count == 1)
        return value_element(v, start);
    for (uint32_t i = 0; i < count; i++)
        if (v.as.items[start + i].type != ITEM_NUMBER)
            return (Value){.len = count, .kind = VALUE_MIXED, .as.items = v.as.items + start};
    double *numbers = arena_alloc_array(arena, count, sizeof *numbers);
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = v.as.items[start + i].as.number;
    return value_numbers_view(numbers, count);
}

static void add_item_text(Text *out, const SymbolTable *symbols, Item item) {
    char digits[NUMBER_TEXT];
    const Symbol *symbol;
    switch (item.type) {
    case ITEM_NUMBER:
        symbol = symbol_of_number(symbols, item.as.number);
        if (symbol)
            text_add(out, symbol->name);
        else
            text_add(out, (Str){digits, number_format_short(item.as.number, digits)});
        break;
    case ITEM_STRING:
        text_add(out, item.as.string->text);
        break;
    case ITEM_NODE:
        text_add(out, item.as.node->kind->name);
        break;
    case ITEM_FUNCTION:
        text_add(out, item.as.function->name);
        break;
    }
}

Str value_text(Arena *arena, const SymbolTable *symbols, Value v) {
    if (v.len == 1 && v.kind == VALUE_MIXED && v.as.items[0].type == ITEM_STRING)
        return v.as.items[0].as.string->text;
    Text out = text_new(arena);
    for (uint32_t i = 0; i < v.len; i++) {
        arena_charge(arena, VALUE_TEXT_WORK);
        add_item_text(&out, symbols, value_at(&v, i));
    }
    return text_str(&out);
}
