// state.c: see state.h.
//
// A key range contains only references to an owner's numbers, or no values. Before any other value is stored in one of
// its slots, the range is converted to entries (ensure_entry). A change of anything but the numbers of a value makes
// the digest stale.
#include "base/arena.h"
#include "base/hash_index.h"
#include "base/heap.h"
#include "base/number.h"
#include "maths/random.h"
#include "state/internal.h"

#include <math.h>
#include <string.h>

State *state_new(Budget *budget) {
    State *state = heap_calloc(1, sizeof(State));
    if (!state)
        return NULL;
    state->budget = budget;
    state_start_keys(&state->keys, budget);
    return state;
}

// Allocates the block of a value and charges it to the budget.
static void *alloc_block(State *state, size_t bytes) {
    void *block = budget_reserve(state->budget, bytes) ? heap_alloc(bytes) : NULL;
    if (!block)
        state->exhausted = true;
    return block;
}

static bool set_exhausted(State *state) {
    state->exhausted = true;
    return false;
}

// Sizes of a mixed vector. It is stored in one heap block: the items, then the Strings, then their bytes.
typedef struct Parts {
    size_t strings; // number of strings
    size_t bytes;   // total length of the strings
} Parts;

static Parts count_parts(Value v) {
    Parts parts = {0};
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        if (v.as.items[i].type == ITEM_STRING) {
            parts.strings++;
            parts.bytes += v.as.items[i].as.string->text.len;
        }
    return parts;
}

// Returns the size of the block of a value, or 0 if it is stored inline.
static size_t block_size(Value v) {
    if (v.kind == VALUE_NUMBERS)
        return v.len > 1 ? v.len * sizeof(double) : 0;
    Parts parts = count_parts(v);
    return v.len * sizeof(Item) + parts.strings * sizeof(String) + parts.bytes;
}

