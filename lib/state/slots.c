// slots.c: the keys and values of slots, in entries and in key ranges; see state.h.
//
// A key in a range is written to a buffer of the caller. Only state_slot_key stores the keys of a whole range, because
// its result has the lifetime of the state.
#include "state/internal.h"

#include <math.h>

typedef struct KeysCopy {
    Arena *arena;
    KeyRange *range;
} KeysCopy;

static void write_keys(void *context) {
    KeysCopy *copy = context;
    KeyRange *range = copy->range;
    uint32_t pairs = (range->count + 1) / 2, stride = range->prefix_len + 2;
    double *keys = arena_alloc(copy->arena, (size_t)pairs * stride * sizeof *keys);
    for (uint32_t i = 0; i < pairs; i++)
        key_range_write_key(range, i, keys + (size_t)i * stride);
    range->keys = keys;
    range->keys_count = pairs;
}

// Returns the key of a slot in a range. The first call creates all keys of the range. Returns null if out of memory.
static Value range_key(State *state, KeyRange *range, StateSlot slot) {
    uint32_t at = slot - range->first, stride = range->prefix_len + 2;
    Arena *arena = &state->keys;
    KeysCopy copy = {arena, range};
    if (at / 2 >= range->keys_count && arena_protect(&arena, 1, write_keys, &copy) != ARENA_OK) {
        state->exhausted = true;
        return VALUE_NULL;
    }
    return (Value){.len = stride - 1 + at % 2, .as.numbers = range->keys + (size_t)(at / 2) * stride};
}

Value state_slot_get(const State *state, StateSlot slot) {
    const KeyRange *range = state_key_range(state, slot);
    return range ? key_range_value(range, slot) : slot < state->count ? state_entry(state, slot)->value : VALUE_NULL;
}

Value state_slot_key(const State *state, StateSlot slot) {
    KeyRange *range = state_key_range(state, slot);
    return range                 ? range_key((State *)state, range, slot)
           : slot < state->count ? state_entry(state, slot)->key
                                 : VALUE_NULL;
}

Value state_slot_key_in(const State *state, StateSlot slot, double buffer[STATE_KEY_BUFFER]) {
    const KeyRange *range = state_key_range(state, slot);
    if (!range)
        return state_slot_key(state, slot);
    uint32_t at = slot - range->first;
    key_range_write_key(range, at / 2, buffer);
    return (Value){.len = range->prefix_len + 1 + at % 2, .as.numbers = buffer};
}

const Value *state_slot_key_at(const State *state, StateSlot slot, Value *buffer) {
    if (!state_key_range(state, slot))
        return &state_entry(state, slot)->key;
    *buffer = state_slot_key(state, slot);
    return buffer;
}

const Value *state_slot_at(const State *state, StateSlot slot, Value *buffer) {
    const KeyRange *range = state_key_range(state, slot);
    if (!range)
        return &state_entry(state, slot)->value;
    *buffer = key_range_value(range, slot);
    return buffer;
}

double state_slot_last_number(const State *state, StateSlot slot, uint32_t len) {
    const KeyRange *range = state_key_range(state, slot);
    if (range)
        return range->prefix_len + 1 == len && (slot - range->first) % 2 == 0
                   ? key_range_id(range, (slot - range->first) / 2)
                   : NAN;
    Value key = state_slot_key(state, slot);
    Item last = key.len == len ? value_at(&key, len - 1) : (Item){.type = ITEM_STRING};
    return last.type == ITEM_NUMBER ? last.as.number : NAN;
}

uint32_t state_slot_count(const State *state) {
    return state->count;
}

uint32_t state_count(const State *state) {
    return state->live;
}
