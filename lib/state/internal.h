// internal.h: what the files of lib/state share; nobody else includes it.
#ifndef PETRI_STATE_INTERNAL_H
#define PETRI_STATE_INTERNAL_H

#include "base/arena.h"
#include "base/hash_index.h"
#include "state/key_range.h"

typedef struct StateEntry {
    Value key;   // in `keys`, or inline
    Value value; // one heap block, or inline; borrowed if there is a lender. Null: the slot is empty
    uint32_t hash;
    StateOwner owner;
} StateEntry;

// What a slot takes besides its key and value: the entry and its part of the index, both with room to grow.
#define SLOT_BYTES (2 * (sizeof(StateEntry) + sizeof(HashIndexSlot)))

enum {
    MAX_KEY_RANGES = 8,      // each look-up goes through them
    MAX_SEPARATE_PAIRS = 64, // pairs of slots that have entries though they might be a series
};

struct State {
    StateEntry *entries; // of all slots but those of series, in order
    uint32_t entry_count;
    uint32_t capacity;
    uint32_t count; // slots, empty ones included
    uint32_t live;
    KeyRange ranges[MAX_KEY_RANGES]; // in the order of their slots
    uint32_t range_count;
    uint32_t candidate_pairs; // pairs at the end of the entries that might be a series
    HashIndex index;          // slots that have entries
    Arena keys;
    bool *modified; // by lender
    uint32_t owner_count;
    bool exhausted; // see state_clear_exhausted
    Budget *budget; // that memory is charged to, or NULL
};

static inline KeyRange *state_key_range(const State *state, StateSlot slot) {
    for (uint32_t i = 0; i < state->range_count; i++)
        if (key_range_has_slot(&state->ranges[i], slot))
            return (KeyRange *)&state->ranges[i];
    return NULL;
}

// The entry of a slot that is in no series.
static inline StateEntry *state_entry(const State *state, StateSlot slot) {
    uint32_t skipped = 0;
    for (uint32_t i = 0; i < state->range_count && state->ranges[i].first < slot; i++)
        skipped += state->ranges[i].count;
    return &state->entries[slot - skipped];
}

// compact.c: begins an arena for keys; puts a copy of a key into one, or returns false if memory is used up.
void state_start_keys(Arena *keys, Budget *budget);
bool state_copy_key(Arena *keys, Value *copy, Value key);

#endif
