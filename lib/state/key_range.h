// key_range.h: keys of particles whose ids count up, without an entry for each of them.
//
// The slots of a system's particles come in pairs, prefix;id and prefix;id;symbol, and mostly the ids count up. Such
// pairs in a row are a *series*: its keys follow from the first, and its values, which systems lend (state.h), from the
// address of the first. So it takes no memory, however long it is. What does not fit is the dictionary's to keep in
// entries of their own (state.c), into which a series is written out as soon as anything else happens to it.
#ifndef PETRI_STATE_KEY_RANGE_H
#define PETRI_STATE_KEY_RANGE_H

#include "state/state.h"

typedef struct Series {
    StateSlot first;
    uint32_t count;      // slots, of which the last may lack its partner
    uint32_t prefix_len; // numbers of the prefix, at least 1
    const double *head;  // the key of the second slot: prefix;id;symbol
    const double *keys;  // those of all second slots, once somebody has asked; else NULL
    uint32_t keys_count; // pairs that have one
    // Values: slots lend or have none. Those before `fresh` lie at `numbers`, `len` each, those from there on up to
    // `lent` where the system had them before.
    StateOwner owner;
    uint32_t len;
    uint32_t stored;
    uint32_t referenced;
    const double *numbers;
    const double *previous;
} KeyRange;

static inline bool key_range_has_slot(const KeyRange *range, StateSlot slot) {
    return slot >= range->first && slot - range->first < range->count;
}

// The slot of a key; STATE_NO_SLOT if it has none here.
StateSlot key_range_find(const KeyRange *range, Value key);
// Is this the key of the slot that comes next?
bool key_range_is_next(const KeyRange *range, Value key);
// Do two pairs of keys follow each other in one series?
bool key_range_follows(Value position, Value velocity, Value next_position, Value next_velocity);
// The number by which pair number `pair` is known.
double key_range_id(const KeyRange *range, uint32_t pair);
// Writes the key of the second slot of a pair.
void key_range_write_key(const KeyRange *range, uint32_t pair, double *to);

Value key_range_value(const KeyRange *range, StateSlot slot);
// Has a slot borrow numbers; false if they do not follow those of the slots before.
bool key_range_reference(KeyRange *range, StateSlot slot, StateOwner owner, const double *numbers, uint32_t len);
static inline bool key_range_references(const KeyRange *range, StateSlot slot, StateOwner owner) {
    return slot - range->first < range->referenced && range->owner == owner;
}

#endif
