// state.c: see state.h.
#include "state/state.h"

#include "base/arena.h"
#include "base/heap.h"
#include "base/number.h"
#include "base/table.h"
#include "maths/random.h"

#include <math.h>
#include <string.h>

typedef struct StateEntry {
    Value key;   // in `keys`, or inline
    Value value; // one heap block, or inline; borrowed if there is a lender. Null: the slot is empty
    uint32_t hash;
    StateLender lender;
} StateEntry;

// What a slot takes besides its key and value: the entry and its part of the index, both with room to grow.
#define SLOT_BYTES (2 * (sizeof(StateEntry) + sizeof(IndexSlot)))

struct State {
    StateEntry *entries;
    uint32_t count; // slots, empty ones included
    uint32_t capacity;
    uint32_t live;
    Index index;
    Arena keys;
    bool *disturbed; // by lender
    uint32_t lender_count;
    bool exhausted; // see state_take_exhausted
    Meter *meter;   // that memory is charged to, or NULL
};

static void start_keys(Arena *keys, Meter *meter) {
    arena_init(keys, "state keys", SIZE_MAX);
    keys->meter = meter;
}

State *state_new(Meter *meter) {
    State *state = heap_zeroed(1, sizeof(State));
    if (!state)
        return NULL;
    state->meter = meter;
    start_keys(&state->keys, meter);
    return state;
}

// A block for a value, within the budget.
static void *take(State *state, size_t bytes) {
    void *block = meter_take(state->meter, bytes) ? heap_take(bytes) : NULL;
    if (!block)
        state->exhausted = true;
    return block;
}

typedef struct KeyCopy {
    Arena *keys;
    Value key;
} KeyCopy;

static void copy_key(void *context) {
    KeyCopy *copy = context;
    copy->key = value_copy(copy->keys, copy->key);
}

static bool exhausted(State *state) {
    state->exhausted = true;
    return false;
}

// A copy of a key; false if memory is used up.
static bool own_key(Arena *keys, Value *copy, Value key) {
    KeyCopy made = {keys, key};
    bool done = arena_protect(&keys, 1, copy_key, &made) == ARENA_DONE;
    *copy = made.key;
    return done;
}

// A mixed vector is kept as one heap block: items, then Strings, then their bytes.
typedef struct Parts {
    size_t strings;
    size_t bytes; // of their texts
} Parts;

static Parts parts_of(Value v) {
    Parts parts = {0};
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        if (v.as.items[i].type == ITEM_STRING) {
            parts.strings++;
            parts.bytes += v.as.items[i].as.string->text.len;
        }
    return parts;
}

// Bytes of the block of a value; 0 if it has none.
static size_t block_size(Value v) {
    if (v.kind == VALUE_NUMBERS)
        return v.len > 1 ? v.len * sizeof(double) : 0;
    Parts parts = parts_of(v);
    return v.len * sizeof(Item) + parts.strings * sizeof(String) + parts.bytes;
}

static Value own_mixed(void *block, Value v) {
    Item *items = block;
    String *string = (String *)(items + v.len);
    char *text = (char *)(string + parts_of(v).strings);
    for (uint32_t i = 0; i < v.len; i++) {
        items[i] = v.as.items[i];
        if (items[i].type != ITEM_STRING)
            continue;
        Str from = items[i].as.string->text;
        if (from.len)
            memcpy(text, from.bytes, from.len);
        *string = (String){{text, from.len}};
        items[i].as.string = string++;
        text += from.len;
    }
    return (Value){.len = v.len, .kind = VALUE_MIXED, .as.items = items};
}

static bool own(State *state, Value *copy, Value v) {
    size_t size = block_size(v);
    *copy = v;
    if (!size)
        return true;
    void *block = take(state, size);
    if (!block)
        return false;
    if (v.kind == VALUE_MIXED)
        *copy = own_mixed(block, v);
    else
        copy->as.numbers = memcpy(block, v.as.numbers, size);
    return true;
}

static void disown(State *state, StateEntry *entry) {
    Value *v = &entry->value;
    size_t size = entry->lender ? 0 : block_size(*v);
    if (size) {
        meter_give(state->meter, size);
        heap_give((void *)v->as.numbers);
    }
    entry->lender = 0;
    *v = VALUE_NULL;
}

void state_clear(State *state) {
    for (uint32_t i = 0; i < state->count; i++)
        disown(state, &state->entries[i]);
    meter_give(state->meter, state->count * SLOT_BYTES);
    state->count = state->live = 0;
    index_clear(&state->index);
    arena_reset(&state->keys);
    for (uint32_t i = 0; i < state->lender_count; i++)
        state->disturbed[i] = true;
}

