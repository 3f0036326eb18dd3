// symbol.h: interned names and symbol values.
//
// Every name in a program (variables, attributes, tags, node kinds, symbols) is interned once per session, so names are
// compared as pointers. The value of a symbol is a number computed from its name (spec language.md L4.3). A number that
// equals the value of a registered symbol is that symbol.
#pragma once

#include "base/arena.h"
#include "base/hash_index.h"
#include "base/str.h"

typedef struct Symbol {
    Str name;
    double number;   // the value of `:name`
    bool registered; // the name occurred as a symbol (`:name`), not only without the colon
    bool batched;    // loops store nodes of this kind as batches (value/node_batch.h)
} Symbol;

enum { DIRECT_SYMBOLS = 64 };

typedef struct SymbolTable {
    Arena *arena; // arena of the session
    Symbol **items;
    uint32_t count;
    uint32_t capacity;
    HashIndex by_name;
    HashIndex by_number; // contains only registered symbols
    // The first registered symbol for each value of the last bits of the number, or NULL. Looked up before by_number.
    const Symbol *direct[DIRECT_SYMBOLS];
} SymbolTable;

// Returns the 64-bit FNV-1a hash of the code points of a string (L4.3).
uint64_t symbol_hash(Str text);
// Returns the double whose bits are 0xFFE0000000000000 | (symbol_hash(name) >> 12).
double symbol_number(Str name);

SymbolTable symbol_table_new(Arena *arena);
void symbol_table_free(SymbolTable *table);
// Returns the unique Symbol of a name. Valid as long as the table.
const Symbol *symbol_intern(SymbolTable *table, Str name);
// Like symbol_intern, but also registers the symbol. Returns NULL if another registered symbol has the same number.
const Symbol *symbol_register(SymbolTable *table, Str name);
// Like symbol_intern, but also sets `batched`.
const Symbol *symbol_intern_batched(SymbolTable *table, Str name);
// Returns the registered symbol with this number, or NULL.
const Symbol *symbol_of_number(const SymbolTable *table, double number);
