// hash_index.h: the index of an insertion-ordered hash table, and growing arrays on the heap.
//
// The owner keeps its entries in an array of its own, in order of insertion; the index maps hashes to positions in that
// array. So entries stay dense and ordered, and one index serves tables of symbols, state keys and diagnostics.
#ifndef PETRI_BASE_HASH_INDEX_H
#define PETRI_BASE_HASH_INDEX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct HashIndexSlot {
    uint32_t hash;  // upper half of the 64-bit hash
    uint32_t entry; // position + 1; 0 is empty, INDEX_DELETED a removed one
} HashIndexSlot;

typedef struct HashIndex {
    HashIndexSlot *slots; // heap; NULL while empty
    uint32_t mask;
    uint32_t used; // slots in use, deleted ones included
    uint32_t live;
} HashIndex;

#define HASH_INDEX_NONE UINT32_C(0xfffffff0) // no entry has this position

// Does entry number `entry` have the key that is looked for?
typedef bool HashIndexMatch(const void *owner, uint32_t entry, const void *key);

void hash_index_free(HashIndex *index);
void hash_index_clear(HashIndex *index);
// Position of the entry with this key, or HASH_INDEX_NONE.
uint32_t hash_index_find(const HashIndex *index, uint64_t hash, HashIndexMatch *match, const void *owner,
                         const void *key);
// Adds a position; the key must not be there. False if memory is used up (then nothing has changed).
bool hash_index_add(HashIndex *index, uint64_t hash, uint32_t entry);
// Removes the entry at a position.
void hash_index_remove(HashIndex *index, uint64_t hash, uint32_t entry);

// A well-mixed 64-bit hash of bytes (FNV-1a finished by the SplitMix64 mixer).
uint64_t hash_bytes(uint64_t seed, const void *bytes, size_t len);
uint64_t hash_mix(uint64_t x);

#endif
