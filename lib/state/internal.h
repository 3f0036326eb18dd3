// internal.h: internal declarations of lib/state. Its files, from those that call to those that are called:
//
//   state.c                finds, stores and removes entries
//   compact.c, digest.c    memory of removed keys, and the digest
//   order.c                canonical order of keys
//   slots.c                keys and values of slots
//   key_range.c            entries whose keys are consecutive numbers
#pragma once

#include "base/arena.h"
#include "base/hash_index.h"
#include "state/digest.h"
#include "state/key_range.h"

typedef struct StateEntry {
    Value key;     // data is inline or in the arena State.keys
    Value value;   // data is inline, in a heap block or, if there is an owner, in the owner's array; null: empty slot
    uint32_t hash; // upper half of the 64-bit hash of the key
    StateOwner owner; // owner of the numbers of `value`; 0: none
} StateEntry;

// Bytes charged for each entry in addition to the data of its key and value. They cover the entry and its share of the
// index, both with spare capacity.
#define SLOT_BYTES (2 * (sizeof(StateEntry) + sizeof(HashIndexSlot)))

enum {
    MAX_KEY_RANGES = 8,      // small, because every look-up checks all ranges
    MAX_SEPARATE_PAIRS = 64, // when this many consecutive slot pairs (key_range.h) have entries, they become a range
};

// Consecutive slots whose keys are in canonical order (spec digest.md).
typedef struct SlotRun {
    StateSlot first;
    uint32_t count;
} SlotRun;

typedef struct SlotRuns {
    SlotRun *items;
    uint32_t count;
    uint32_t capacity;
} SlotRuns;

// A chunk of the numbers of all values, in canonical order of keys.
typedef struct DigestChunk {
    uint32_t run;    // index in Digest.order
    StateSlot slot;  // slot of the first number
    uint32_t number; // index of that number among the numbers of the slot's value
    uint8_t digest[STATE_DIGEST_SIZE];
} DigestChunk;

// Cached data of digests (digest.c).
typedef struct Digest {
    SlotRuns order;         // slots 0 to ordered - 1, with or without values, in canonical order of keys (order.c)
    uint32_t ordered;       // number of slots in `order`
    uint32_t last_run;      // index of the run in which state_next_slot found its last slot
    uint32_t last_position; // number of slots in the runs before it
    bool current;           // true if the following fields, except the digests of the chunks, are valid
    uint8_t shape[STATE_DIGEST_SIZE];
    uint64_t numbers; // number of numbers in all values
    DigestChunk *chunks;
    uint32_t chunk_count;
    uint32_t chunk_capacity;
} Digest;

struct State {
    StateEntry *entries; // entries of all slots that are not in a range, in slot order
    uint32_t entry_count;
    uint32_t capacity;               // capacity of `entries`
    uint32_t count;                  // number of slots, including empty ones
    uint32_t live;                   // number of slots with a value
    KeyRange ranges[MAX_KEY_RANGES]; // all ranges, in slot order
    uint32_t range_count;
    uint32_t candidate_pairs; // number of slot pairs at the end of `entries` that could form a range
    HashIndex index;          // maps keys to slots, for slots that have entries
    Arena keys;               // arena that holds the data of all keys
    bool *modified;           // modified[owner - 1]: result of the next state_clear_modified
    uint32_t owner_count;
    Digest digest;
    bool exhausted; // true if memory ran out since the last state_clear_exhausted
    Budget *budget; // budget that is charged for memory; NULL: none
};

// Returns the range that contains a slot, or NULL.
static inline KeyRange *state_key_range(const State *state, StateSlot slot) {
    for (uint32_t i = 0; i < state->range_count; i++)
        if (key_range_has_slot(&state->ranges[i], slot))
            return (KeyRange *)&state->ranges[i];
    return NULL;
}

// Returns the entry of a slot that is not in a range.
static inline StateEntry *state_entry(const State *state, StateSlot slot) {
    uint32_t skipped = 0;
    for (uint32_t i = 0; i < state->range_count && state->ranges[i].first < slot; i++)
        skipped += state->ranges[i].count;
    return &state->entries[slot - skipped];
}

// Initialises an arena for keys (compact.c).
void state_start_keys(Arena *keys, Budget *budget);
// Sets *copy to a copy of a key in the arena. Returns false if out of memory.
bool state_copy_key(Arena *keys, Value *copy, Value key);

// Adds the slots that are not in digest.order yet (order.c). Returns false if out of memory.
bool state_update_order(State *state);
// Forgets the order of slots, because they were removed or renumbered.
void state_forget_order(State *state);
void state_free_digest(State *state);
// Ensures that the heap array *array has more than `count` elements, and charges the budget. Returns false if out of
// memory.
bool state_grow(State *state, void **array, uint32_t *capacity, uint32_t count, size_t size);