void state_free(State *state) {
    if (!state)
        return;
    state_clear(state);
    index_free(&state->index);
    arena_free(&state->keys);
    heap_give(state->disturbed);
    heap_give(state->entries);
    heap_give(state);
}

bool state_key_valid(Value key) {
    if (key.kind == VALUE_STREAM)
        return false;
    for (uint32_t i = 0; i < key.len; i++) {
        Item item = value_at(&key, i);
        if (item.type == ITEM_NODE || item.type == ITEM_FUNCTION || (item.type == ITEM_NUMBER && isnan(item.as.number)))
            return false;
    }
    return true;
}

static uint64_t key_hash(Value key) {
    uint64_t hash = RANDOM_HASH_START;
    for (uint32_t i = 0; i < key.len; i++) {
        Item item = value_at(&key, i);
        uint64_t y = item.type == ITEM_NUMBER ? number_bits(item.as.number)
                                              : hash_bytes(1, item.as.string->text.bytes, item.as.string->text.len);
        hash = random_hash_step(hash, y);
    }
    return hash;
}

// Same bits, same code points (L11.2): stricter than ==.
static bool key_equal(Value a, Value b) {
    if (a.len != b.len || a.kind != b.kind)
        return false;
    for (uint32_t i = 0; i < a.len; i++) {
        Item x = value_at(&a, i), y = value_at(&b, i);
        if (x.type != y.type)
            return false;
        if (x.type == ITEM_NUMBER ? number_bits(x.as.number) != number_bits(y.as.number) : !item_equal(NULL, x, y))
            return false;
    }
    return true;
}

static bool entry_has_key(const void *owner, uint32_t entry, const void *key) {
    return key_equal(((const State *)owner)->entries[entry].key, *(const Value *)key);
}

static uint32_t find(const State *state, Value key, uint64_t hash) {
    return index_find(&state->index, hash, entry_has_key, state, &key);
}

StateSlot state_slot(State *state, Value key) {
    if (!state_key_valid(key))
        return STATE_NO_SLOT;
    uint64_t hash = key_hash(key);
    uint32_t found = find(state, key, hash);
    if (found != INDEX_NONE)
        return found;
    StateEntry entry = {.hash = (uint32_t)(hash >> 32)};
    if (!meter_take(state->meter, SLOT_BYTES))
        return exhausted(state), STATE_NO_SLOT;
    if (!heap_reserve((void **)&state->entries, &state->capacity, state->count, sizeof entry) ||
        !index_add(&state->index, hash, state->count)) {
        meter_give(state->meter, SLOT_BYTES);
        return exhausted(state), STATE_NO_SLOT;
    }
    if (!own_key(&state->keys, &entry.key, key)) {
        index_remove(&state->index, hash, state->count);
        meter_give(state->meter, SLOT_BYTES);
        return exhausted(state), STATE_NO_SLOT;
    }
    state->entries[state->count] = entry;
    return state->count++;
}

StateSlot state_find(const State *state, Value key) {
    uint32_t found = state_key_valid(key) ? find(state, key, key_hash(key)) : INDEX_NONE;
    return found == INDEX_NONE ? STATE_NO_SLOT : found;
}

Value state_slot_get(const State *state, StateSlot slot) {
    return slot < state->count ? state->entries[slot].value : VALUE_NULL;
}

Value state_slot_key(const State *state, StateSlot slot) {
    return slot < state->count ? state->entries[slot].key : VALUE_NULL;
}

const Value *state_slot_key_at(const State *state, StateSlot slot) {
    return &state->entries[slot].key;
}

const Value *state_slot_at(const State *state, StateSlot slot) {
    return &state->entries[slot].value;
}

// Puts a value that the entry owns from now on in the place of the one it has.
static void replace(State *state, StateEntry *entry, Value owned) {
    state->live += (owned.len > 0);
    state->live -= (entry->value.len > 0);
    if (entry->lender)
        state->disturbed[entry->lender - 1] = true;
    disown(state, entry);
    entry->value = owned;
}

