// values.h: conversion of values to and from strings, for the tests of lib/value and lib/state.
#pragma once

#include "check.h"
#include "nodes.h"
#include "value/format.h"
#include "value/value_hash.h"

#include <stdlib.h>

// An arena and a symbol table. Each test has its own.
typedef struct World {
    Arena arena;
    SymbolTable symbols;
} World;

static inline int world_setup(void **state) {
    World *world = calloc(1, sizeof *world);
    arena_init(&world->arena, "test", (size_t)1 << 30);
    world->symbols = symbol_table_new(&world->arena);
    *state = world;
    return world == NULL;
}

static inline int world_teardown(void **state) {
    World *world = *state;
    symbol_table_free(&world->symbols);
    arena_free(&world->arena);
    free(world);
    return 0;
}

#define WORLD_TEST(function) cmocka_unit_test_setup_teardown(function, world_setup, world_teardown)

static inline const Symbol *name_of(World *world, const char *name) {
    return symbol_intern(&world->symbols, str_from(name));
}

static inline double symbol_of(World *world, const char *name) {
    return symbol_register(&world->symbols, str_from(name))->number;
}

static inline Value text_of(World *world, const char *text) {
    return value_string(&world->arena, str_from(text));
}

static inline Value node_of(World *world, const char *kind) {
    return value_node(&world->arena, node_new(&world->arena, name_of(world, kind)));
}

static inline Value read_element(World *world, const char *text) {
    static const char *const streams[] = {"uniform:", "beta:", "normal:"};
    for (int i = 0; i < 3; i++)
        if (strncmp(text, streams[i], strlen(streams[i])) == 0)
            return value_stream((StreamKind)i, strtoull(strchr(text, ':') + 1, NULL, 16));
    if (text[0] == ':')
        return value_number(symbol_of(world, text + 1));
    if (text[0] == '!')
        return node_of(world, text + 1);
    if (text[0] == '\'')
        return value_string(&world->arena, (Str){text + 1, strlen(text) - 2});
    return strcmp(text, "null") == 0 ? VALUE_NULL : value_number(strtod(text, NULL));
}

// Parses `;`-separated numbers, 'strings', :symbols, !kinds, null, and streams (uniform:KEY, beta:KEY, normal:KEY).
static inline Value read_value(World *world, const char *text) {
    Vector vector = vector_new(&world->arena);
    char *copy = str_to_c(&world->arena, str_from(text));
    for (char *part = copy, *end; part; part = end) {
        end = strchr(part, ';');
        if (end)
            *end++ = 0;
        vector_add(&vector, read_element(world, part));
    }
    return vector_finish(&vector);
}

static inline const char *text_c(const Text *text) {
    return str_to_c(text->arena, text_str(text));
}

// Returns the printed form (L18.1).
static inline const char *show(World *world, Value v) {
    Text text = text_new(&world->arena);
    format_value(&text, &world->symbols, v);
    return text_c(&text);
}
