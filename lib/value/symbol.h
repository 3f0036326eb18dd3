// symbol.h: interned names, and the numbers that symbols are.
//
// Every name in a program (variables, attributes, tags, node kinds, symbols) is interned once per session; after the
// lexer names are compared as pointers. A symbol's value is a number computed from its name (spec language.md L4.3),
// and a number that equals the value of a symbol that has occurred *is* that symbol.
#ifndef PETRI_VALUE_SYMBOL_H
#define PETRI_VALUE_SYMBOL_H

#include "base/arena.h"
#include "base/hash_index.h"
#include "base/str.h"

typedef struct Symbol {
    Str name;
    double number;   // the value of `:name`
    bool registered; // has occurred as a symbol, not only as a name
    bool batched;    // nodes of this kind may be very many, so that a loop keeps them as rows (value/node_batch.h)
} Symbol;

typedef struct SymbolTable {
    Arena *arena; // session lifetime
    Symbol **items;
    uint32_t count;
    uint32_t capacity;
    HashIndex by_name;
    HashIndex by_number; // known symbols only
} SymbolTable;

// 64-bit FNV-1a over the code points of the text (L4.3).
uint64_t symbol_hash(Str text);
// The double whose bits are 0xFFE0000000000000 | (symbol_hash(name) >> 12).
double symbol_number(Str name);

SymbolTable symbol_table_new(Arena *arena);
void symbol_table_free(SymbolTable *table);
// The one Symbol of this name; lives as long as the table.
const Symbol *symbol_intern(SymbolTable *table, Str name);
// The same, marked as having occurred as a symbol. NULL if another known symbol has the same number (a collision).
const Symbol *symbol_register(SymbolTable *table, Str name);
// The same as symbol_intern, marked as the kind of very many nodes.
const Symbol *symbol_intern_batched(SymbolTable *table, Str name);
// The known symbol with this number, or NULL.
const Symbol *symbol_of_number(const SymbolTable *table, double number);

#endif
