// state.h: the state dictionary (spec language.md L11).
//
// A mapping from key vectors to non-null vectors that lives as long as the session. Scripts only read it; engine
// systems write it between evaluations. Entries keep the order in which their slots were made, and a slot is a stable
// number, so a system finds a key once and then reads and writes its slot without hashing.
#ifndef PETRI_STATE_STATE_H
#define PETRI_STATE_STATE_H

#include "value/value.h"

typedef struct State State;
typedef uint32_t StateSlot;
#define STATE_NO_SLOT UINT32_MAX

// NULL if memory is used up. What it holds is charged to the meter (or NULL), which counts as memory that is used up,
// too, when it refuses.
State *state_new(Budget *budget);
void state_free(State *state);
// Removes every entry; slots become invalid.
void state_clear(State *state);

// Can this vector be a key at all: numbers (no nan) and strings only (L11.2). Null can.
bool state_key_valid(Value key);

// The value under a key, or null. A borrowed view: valid until that key is written or removed.
Value state_get(const State *state, Value key);
// Stores a copy of the value; null removes the key. An invalid key is ignored. A value that compares equal to the
// stored one leaves the stored one, so 0 is not replaced by -0. Returns false if memory is used up.
bool state_set(State *state, Value key, Value value);

// Slots. state_slot finds or makes the slot of a valid key; a slot without value is not an entry. It stays valid until
// state_clear. STATE_NO_SLOT if memory is used up.
StateSlot state_slot(State *state, Value key);
// The slot of a key if there is one, else STATE_NO_SLOT.
StateSlot state_find(const State *state, Value key);
Value state_slot_get(const State *state, StateSlot slot);
// The key of a slot; a borrowed view, valid until state_clear. Keys of particles whose ids count up are written out
// when the first of them is asked for (key_range.h): null if memory is used up.
Value state_slot_key(const State *state, StateSlot slot);
// The same without memory; valid as long as `room` is.
enum { STATE_KEY_BUFFER = 16 };
Value state_slot_key_in(const State *state, StateSlot slot, double buffer[STATE_KEY_BUFFER]);
bool state_slot_has_key(const State *state, StateSlot slot, Value key);
// The last number of a key of so many elements; the quiet NaN, which no key has, if this one has more or fewer or ends
// with a text.
double state_slot_last_number(const State *state, StateSlot slot, uint32_t len);
// Where key and value are, or `room`: valid until a slot is made, or state_clear. The slot must exist.
const Value *state_slot_key_at(const State *state, StateSlot slot, Value *buffer);
const Value *state_slot_at(const State *state, StateSlot slot, Value *buffer); // likewise, or until it is written to
// As state_set. Numbers of unchanged length are overwritten in place.
bool state_slot_set(State *state, StateSlot slot, Value value);

// Lenders. A system that owns numbers from frame to frame need not copy them here: it is a lender, and an entry borrows
// its numbers, which means that the entry points at them. Whoever else writes to or removes such an entry disturbs the
// lender: the entry owns its value from then on. scene/mirror.h says what for.
typedef uint32_t StateOwner; // 0: nobody
// 0 if memory is used up.
StateOwner state_add_owner(State *state);
// Has anything disturbed the lender since this was asked last? Its own writes with state_slot_set count too.
bool state_clear_modified(State *state, StateOwner owner);
// Lets an entry borrow `len` > 1 numbers, which must stay where they are until it is written to or owns a copy.
void state_slot_reference(State *state, StateSlot slot, StateOwner owner, const double *numbers, uint32_t len);
bool state_slot_references(const State *state, StateSlot slot, StateOwner owner);
// If the entry borrows from the lender, gives it a copy instead; if there is no memory for it, the entry is removed and
// false returned.
bool state_slot_detach(State *state, StateSlot slot, StateOwner owner);

// How many slots there are, with and without a value. Slots of removed keys stay until state_compact.
uint32_t state_slot_count(const State *state);
// Drops the slots that have neither a value nor a mark in `used` (one byte a slot), and moves the others together in
// order. `moved[slot]` becomes the new number of each, STATE_NO_SLOT for a dropped one. False, with nothing changed, if
// memory is used up.
bool state_compact(State *state, const uint8_t *used, StateSlot *moved);

// Entries that have a value, in the order of their slots: `*cursor` starts at 0; false at the end. The key is valid as
// long as `room` is.
bool state_next(const State *state, uint32_t *cursor, Value *key, Value *value, double buffer[STATE_KEY_BUFFER]);
uint32_t state_count(const State *state);

// Whether anything failed because memory was used up since this was asked last.
bool state_clear_exhausted(State *state);

#endif
