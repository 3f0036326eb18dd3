// convert.c: conversion between internal and public values.
#include "base/unicode.h"
#include "session/session.h"

#include <stddef.h>

// Public values refer to internal elements without a copy, so both must have the same layout.
_Static_assert(sizeof(PetriItem) == sizeof(Item) && offsetof(PetriItem, as) == offsetof(Item, as),
               "same layout of elements");
_Static_assert(sizeof(PetriString) == sizeof(String) && offsetof(PetriString, length) == offsetof(String, text.len),
               "same layout of strings");
_Static_assert((int)PETRI_NUMBER == (int)ITEM_NUMBER && (int)PETRI_STRING == (int)ITEM_STRING &&
                   (int)PETRI_NODE == (int)ITEM_NODE && (int)PETRI_FUNCTION == (int)ITEM_FUNCTION,
               "same types");

PetriValue session_export_value(const Value *v) {
    if (v->kind == VALUE_MIXED)
        return (PetriValue){.length = v->len, .items = (const PetriItem *)v->as.items};
    return v->len > 0 ? (PetriValue){.length = v->len, .numbers = value_numbers(v)} : (PetriValue){0};
}

bool session_import_value(Arena *arena, PetriValue host_value, Value *value) {
    *value = VALUE_NULL;
    if (host_value.length == 0)
        return true;
    if (host_value.length > VALUE_MAX_LEN || !host_value.numbers == !host_value.items)
        return false;
    bool only_numbers = host_value.numbers;
    if (only_numbers) {
        *value = value_numbers_view(host_value.numbers, host_value.length);
        return true;
    }
    Vector vector = vector_new(arena);
    for (uint32_t i = 0; i < host_value.length; i++) {
        const Item *item = (const Item *)&host_value.items[i];
        if (item->type == ITEM_STRING) {
            Str text = item->as.string ? item->as.string->text : (Str){0};
            if (!item->as.string || (text.len && !text.bytes) || utf8_find_error(text) != text.len)
                return false;
        } else if (item->type != ITEM_NUMBER && (item->type > ITEM_FUNCTION || !item->as.node)) {
            return false;
        }
        vector_add_item(&vector, *item);
    }
    *value = vector_finish(&vector);
    return true;
}

bool session_is_name(Str text) {
    while (text.len > 1 && text.bytes[text.len - 1] == '\'')
        text.len--;
    for (size_t at = 0, next = 0; at < text.len; at = next) {
        int32_t c = utf8_next(text, &next);
        if (c < 0 || !(at == 0 ? unicode_starts_name((uint32_t)c) : unicode_continues_name((uint32_t)c)))
            return false;
    }
    return text.len > 0;
}