static Value copy_mixed(void *block, Value v) {
    Item *items = block;
    String *string = (String *)(items + v.len);
    char *text = (char *)(string + count_parts(v).strings);
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

static bool copy_value(State *state, Value *copy, Value v) {
    size_t size = block_size(v);
    *copy = v;
    if (!size)
        return true;
    void *block = alloc_block(state, size);
    if (!block)
        return false;
    if (v.kind == VALUE_MIXED)
        *copy = copy_mixed(block, v);
    else
        copy->as.numbers = memcpy(block, v.as.numbers, size);
    return true;
}

static void free_value(State *state, StateEntry *entry) {
    Value *v = &entry->value;
    size_t size = entry->owner ? 0 : block_size(*v);
    if (size) {
        budget_release(state->budget, size);
        heap_free((void *)v->as.numbers);
    }
    entry->owner = 0;
    *v = VALUE_NULL;
}

void state_clear(State *state) {
    for (uint32_t i = 0; i < state->entry_count; i++)
        free_value(state, &state->entries[i]);
    budget_release(state->budget, state->entry_count * SLOT_BYTES);
    state->count = state->live = state->entry_count = state->range_count = state->candidate_pairs = 0;
    hash_index_clear(&state->index);
    arena_reset(&state->keys);
    for (uint32_t i = 0; i < state->owner_count; i++)
        state->modified[i] = true;
    state_forget_order(state);
}

void state_free(State *state) {
    if (!state)
        return;
    state_clear(state);
    state_free_digest(state);
    hash_index_free(&state->index);
    arena_free(&state->keys);
    heap_free(state->modified);
    heap_free(state->entries);
    heap_free(state);
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

// Returns true if two keys have the same bits and strings (L11.2), which is stricter than ==.
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
    return key_equal(state_entry(owner, entry)->key, *(const Value *)key);
}

static StateSlot find_entry(const State *state, Value key, uint64_t hash) {
    uint32_t found = hash_index_find(&state->index, hash, entry_has_key, state, &key);
    return found == HASH_INDEX_NONE ? STATE_NO_SLOT : found;
}

static StateSlot find_in_key_ranges(const State *state, Value key) {
    StateSlot found = STATE_NO_SLOT;
    for (uint32_t i = 0; i < state->range_count && found == STATE_NO_SLOT; i++)
        found = key_range_find(&state->ranges[i], key);
    return found;
}

// Converts the last SLOTS entries to a range, unless one has a value, the keys are too long, or a key differs from that
// of the range. The last can happen if ids have fractions, because each only follows from the one before it.
static void begin_key_range(State *state) {
    enum { SLOTS = 2 * MAX_SEPARATE_PAIRS };
    const StateEntry *entries = state->entries + state->entry_count - SLOTS;
    state->candidate_pairs = 0;
    if (entries[1].key.len > STATE_KEY_BUFFER)
        return;
    StateSlot first = state->count - SLOTS;
    KeyRange range = {
        .first = first, .count = SLOTS, .prefix_len = entries[1].key.len - 2, .head = entries[1].key.as.numbers};
    for (uint32_t i = 0; i < SLOTS; i++)
        if (entries[i].value.len > 0 || key_range_find(&range, entries[i].key) != first + i)
            return;
    for (uint32_t i = 0; i < SLOTS; i++)
        hash_index_remove(&state->index, (uint64_t)entries[i].hash << 32, first + i);
    state->ranges[state->range_count++] = range;
    state->entry_count -= SLOTS;
    budget_release(state->budget, SLOTS * SLOT_BYTES);
}

// Converts the last entries to a range if enough consecutive pairs exist. Called after an entry was created.
static void detect_key_range(State *state) {
    const StateEntry *end = state->entries + state->entry_count;
    if (state->range_count == MAX_KEY_RANGES || state->entry_count < 4 || end[-1].key.kind != VALUE_NUMBERS ||
        end[-1].key.len != end[-2].key.len + 1)
        return;
    bool follow = key_range_follows(end[-4].key, end[-3].key, end[-2].key, end[-1].key);
    const KeyRange *last = state->range_count ? &state->ranges[state->range_count - 1] : NULL;
    if (last && last->first + last->count > state->count - 4)
        follow = false;
    state->candidate_pairs = follow ? state->candidate_pairs + 1 : 1;
    if (state->candidate_pairs == MAX_SEPARATE_PAIRS)
        begin_key_range(state);
}

static bool is_next_in_key_range(const State *state, Value key) {
    const KeyRange *last = state->range_count ? &state->ranges[state->range_count - 1] : NULL;
    return last && last->first + last->count == state->count && key_range_is_next(last, key);
}

// Reserves memory for `count` more entries. Returns false if out of memory.
static bool reserve_entries(State *state, uint32_t count) {
    if (!budget_reserve(state->budget, count * SLOT_BYTES))
        return set_exhausted(state);
    if (heap_reserve((void **)&state->entries, &state->capacity, state->entry_count + count - 1, sizeof(StateEntry)))
        return true;
    budget_release(state->budget, count * SLOT_BYTES);
    return set_exhausted(state);
}

StateSlot state_slot(State *state, Value key) {
    if (!state_key_valid(key))
        return STATE_NO_SLOT;
    StateSlot found = find_in_key_ranges(state, key);
    if (found != STATE_NO_SLOT)
        return found;
    uint64_t hash = key_hash(key);
    found = find_entry(state, key, hash);
    if (found != STATE_NO_SLOT)
        return found;
    if (is_next_in_key_range(state, key)) {
        state->ranges[state->range_count - 1].count++;
        return state->count++;
    }
    StateEntry entry = {.hash = (uint32_t)(hash >> 32)};
    if (!reserve_entries(state, 1))
        return STATE_NO_SLOT;
    if (!hash_index_add(&state->index, hash, state->count)) {
        budget_release(state->budget, SLOT_BYTES);
        return set_exhausted(state), STATE_NO_SLOT;
    }
    if (!state_copy_key(&state->keys, &entry.key, key)) {
        hash_index_remove(&state->index, hash, state->count);
        budget_release(state->budget, SLOT_BYTES);
        return set_exhausted(state), STATE_NO_SLOT;
    }
    state->entries[state->entry_count++] = entry;
    state->count++;
    detect_key_range(state);
    return state->count - 1;
}

StateSlot state_find(const State *state, Value key) {
    if (!state_key_valid(key))
        return STATE_NO_SLOT;
    StateSlot found = find_in_key_ranges(state, key);
    return found == STATE_NO_SLOT ? find_entry(state, key, key_hash(key)) : found;
}

bool state_slot_has_key(const State *state, StateSlot slot, Value key) {
    const KeyRange *range = state_key_range(state, slot);
    return range ? key_range_find(range, key) == slot
                 : slot < state->count && key_equal(state_entry(state, slot)->key, key);
}

// Converts a range to entries, in slot order. Returns false if out of memory.
static bool expand_key_range(State *state, KeyRange *gone) {
    KeyRange range = *gone;
    uint32_t at = (uint32_t)(state_entry(state, range.first) - state->entries), added = 0;
    if (state_slot_key(state, range.first + range.count - 1).len == 0 || !reserve_entries(state, range.count))
        return false;
    range = *gone;
    StateEntry *entries = state->entries + at;
    memmove(entries + range.count, entries, (state->entry_count - at) * sizeof *entries);
    for (; added < range.count; added++) {
        StateSlot slot = range.first + added;
        Value key = state_slot_key(state, slot), value = key_range_value(&range, slot);
        uint64_t hash = key_hash(key);
        if (!hash_index_add(&state->index, hash, slot))
            break;
        entries[added] = (StateEntry){key, value, (uint32_t)(hash >> 32), value.len ? range.owner : 0};
    }
    if (added < range.count) {
        while (added-- > 0)
            hash_index_remove(&state->index, (uint64_t)entries[added].hash << 32, range.first + added);
        memmove(entries, entries + range.count, (state->entry_count - at) * sizeof *entries);
        budget_release(state->budget, range.count * SLOT_BYTES);
        return set_exhausted(state);
    }
    memmove(gone, gone + 1, (size_t)(state->ranges + --state->range_count - gone) * sizeof *gone);
    state->entry_count += range.count;
    return true;
}

// If a slot is in a range, converts the range to entries. Returns false if out of memory.
static bool ensure_entry(State *state, StateSlot slot) {
    KeyRange *range = state_key_range(state, slot);
    return !range || expand_key_range(state, range);
}

// Replaces the value of an entry. The entry takes ownership of the new value.
static void replace_value(State *state, StateEntry *entry, Value owned) {
    if (entry->value.len != owned.len || entry->value.kind != VALUE_NUMBERS || owned.kind != VALUE_NUMBERS)
        state->digest.current = false;
    state->live += (owned.len > 0);
    state->live -= (entry->value.len > 0);
    if (entry->owner)
        state->modified[entry->owner - 1] = true;
    free_value(state, entry);
    entry->value = owned;
}

bool state_slot_set(State *state, StateSlot slot, Value value) {
    if (slot >= state->count)
        return slot != STATE_NO_SLOT;
    Value present = state_slot_get(state, slot);
    if (present.len == value.len && (value.len == 0 || value_equal(NULL, present, value)))
        return true; // an equal value does not change the stored bits
    if (!ensure_entry(state, slot))
        return false;
    StateEntry *entry = state_entry(state, slot);
    Value *stored = &entry->value;
    if (!entry->owner && value.kind == VALUE_NUMBERS && stored->kind == VALUE_NUMBERS && value.len == stored->len &&
        value.len > 0) {
        if (value.len == 1)
            *stored = value;
        else
            memcpy((void *)stored->as.numbers, value.as.numbers, value.len * sizeof(double));
        return true;
    }
    Value copy;
    if (!copy_value(state, &copy, value.len ? value : VALUE_NULL))
        return false;
    replace_value(state, entry, copy);
    return true;
}

StateOwner state_add_owner(State *state) {
    bool *larger = heap_resize(state->modified, (state->owner_count + 1) * sizeof *larger);
    if (!larger)
        return set_exhausted(state), 0;
    state->modified = larger;
    larger[state->owner_count] = false;
    return ++state->owner_count;
}

bool state_clear_modified(State *state, StateOwner owner) {
    bool modified = state->modified[owner - 1];
    state->modified[owner - 1] = false;
    return modified;
}

void state_slot_reference(State *state, StateSlot slot, StateOwner owner, const double *numbers, uint32_t len) {
    if (slot >= state->count)
        return;
    KeyRange *range = state_key_range(state, slot);
    uint32_t referenced = range ? range->referenced : 0;
    if (range && key_range_reference(range, slot, owner, numbers, len)) {
        state->live += range->referenced - referenced;
        state->digest.current &= range->referenced == referenced;
        return;
    }
    if (!ensure_entry(state, slot))
        return;
    StateEntry *entry = state_entry(state, slot);
    if (entry->owner == owner && entry->value.len == len) {
        entry->value.as.numbers = numbers;
        return;
    }
    replace_value(state, entry, value_numbers_view(numbers, len));
    entry->owner = owner;
}

bool state_slot_references(const State *state, StateSlot slot, StateOwner owner) {
    const KeyRange *range = state_key_range(state, slot);
    if (range)
        return owner && key_range_references(range, slot, owner);
    return owner && slot < state->count && state_entry(state, slot)->owner == owner;
}

bool state_slot_detach(State *state, StateSlot slot, StateOwner owner) {
    if (!state_slot_references(state, slot, owner))
        return true;
    if (!ensure_entry(state, slot)) { // the owner's numbers become invalid, so the range must not reference them
        KeyRange *range = state_key_range(state, slot);
        state->live -= range->referenced;
        range->referenced = range->stored = 0;
        state->digest.current = false;
        state->modified[owner - 1] = true;
        return false;
    }
    StateEntry *entry = state_entry(state, slot);
    Value copy;
    if (!copy_value(state, &copy, entry->value)) {
        replace_value(state, entry, VALUE_NULL);
        return false;
    }
    entry->value = copy;
    entry->owner = 0;
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

bool state_clear_exhausted(State *state) {
    bool was = state->exhausted;
    state->exhausted = false;
    return was;
}
