// world.h: a context for calling built-ins, and assertions about values.
#pragma once

#include "base/number.h"
#include "builtin/builtin.h"
#include "builtin/files.h"
#include "builtin/noise.h"
#include "groups.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct World {
    Arena session;
    Arena frame;
    SymbolTable symbols;
    BuiltinContext context;
    uint32_t errors;
    uint32_t logs;
    char text[400]; // text of the last error or log line
} World;

static inline void world_note(World *world, Str text) {
    snprintf(world->text, sizeof world->text, "%.*s", (int)text.len, text.bytes);
}

static inline void world_report(void *user_data, Str text) {
    World *world = user_data;
    world->errors++;
    world_note(world, text);
}

static inline void world_log(void *user_data, Str text) {
    World *world = user_data;
    world->logs++;
    world_note(world, text);
}

static inline World *world_new(void) {
    static World world; // shared by all tests of the program
    world = (World){0};
    arena_init(&world.session, "session", (size_t)1 << 30);
    arena_init(&world.frame, "frame", (size_t)4 << 30);
    world.symbols = symbol_table_new(&world.session);
    world.context = (BuiltinContext){
        .arena = &world.frame,
        .symbols = &world.symbols,
        .files = file_cache_new(),
        .noise = noise_cache_new(),
        .directory = STR(""),
        .report_error = world_report,
        .log = world_log,
        .user_data = &world,
    };
    return &world;
}

static inline void world_free(World *world) {
    file_cache_free(world->context.files);
    noise_cache_free(world->context.noise);
    symbol_table_free(&world->symbols);
    arena_free(&world->frame);
    arena_free(&world->session);
}

static inline int world_setup(void **state) {
    *state = world_new();
    return 0;
}

static inline int world_teardown(void **state) {
    world_free(*state);
    return 0;
}

static inline bool same_number(double a, double b) {
    return (a == b && signbit(a) == signbit(b)) || (isnan(a) && isnan(b));
}

// Returns true if both numbers have the same bits or both are NaN.
static inline bool same_value(Value a, Value b) {
    if (a.kind != b.kind || a.len != b.len)
        return false;
    if (a.kind == VALUE_STREAM)
        return a.stream == b.stream && a.as.key == b.as.key;
    for (uint32_t i = 0; i < a.len; i++) {
        Item x = value_at(&a, i), y = value_at(&b, i);
        if (x.type == ITEM_NUMBER && y.type == ITEM_NUMBER ? !same_number(x.as.number, y.as.number)
                                                           : !item_equal(NULL, x, y))
            return false;
    }
    return true;
}

static inline void print_value(Value v) {
    char digits[NUMBER_TEXT];
    for (uint32_t i = 0; i < v.len && i < 40; i++) {
        Item item = value_at(&v, i);
        if (item.type == ITEM_NUMBER)
            fprintf(stderr, "%.*s;", (int)number_format(item.as.number, digits), digits);
        else if (item.type == ITEM_STRING)
            fprintf(stderr, "'%.*s';", (int)item.as.string->text.len, item.as.string->text.bytes);
        else
            fprintf(stderr, "(other);");
    }
    fprintf(stderr, " (%u)\n", v.len);
}

// Checks the invariants of value.h.
static inline void assert_well_formed(Value v) {
    if (v.kind == VALUE_NUMBERS || v.kind == VALUE_STREAM) {
        assert_true(v.kind == VALUE_NUMBERS || v.len == 0);
        volatile double sum = 0; // reads every element, so that the sanitizers detect invalid memory
        for (uint32_t i = 0; i < v.len; i++)
            sum = sum + value_numbers(&v)[i];
        return;
    }
    assert_int_equal(v.kind, VALUE_MIXED);
    assert_true(v.len > 0);
    uint32_t others = 0;
    for (uint32_t i = 0; i < v.len; i++) {
        Item item = v.as.items[i];
        others += item.type != ITEM_NUMBER;
        if (item.type == ITEM_STRING)
            assert_true(utf8_find_error(item.as.string->text) == item.as.string->text.len);
    }
    assert_true(others > 0);
}
