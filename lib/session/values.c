// values.c: conversion between internal and public values.
#include "session/session.h"
#include "value/format.h"

#include <math.h>
#include <string.h>

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

typedef struct Printed {
    PetriValue value;
    const char *text;
} Printed;

static PetriStatus print_value(PetriSession *session, void *context) {
    Printed *printed = context;
    Value value;
    arena_reset(&session->text_arena);
    if (session_import_value(&session->text_arena, printed->value, &value))
        printed->text = format_text(&session->text_arena, &session->symbols, value).bytes;
    return PETRI_OK;
}

const char *petri_format_value(PetriSession *session, PetriValue value) {
    if (!session)
        return NULL;
    Printed printed = {value, NULL};
    return session_protect(session, NULL, print_value, &printed) == PETRI_OK ? printed.text : NULL;
}

typedef struct SymbolRequest {
    const char *name;
    const Symbol *symbol;
} SymbolRequest;

static PetriStatus intern_symbol(PetriSession *session, void *context) {
    SymbolRequest *request = context;
    request->symbol = symbol_register(&session->symbols, str_from(request->name));
    return PETRI_OK;
}

double petri_symbol(PetriSession *session, const char *name) {
    if (!session || !name || !session_is_name(str_from(name)))
        return NAN;
    SymbolRequest request = {name, NULL};
    session_protect(session, NULL, intern_symbol, &request);
    return request.symbol ? request.symbol->number : NAN;
}

const char *petri_symbol_name(const PetriSession *session, double number) {
    const Symbol *symbol = session ? symbol_of_number(&session->symbols, number) : NULL;
    return symbol ? symbol->name.bytes : NULL;
}