bool state_slot_set(State *state, StateSlot slot, Value value) {
    if (slot >= state->count)
        return slot != STATE_NO_SLOT;
    StateEntry *entry = &state->entries[slot];
    Value *stored = &entry->value;
    if (value.len > 0 && value_equal(NULL, *stored, value))
        return true; // equal values leave the stored bits alone
    if (!entry->lender && value.kind == VALUE_NUMBERS && stored->kind == VALUE_NUMBERS && value.len == stored->len &&
        value.len > 0) {
        if (value.len == 1)
            *stored = value;
        else
            memcpy((void *)stored->as.numbers, value.as.numbers, value.len * sizeof(double));
        return true;
    }
    Value copy;
    if (!own(state, &copy, value.len ? value : VALUE_NULL))
        return false;
    replace(state, entry, copy);
    return true;
}

StateLender state_add_lender(State *state) {
    bool *larger = heap_resize(state->disturbed, (state->lender_count + 1) * sizeof *larger);
    if (!larger)
        return exhausted(state), 0;
    state->disturbed = larger;
    larger[state->lender_count] = false;
    return ++state->lender_count;
}

bool state_take_disturbed(State *state, StateLender lender) {
    bool disturbed = state->disturbed[lender - 1];
    state->disturbed[lender - 1] = false;
    return disturbed;
}

void state_slot_borrow(State *state, StateSlot slot, StateLender lender, const double *numbers, uint32_t len) {
    if (slot >= state->count)
        return;
    StateEntry *entry = &state->entries[slot];
    if (entry->lender == lender && entry->value.len == len) {
        entry->value.as.numbers = numbers;
        return;
    }
    replace(state, entry, value_numbers_view(numbers, len));
    entry->lender = lender;
}

bool state_slot_borrows(const State *state, StateSlot slot, StateLender lender) {
    return lender && slot < state->count && state->entries[slot].lender == lender;
}

bool state_slot_own_copy(State *state, StateSlot slot, StateLender lender) {
    if (!state_slot_borrows(state, slot, lender))
        return true;
    StateEntry *entry = &state->entries[slot];
    Value copy;
    if (!own(state, &copy, entry->value)) {
        replace(state, entry, VALUE_NULL);
        return false;
    }
    entry->value = copy;
    entry->lender = 0;
    return true;
}

Value state_get(const State *state, Value key) {
    return state_slot_get(state, state_find(state, key));
}

bool state_set(State *state, Value key, Value value) {
    if (!state_key_valid(key))
        return true;
    StateSlot slot = value.len ? state_slot(state, key) : state_find(state, key);
    return slot == STATE_NO_SLOT ? value.len == 0 : state_slot_set(state, slot, value);
}

uint32_t state_slot_count(const State *state) {
    return state->count;
}

// Indexes the slots that are kept, under their new numbers, and copies their keys. False if memory is used up.
static bool index_kept(const State *state, const uint8_t *used, StateSlot *moved, Index *index, Arena *keys,
                       Value *copies) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < state->count; i++) {
        const StateEntry *entry = &state->entries[i];
        moved[i] = used[i] || entry->value.len > 0 ? count++ : STATE_NO_SLOT;
        if (moved[i] != STATE_NO_SLOT &&
            (!own_key(keys, &copies[moved[i]], entry->key) || !index_add(index, (uint64_t)entry->hash << 32, moved[i])))
            return false;
    }
    return true;
}

bool state_compact(State *state, const uint8_t *used, StateSlot *moved) {
    Index index = {0};
    Arena keys;
    start_keys(&keys, state->meter);
    Value *copies = heap_take((state->count + 1) * sizeof *copies);
    if (!copies || !index_kept(state, used, moved, &index, &keys, copies)) {
        index_free(&index);
        arena_free(&keys);
        heap_give(copies);
        return false;
    }
    uint32_t count = 0;
    for (uint32_t i = 0; i < state->count; i++) {
        if (moved[i] == STATE_NO_SLOT)
            continue;
        state->entries[moved[i]] = state->entries[i];
        state->entries[moved[i]].key = copies[moved[i]];
        count++;
    }
    heap_give(copies);
    index_free(&state->index);
    arena_free(&state->keys);
    state->index = index;
    state->keys = keys;
    meter_give(state->meter, (state->count - count) * SLOT_BYTES);
    state->count = count;
    return true;
}

bool state_next(const State *state, uint32_t *cursor, Value *key, Value *value) {
    while (*cursor < state->count) {
        const StateEntry *entry = &state->entries[(*cursor)++];
        if (entry->value.len > 0) {
            *key = entry->key;
            *value = entry->value;
            return true;
        }
    }
    return false;
}

uint32_t state_count(const State *state) {
    return state->live;
}

bool state_take_exhausted(State *state) {
    bool was = state->exhausted;
    state->exhausted = false;
    return was;
}
