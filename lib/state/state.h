// state.h: the state dictionary (spec language.md L11).
//
// Maps key vectors to non-null vectors for the lifetime of the session. Scripts only read it; physics systems and other
// parts of the engine write it between evaluations. A slot is a stable number, so a system looks up a key once and then
// accesses the slot without hashing. Slots are numbered as they are created, which depends on the history of the
// session. So nothing that a user sees or stores may depend on slot numbers: entries are listed in canonical order.
#pragma once

#include "value/value.h"

typedef struct State State;
typedef uint32_t StateSlot;
#define STATE_NO_SLOT UINT32_MAX

// Creates an empty dictionary. Returns NULL if out of memory. Memory is charged to the budget (NULL: none). If the
// budget is exceeded, functions fail as if out of memory.
State *state_new(Budget *budget);
void state_free(State *state);
// Removes all entries. Slots become invalid.
void state_clear(State *state);

// Returns true if a vector can be a key: it contains only strings and numbers other than NaN (L11.2), or is null.
bool state_key_valid(Value key);

// Returns the value of a key, or null. The value is valid until the key is written or removed.
Value state_get(const State *state, Value key);
// Stores a copy of the value; null removes the key. An invalid key is ignored. Storing a value that equals the stored
// value changes nothing, so -0 does not replace 0. Returns false if out of memory.
bool state_set(State *state, Value key, Value value);

// Returns the slot of a valid key and creates it if necessary. A slot without a value does not count as an entry. Slots
// are valid until state_clear or state_compact. Returns STATE_NO_SLOT if out of memory.
StateSlot state_slot(State *state, Value key);
// Returns the slot of a key, or STATE_NO_SLOT if it has none.
StateSlot state_find(const State *state, Value key);
// Returns the value of a slot, or null. The value is valid until the slot is written.
Value state_slot_get(const State *state, StateSlot slot);
// Returns the key of a slot. The key is valid until state_clear or state_compact. When the first key of a range
// (key_range.h) is requested, all keys of the range are created. If that runs out of memory, returns null.
Value state_slot_key(const State *state, StateSlot slot);
// Like state_slot_key, but allocates nothing: the result can point into `buffer`.
enum { STATE_KEY_BUFFER = 16 };
Value state_slot_key_in(const State *state, StateSlot slot, double buffer[STATE_KEY_BUFFER]);
bool state_slot_has_key(const State *state, StateSlot slot, Value key);
// Returns the last number of a key with `len` elements. If the key has another length or ends with a string, returns
// NaN, which no key contains.
double state_slot_last_number(const State *state, StateSlot slot, uint32_t len);
// Return the address of the key or the value of an existing slot. For a slot of a range, this is the address of
// `buffer`. The address is valid until a slot is created or until state_clear or state_compact. The address of a value
// also becomes invalid when the value is written.
const Value *state_slot_key_at(const State *state, StateSlot slot, Value *buffer);
const Value *state_slot_at(const State *state, StateSlot slot, Value *buffer);
// Like state_set. Numbers are overwritten in place if their count does not change.
bool state_slot_set(State *state, StateSlot slot, Value value);

// Owners. A physics system that keeps numbers across frames need not copy them to the dictionary. It registers as an
// owner, and entries reference its numbers. If another function writes or removes such an entry, the entry gets its own
// value. The owner is then marked as modified, because its numbers are out of date (see scene/mirror.h).
typedef uint32_t StateOwner; // number of an owner, from 1; 0: no owner
// Registers an owner. Returns 0 if out of memory.
StateOwner state_add_owner(State *state);
// Returns true if an entry of the owner was modified since the last call, even by the owner itself with state_slot_set.
bool state_clear_modified(State *state, StateOwner owner);
// Makes an entry reference `len` > 1 numbers. The numbers must not move until the entry is written or detached.
void state_slot_reference(State *state, StateSlot slot, StateOwner owner, const double *numbers, uint32_t len);
bool state_slot_references(const State *state, StateSlot slot, StateOwner owner);
// If the entry references numbers of the owner, copies them to the dictionary. If out of memory, removes the entry, or
// all entries of its range, and returns false.
bool state_slot_detach(State *state, StateSlot slot, StateOwner owner);

// Returns the number of slots, with or without a value. Slots of removed keys exist until state_compact.
uint32_t state_slot_count(const State *state);
// Removes the slots that have no value and whose byte in `used` is 0. A range is removed only if this applies to all
// its slots. Renumbers the remaining slots in order. moved[slot] gets the new number of each slot, or STATE_NO_SLOT if
// it is removed. Returns false, with nothing changed, if out of memory.
bool state_compact(State *state, const uint8_t *used, StateSlot *moved);

// Iterates over the entries with a value in canonical order of keys (spec digest.md 2), which depends only on the keys.
// *cursor starts at 0, and is valid until a slot is created or until state_clear or state_compact. Returns
// STATE_NO_SLOT at the end, or if out of memory (state_clear_exhausted).
StateSlot state_next_slot(State *state, uint32_t *cursor);
// Like state_next_slot, but returns the key and the value, and false at the end. The key is valid as long as `buffer`.
bool state_next(State *state, uint32_t *cursor, Value *key, Value *value, double buffer[STATE_KEY_BUFFER]);
// Returns the number of entries with a value.
uint32_t state_count(const State *state);

// Sorts slots by key in the order of format_key_compare. `scratch` is memory for `count` slots.
void state_sort_slots(const State *state, const SymbolTable *symbols, StateSlot *slots, StateSlot *scratch,
                      uint32_t count);

// Returns true if a function ran out of memory since the last call of this function.
bool state_clear_exhausted(State *state);
