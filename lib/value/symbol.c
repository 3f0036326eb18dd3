// symbol.c: see symbol.h.
//
// An interned name becomes a symbol only by symbol_register, which refuses a name whose number another symbol has.
#include "value/symbol.h"

#include "base/number.h"

#include <string.h>

uint64_t symbol_hash(Str text) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t at = 0; at < text.len;)
        hash = (hash ^ (uint64_t)(uint32_t)utf8_next(text, &at)) * 0x100000001b3u;
    return hash;
}

double symbol_number(Str name) {
    uint64_t bits = 0xffe0000000000000u | symbol_hash(name) >> 12;
    double number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

SymbolTable symbol_table_new(Arena *arena) {
    return (SymbolTable){.arena = arena};
}

void symbol_table_free(SymbolTable *table) {
    hash_index_free(&table->by_name);
    hash_index_free(&table->by_number);
}

static bool has_symbol_name(const void *owner, uint32_t entry, const void *key) {
    return str_equal(((const SymbolTable *)owner)->items[entry]->name, *(const Str *)key);
}

static bool has_number(const void *owner, uint32_t entry, const void *key) {
    return ((const SymbolTable *)owner)->items[entry]->number == *(const double *)key;
}

static uint32_t intern_name(SymbolTable *table, Str name) {
    uint64_t hash = hash_bytes(0, name.bytes, name.len);
    uint32_t found = hash_index_find(&table->by_name, hash, has_symbol_name, table, &name);
    if (found != HASH_INDEX_NONE)
        return found;
    table->items = arena_grow_array(table->arena, table->items, table->count, &table->capacity, sizeof *table->items);
    Symbol *symbol = arena_alloc(table->arena, sizeof *symbol);
    *symbol = (Symbol){.name = str_copy(table->arena, name), .number = symbol_number(name)};
    if (!hash_index_add(&table->by_name, hash, table->count))
        arena_exhausted(table->arena);
    table->items[table->count] = symbol;
    return table->count++;
}

const Symbol *symbol_intern(SymbolTable *table, Str name) {
    uint32_t entry = intern_name(table, name); // must be called first, because it may move `items`
    return table->items[entry];
}

const Symbol *symbol_intern_batched(SymbolTable *table, Str name) {
    uint32_t entry = intern_name(table, name);
    table->items[entry]->batched = true;
    return table->items[entry];
}

const Symbol *symbol_register(SymbolTable *table, Str name) {
    uint32_t entry = intern_name(table, name);
    Symbol *symbol = table->items[entry];
    if (symbol->registered)
        return symbol;
    uint64_t hash = hash_mix(number_bits(symbol->number));
    if (hash_index_find(&table->by_number, hash, has_number, table, &symbol->number) != HASH_INDEX_NONE)
        return NULL;
    if (!hash_index_add(&table->by_number, hash, entry))
        arena_exhausted(table->arena);
    const Symbol **direct = &table->direct[number_bits(symbol->number) % DIRECT_SYMBOLS];
    *direct = *direct ? *direct : symbol;
    symbol->registered = true;
    return symbol;
}

const Symbol *symbol_of_number(const SymbolTable *table, double number) {
    if (!(number < -8.9e307)) // symbols are in (-1.8e308, -8.9e307], so most numbers return here
        return NULL;
    const Symbol *direct = table->direct[number_bits(number) % DIRECT_SYMBOLS];
    if (direct && direct->number == number)
        return direct;
    uint32_t entry = hash_index_find(&table->by_number, hash_mix(number_bits(number)), has_number, table, &number);
    return entry == HASH_INDEX_NONE ? NULL : table->items[entry];
}
