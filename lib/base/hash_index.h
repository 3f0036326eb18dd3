// hash_index.h: the index of an insertion-ordered hash table.
//
// The owner stores its entries in an array, in order of insertion. The index maps hashes to positions in that array, so
// entries stay dense and ordered. It is used for symbols, state keys and diagnostics.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct HashIndexSlot {
    uint32_t hash;  // upper half of the 64-bit hash
    uint32_t entry; // position of the entry + 1; 0: empty slot; INDEX_DELETED: the entry was removed
} HashIndexSlot;

typedef struct HashIndex {
    HashIndexSlot *slots; // on the heap; NULL: not allocated yet
    uint32_t mask;        // number of slots - 1
    uint32_t used;        // number of slots that are not empty, including those of removed entries
    uint32_t live;        // number of entries
} HashIndex;

#define HASH_INDEX_NONE UINT32_C(0xfffffff0) // result if no entry is found; not a valid position

// Returns true if the owner's entry at position `entry` has this key.
typedef bool HashIndexMatch(const void *owner, uint32_t entry, const void *key);

void hash_index_free(HashIndex *index);
void hash_index_clear(HashIndex *index);
// Returns the position of the entry with this key, or HASH_INDEX_NONE.
uint32_t hash_index_find(const HashIndex *index, uint64_t hash, HashIndexMatch *match, const void *owner,
                         const void *key);
// Adds an entry at position `entry`, whose key must not be in the index yet. Returns false, with nothing changed, if
// out of memory.
bool hash_index_add(HashIndex *index, uint64_t hash, uint32_t entry);
// Removes the entry at position `entry`, which must be in the index.
void hash_index_remove(HashIndex *index, uint64_t hash, uint32_t entry);

// Returns a well-mixed 64-bit hash of bytes: FNV-1a followed by the SplitMix64 mixer.
uint64_t hash_bytes(uint64_t seed, const void *bytes, size_t len);
// Returns x mixed by SplitMix64.
uint64_t hash_mix(uint64_t x);
