// series.h: keys of particles whose ids count up, without an entry for each of them.
//
// The slots of a system's particles come in pairs, prefix;id and prefix;id;symbol, and mostly the ids count up. Such
// pairs in a row are a *series*: its keys follow from the first, and its values, which systems lend (state.h), from the
// address of the first. So it takes no memory, however long it is. What does not fit is the dictionary's to keep in
// entries of their own (state.c), into which a series is written out as soon as anything else happens to it.
#ifndef PETRI_STATE_SERIES_H
#define PETRI_STATE_SERIES_H

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
    StateLender lender;
    uint32_t len;
    uint32_t fresh;
    uint32_t lent;
    const double *numbers;
    const double *before;
} Series;

static inline bool series_has_slot(const Series *series, StateSlot slot) {
    return slot >= series->first && slot - series->first < series->count;
}

// The slot of a key; STATE_NO_SLOT if it has none here.
StateSlot series_find(const Series *series, Value key);
// Is this the key of the slot that comes next?
bool series_is_next(const Series *series, Value key);
// Do two pairs of keys follow each other in one series?
bool series_follow(Value position, Value velocity, Value next_position, Value next_velocity);
// The number by which pair number `pair` is known.
double series_id(const Series *series, uint32_t pair);
// Writes the key of the second slot of a pair.
void series_write_key(const Series *series, uint32_t pair, double *to);

Value series_value(const Series *series, StateSlot slot);
// Has a slot borrow numbers; false if they do not follow those of the slots before.
bool series_borrow(Series *series, StateSlot slot, StateLender lender, const double *numbers, uint32_t len);
static inline bool series_borrows(const Series *series, StateSlot slot, StateLender lender) {
    return slot - series->first < series->lent && series->lender == lender;
}

#endif
