// internal.h: what the files of lib/state share; nobody else includes it.
#ifndef PETRI_STATE_INTERNAL_H
#define PETRI_STATE_INTERNAL_H

#include "base/arena.h"
#include "base/table.h"
#include "state/series.h"

typedef struct StateEntry {
    Value key;   // in `keys`, or inline
    Value value; // one heap block, or inline; borrowed if there is a lender. Null: the slot is empty
    uint32_t hash;
    StateLender lender;
} StateEntry;

// What a slot takes besides its key and value: the entry and its part of the index, both with room to grow.
#define SLOT_BYTES (2 * (sizeof(StateEntry) + sizeof(IndexSlot)))

enum {
    MOST_SERIES = 8, // each look-up goes through them
    MOST_ALONE = 64, // pairs of slots that have entries though they might be a series
};

struct State {
    StateEntry *entries; // of all slots but those of series, in order
    uint32_t entry_count;
    uint32_t capacity;
    uint32_t count; // slots, empty ones included
    uint32_t live;
    Series series[MOST_SERIES]; // in the order of their slots
    uint32_t series_count;
    uint32_t row; // pairs at the end of the entries that might be a series
    Index index;  // slots that have entries
    Arena keys;
    bool *disturbed; // by lender
    uint32_t lender_count;
    bool exhausted; // see state_take_exhausted
    Meter *meter;   // that memory is charged to, or NULL
};

static inline Series *state_series(const State *state, StateSlot slot) {
    for (uint32_t i = 0; i < state->series_count; i++)
        if (series_has_slot(&state->series[i], slot))
            return (Series *)&state->series[i];
    return NULL;
}

// The entry of a slot that is in no series.
static inline StateEntry *state_entry(const State *state, StateSlot slot) {
    uint32_t skipped = 0;
    for (uint32_t i = 0; i < state->series_count && state->series[i].first < slot; i++)
        skipped += state->series[i].count;
    return &state->entries[slot - skipped];
}

// compact.c: begins an arena for keys; puts a copy of a key into one, or returns false if memory is used up.
void state_start_keys(Arena *keys, Meter *meter);
bool state_own_key(Arena *keys, Value *copy, Value key);

#endif
