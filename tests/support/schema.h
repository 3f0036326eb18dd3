// schema.h: symbols and a schema for tests of node readers. Records the diagnostics of the readers.
#pragma once

#include "check.h"
#include "schema/reader.h"

typedef struct Fixture {
    Arena arena;
    SymbolTable symbols;
    Schema schema;
    char reported[2000]; // diagnostics as lines `!node text [code]`
} Fixture;

static inline void fixture_report(void *user_data, DiagLevel level, const char *code, const Origin *origin, Str node,
                                  Str key, Str text) {
    (void)level, (void)origin, (void)key;
    Fixture *f = user_data;
    size_t len = strlen(f->reported);
    snprintf(f->reported + len, sizeof f->reported - len, "%.*s %.*s [%s]\n", (int)node.len, node.bytes, (int)text.len,
             text.bytes, code);
}

static inline void begin(Fixture *f) {
    *f = (Fixture){0};
    arena_init(&f->arena, "test", SIZE_MAX);
    f->symbols = symbol_table_new(&f->arena);
    schema_init(&f->schema, &f->symbols, (SchemaSink){f, fixture_report});
}

static inline void end(Fixture *f) {
    symbol_table_free(&f->symbols);
    arena_free(&f->arena);
}
