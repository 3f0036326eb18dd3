// internal.h: internal declarations of lib/state.
#ifndef PETRI_STATE_INTERNAL_H
#define PETRI_STATE_INTERNAL_H

#include "base/arena.h"
#include "base/hash_index.h"
#include "state/key_range.h"

typedef struct StateEntry {
    Value key;   // data in the arena `keys`, or inline
    Value value; // in a heap block, or inline; with an owner, the owner's numbers; null: empty slot
    uint32_t hash;
    StateOwner owner;
} StateEntry;

// Bytes charged per slot in addition to key and value: the entry and its share of the index, with spare capacity.
#define SLOT_BYTES (2 * (sizeof(StateEntry) + sizeof(HashIndexSlot)))

enum {
    MAX_KEY_RANGES = 8,      // every look-up checks all ranges
    MAX_SEPARATE_PAIRS = 64, // consecutive slot pairs (key_range.h) stored as entries before they become a range
};

struct State {
    StateEntry *entries; // of all slots that are not in a range, in slot order
    uint32_t entry_count;
    uint32_t capacity;               // of `entries`
    uint32_t count;                  // number of slots, including empty ones
    uint32_t live;                   // number of slots with a value
    KeyRange ranges[MAX_KEY_RANGES]; // in slot order
    uint32_t range_count;
    uint32_t candidate_pairs; // slot pairs at the end of `entries` that could form a range
    HashIndex index;          // slots that have entries
    Arena keys;               // data of the keys
    bool *modified;           // by owner - 1: see state_clear_modified
    uint32_t owner_count;
    bool exhausted; // see state_clear_exhausted
    Budget *budget; // charged for memory; NULL: none
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
// Copies a key to the arena. Returns false if out of memory.
bool state_copy_key(Arena *keys, Value *copy, Value key);

#endif
