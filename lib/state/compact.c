// compact.c: keys, and dropping those that nobody needs any more; see state.h.
#include "state/internal.h"

#include "base/heap.h"

void state_start_keys(Arena *keys, Meter *meter) {
    arena_init(keys, "state keys", SIZE_MAX);
    keys->meter = meter;
}

typedef struct KeyCopy {
    Arena *keys;
    Value key;
} KeyCopy;

static void copy_key(void *context) {
    KeyCopy *copy = context;
    copy->key = value_copy(copy->keys, copy->key);
}

// A copy of a key; false if memory is used up.
bool state_own_key(Arena *keys, Value *copy, Value key) {
    KeyCopy made = {keys, key};
    bool done = arena_protect(&keys, 1, copy_key, &made) == ARENA_DONE;
    *copy = made.key;
    return done;
}

// What a compaction makes, to take the place of what there is.
typedef struct Kept {
    Index index;
    Arena keys;
    Value *copies;            // of keys, of the entries that are kept
    Value heads[MOST_SERIES]; // likewise, of series
    bool whole[MOST_SERIES];  // that are kept, with all their slots
    uint32_t count;           // slots
    uint32_t entry_count;
} Kept;

// Which slots stay, under which numbers.
static void number_kept(const State *state, const uint8_t *used, StateSlot *moved, Kept *kept) {
    for (uint32_t k = 0; k < state->series_count; k++) {
        const Series *series = &state->series[k];
        kept->whole[k] = series->lent > 0;
        for (uint32_t i = 0; i < series->count; i++)
            kept->whole[k] |= used[series->first + i];
    }
    for (uint32_t i = 0; i < state->count; i++) {
        const Series *series = state_series(state, i);
        bool stays = series ? kept->whole[series - state->series] : used[i] || state_entry(state, i)->value.len > 0;
        moved[i] = stays ? kept->count++ : STATE_NO_SLOT;
    }
}

// Indexes the slots that are kept, and copies their keys. False if memory is used up.
static bool index_kept(const State *state, const StateSlot *moved, Kept *kept) {
    for (uint32_t k = 0; k < state->series_count; k++) {
        const Series *series = &state->series[k];
        if (kept->whole[k] && !state_own_key(&kept->keys, &kept->heads[k],
                                             (Value){.len = series->prefix_len + 2, .as.numbers = series->head}))
            return false;
    }
    for (uint32_t i = 0; i < state->count; i++) {
        if (moved[i] == STATE_NO_SLOT || state_series(state, i))
            continue;
        const StateEntry *entry = state_entry(state, i);
        if (!state_own_key(&kept->keys, &kept->copies[kept->entry_count++], entry->key) ||
            !index_add(&kept->index, (uint64_t)entry->hash << 32, moved[i]))
            return false;
    }
    return true;
}

static void move_kept(State *state, const StateSlot *moved, const Kept *kept) {
    uint32_t count = 0, series_count = 0;
    for (uint32_t i = 0; i < state->count; i++)
        if (moved[i] != STATE_NO_SLOT && !state_series(state, i)) {
            state->entries[count] = *state_entry(state, i);
            state->entries[count].key = kept->copies[count];
            count++;
        }
    for (uint32_t k = 0; k < state->series_count; k++)
        if (kept->whole[k]) {
            Series *series = &state->series[series_count++];
            *series = state->series[k];
            series->first = moved[series->first];
            series->head = kept->heads[k].as.numbers;
            series->keys_count = 0;
        }
    state->series_count = series_count;
    state->row = 0;
}

bool state_compact(State *state, const uint8_t *used, StateSlot *moved) {
    Kept kept = {.copies = heap_take((state->entry_count + 1) * sizeof(Value))};
    state_start_keys(&kept.keys, state->meter);
    number_kept(state, used, moved, &kept);
    bool done = kept.copies && index_kept(state, moved, &kept);
    if (done)
        move_kept(state, moved, &kept);
    heap_give(kept.copies);
    index_free(done ? &state->index : &kept.index);
    arena_free(done ? &state->keys : &kept.keys);
    if (!done)
        return false;
    state->index = kept.index;
    state->keys = kept.keys;
    meter_give(state->meter, (state->entry_count - kept.entry_count) * SLOT_BYTES);
    state->entry_count = kept.entry_count;
    state->count = kept.count;
    return true;
}
