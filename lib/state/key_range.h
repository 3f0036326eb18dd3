// key_range.h: compact storage for the state keys of consecutive particle ids.
//
// A particle has a pair of slots, with the keys prefix;id and prefix;id;symbol. For consecutive ids, all keys can be
// computed from the first one. The owner of the values (state.h) stores them in one array, so the addresses of all
// values can be computed from that of the first. A range of any length therefore uses constant memory until one of its
// keys is requested. Other keys are stored as separate entries (state.c). A write that does not fit this pattern
// converts the range to entries.
#pragma once

#include "state/state.h"

typedef struct KeyRange {
    StateSlot first;
    uint32_t count;      // number of slots; odd while the last pair is incomplete
    uint32_t prefix_len; // length of the prefix in numbers, at least 1
    const double *head;  // key of the first particle's second slot: prefix;id;symbol
    const double *keys;  // array of the keys of all second slots; NULL until a key of the range is requested
    uint32_t keys_count; // number of pairs whose keys are in `keys`
    // Each value is either a reference to numbers of the owner or null.
    StateOwner owner;
    uint32_t len;        // length of each value
    uint32_t stored;     // number of slots, from the first, whose values are in `numbers`
    uint32_t referenced; // number of slots, from the first, with values; from slot `stored` on, they are in `previous`
    const double *numbers;  // current array of the owner
    const double *previous; // array of the owner before `numbers`
} KeyRange;

static inline bool key_range_has_slot(const KeyRange *range, StateSlot slot) {
    return slot >= range->first && slot - range->first < range->count;
}

// Returns the slot of a key, or STATE_NO_SLOT if it is not in the range.
StateSlot key_range_find(const KeyRange *range, Value key);
// Returns true if `key` is the key that would extend the range by one slot.
bool key_range_is_next(const KeyRange *range, Value key);
// Returns true if the four keys of two particles can be consecutive keys of a range.
bool key_range_follows(Value position, Value velocity, Value next_position, Value next_velocity);
// Returns the particle id of a pair.
double key_range_id(const KeyRange *range, uint32_t pair);
// Writes the key of a pair's second slot to `to`.
void key_range_write_key(const KeyRange *range, uint32_t pair, double *to);

// Returns the value of a slot, or null.
Value key_range_value(const KeyRange *range, StateSlot slot);
// Makes a slot reference `len` numbers of the owner. Returns false if these numbers are not directly after those of the
// previous slot.
bool key_range_reference(KeyRange *range, StateSlot slot, StateOwner owner, const double *numbers, uint32_t len);
// Returns true if a slot references numbers of the owner.
static inline bool key_range_references(const KeyRange *range, StateSlot slot, StateOwner owner) {
    return slot - range->first < range->referenced && range->owner == owner;
}
