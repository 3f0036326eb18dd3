// compact.c: copying of keys, and removal of unused slots (state_compact).
#include "base/heap.h"
#include "state/internal.h"

void state_start_keys(Arena *keys, Budget *budget) {
    arena_init(keys, "state keys", SIZE_MAX);
    keys->budget = budget;
}

typedef struct KeyCopy {
    Arena *keys;
    Value key;
} KeyCopy;

static void copy_key(void *context) {
    KeyCopy *copy = context;
    copy->key = value_copy(copy->keys, copy->key);
}

bool state_copy_key(Arena *keys, Value *copy, Value key) {
    KeyCopy copy_call = {keys, key};
    bool done = arena_protect(&keys, 1, copy_key, &copy_call) == ARENA_OK;
    *copy = copy_call.key;
    return done;
}

// The new data of a compaction, which replaces the old data on success.
typedef struct Compaction {
    HashIndex index;
    Arena keys;
    Value *copies;                       // copies[i]: copy of the key of the entry that will have number i
    Value heads[MAX_KEY_RANGES];         // heads[k]: copy of the head of range k
    bool range_retained[MAX_KEY_RANGES]; // range_retained[k]: true if range k is kept, with all its slots
    uint32_t count;                      // number of slots that are kept
    uint32_t entry_count;                // number of entries that are kept
} Compaction;

// Determines which slots are kept. Sets moved[slot] to the new number of each slot, or to STATE_NO_SLOT.
static void number_slots(const State *state, const uint8_t *used, StateSlot *moved, Compaction *compaction) {
    for (uint32_t k = 0; k < state->range_count; k++) {
        const KeyRange *range = &state->ranges[k];
        compaction->range_retained[k] = range->referenced > 0;
        for (uint32_t i = 0; i < range->count; i++)
            compaction->range_retained[k] |= used[range->first + i];
    }
    for (uint32_t i = 0; i < state->count; i++) {
        const KeyRange *range = state_key_range(state, i);
        bool stays =
            range ? compaction->range_retained[range - state->ranges] : used[i] || state_entry(state, i)->value.len > 0;
        moved[i] = stays ? compaction->count++ : STATE_NO_SLOT;
    }
}

// Indexes the kept slots and copies their keys. Returns false if out of memory.
static bool index_slots(const State *state, const StateSlot *moved, Compaction *compaction) {
    for (uint32_t k = 0; k < state->range_count; k++) {
        const KeyRange *range = &state->ranges[k];
        if (compaction->range_retained[k] &&
            !state_copy_key(&compaction->keys, &compaction->heads[k],
                            (Value){.len = range->prefix_len + 2, .as.numbers = range->head}))
            return false;
    }
    for (uint32_t i = 0; i < state->count; i++) {
        if (moved[i] == STATE_NO_SLOT || state_key_range(state, i))
            continue;
        const StateEntry *entry = state_entry(state, i);
        if (!state_copy_key(&compaction->keys, &compaction->copies[compaction->entry_count++], entry->key) ||
            !hash_index_add(&compaction->index, (uint64_t)entry->hash << 32, moved[i]))
            return false;
    }
    return true;
}

static void move_entries(State *state, const StateSlot *moved, const Compaction *compaction) {
    uint32_t count = 0, range_count = 0;
    for (uint32_t i = 0; i < state->count; i++)
        if (moved[i] != STATE_NO_SLOT && !state_key_range(state, i)) {
            state->entries[count] = *state_entry(state, i);
            state->entries[count].key = compaction->copies[count];
            count++;
        }
    for (uint32_t k = 0; k < state->range_count; k++)
        if (compaction->range_retained[k]) {
            KeyRange *range = &state->ranges[range_count++];
            *range = state->ranges[k];
            range->first = moved[range->first];
            range->head = compaction->heads[k].as.numbers;
            range->keys_count = 0;
        }
    state->range_count = range_count;
    state->candidate_pairs = 0;
}

bool state_compact(State *state, const uint8_t *used, StateSlot *moved) {
    Compaction compaction = {.copies = heap_alloc((state->entry_count + 1) * sizeof(Value))};
    state_start_keys(&compaction.keys, state->budget);
    number_slots(state, used, moved, &compaction);
    bool done = compaction.copies && index_slots(state, moved, &compaction);
    if (done)
        move_entries(state, moved, &compaction);
    heap_free(compaction.copies);
    hash_index_free(done ? &state->index : &compaction.index);
    arena_free(done ? &state->keys : &compaction.keys);
    if (!done)
        return false;
    state->index = compaction.index;
    state->keys = compaction.keys;
    budget_release(state->budget, (state->entry_count - compaction.entry_count) * SLOT_BYTES);
    state->entry_count = compaction.entry_count;
    state->count = compaction.count;
    state_forget_order(state);
    return true;
}
