// state.c: see state.h.
#include "state/internal.h"

#include "base/arena.h"
#include "base/heap.h"
#include "base/number.h"
#include "base/table.h"
#include "maths/random.h"

#include <math.h>
#include <string.h>

State *state_new(Meter *meter) {
    State *state = heap_zeroed(1, sizeof(State));
    if (!state)
        return NULL;
    state->meter = meter;
    state_start_keys(&state->keys, meter);
    return state;
}

// A block for a value, within the budget.
static void *take(State *state, size_t bytes) {
    void *block = meter_take(state->meter, bytes) ? heap_take(bytes) : NULL;
    if (!block)
        state->exhausted = true;
    return block;
}

static bool exhausted(State *state) {
    state->exhausted = true;
    return false;
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
    for (uint32_t i = 0; i < state->entry_count; i++)
        disown(state, &state->entries[i]);
    meter_give(state->meter, state->entry_count * SLOT_BYTES);
    state->count = state->live = state->entry_count = state->series_count = state->row = 0;
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
    return key_equal(state_entry(owner, entry)->key, *(const Value *)key);
}

static StateSlot find(const State *state, Value key, uint64_t hash) {
    uint32_t found = index_find(&state->index, hash, entry_has_key, state, &key);
    return found == INDEX_NONE ? STATE_NO_SLOT : found;
}

static StateSlot find_in_series(const State *state, Value key) {
    StateSlot found = STATE_NO_SLOT;
    for (uint32_t i = 0; i < state->series_count && found == STATE_NO_SLOT; i++)
        found = series_find(&state->series[i], key);
    return found;
}

// Turns the entries at the end into a series, if they have no values.
static void begin_series(State *state) {
    enum { SLOTS = 2 * MOST_ALONE };
    const StateEntry *entries = state->entries + state->entry_count - SLOTS;
    state->row = 0;
    if (entries[1].key.len > STATE_KEY_ROOM)
        return;
    for (uint32_t i = 0; i < SLOTS; i++)
        if (entries[i].value.len > 0)
            return;
    StateSlot first = state->count - SLOTS;
    for (uint32_t i = 0; i < SLOTS; i++)
        index_remove(&state->index, (uint64_t)entries[i].hash << 32, first + i);
    state->series[state->series_count++] = (Series){
        .first = first, .count = SLOTS, .prefix_len = entries[1].key.len - 2, .head = entries[1].key.as.numbers};
    state->entry_count -= SLOTS;
    meter_give(state->meter, SLOTS * SLOT_BYTES);
}

// A slot with an entry was made: is there a row of pairs now that is worth a series?
static void look_for_series(State *state) {
    const StateEntry *end = state->entries + state->entry_count;
    if (state->series_count == MOST_SERIES || state->entry_count < 4 || end[-1].key.kind != VALUE_NUMBERS ||
        end[-1].key.len != end[-2].key.len + 1)
        return;
    bool follow = series_follow(end[-4].key, end[-3].key, end[-2].key, end[-1].key);
    const Series *last = state->series_count ? &state->series[state->series_count - 1] : NULL;
    if (last && last->first + last->count > state->count - 4)
        follow = false;
    state->row = follow ? state->row + 1 : 1;
    if (state->row == MOST_ALONE)
        begin_series(state);
}

static bool is_next(const State *state, Value key) {
    const Series *last = state->series_count ? &state->series[state->series_count - 1] : NULL;
    return last && last->first + last->count == state->count && series_is_next(last, key);
}

// Room for more entries. False if memory is used up.
static bool reserve_entries(State *state, uint32_t count) {
    if (!meter_take(state->meter, count * SLOT_BYTES))
        return exhausted(state);
    if (heap_reserve((void **)&state->entries, &state->capacity, state->entry_count + count - 1, sizeof(StateEntry)))
        return true;
    meter_give(state->meter, count * SLOT_BYTES);
    return exhausted(state);
}

StateSlot state_slot(State *state, Value key) {
    if (!state_key_valid(key))
        return STATE_NO_SLOT;
    StateSlot found = find_in_series(state, key);
    if (found != STATE_NO_SLOT)
        return found;
    uint64_t hash = key_hash(key);
    found = find(state, key, hash);
    if (found != STATE_NO_SLOT)
        return found;
    if (is_next(state, key)) {
        state->series[state->series_count - 1].count++;
        return state->count++;
    }
    StateEntry entry = {.hash = (uint32_t)(hash >> 32)};
    if (!reserve_entries(state, 1))
        return STATE_NO_SLOT;
    if (!index_add(&state->index, hash, state->count)) {
        meter_give(state->meter, SLOT_BYTES);
        return exhausted(state), STATE_NO_SLOT;
    }
    if (!state_own_key(&state->keys, &entry.key, key)) {
        index_remove(&state->index, hash, state->count);
        meter_give(state->meter, SLOT_BYTES);
        return exhausted(state), STATE_NO_SLOT;
    }
    state->entries[state->entry_count++] = entry;
    state->count++;
    look_for_series(state);
    return state->count - 1;
}

StateSlot state_find(const State *state, Value key) {
    if (!state_key_valid(key))
        return STATE_NO_SLOT;
    StateSlot found = find_in_series(state, key);
    return found == STATE_NO_SLOT ? find(state, key, key_hash(key)) : found;
}

typedef struct KeysCopy {
    Arena *arena;
    Series *series;
} KeysCopy;

static void write_keys(void *context) {
    KeysCopy *copy = context;
    Series *series = copy->series;
    uint32_t pairs = (series->count + 1) / 2, stride = series->prefix_len + 2;
    double *keys = arena_alloc(copy->arena, (size_t)pairs * stride * sizeof *keys);
    for (uint32_t i = 0; i < pairs; i++)
        series_write_key(series, i, keys + (size_t)i * stride);
    series->keys = keys;
    series->keys_count = pairs;
}

// The key of a slot in a series. Keys are written out when the first is asked for; null if there is no memory for them.
static Value series_key(State *state, Series *series, StateSlot slot) {
    uint32_t at = slot - series->first, stride = series->prefix_len + 2;
    Arena *arena = &state->keys;
    KeysCopy copy = {arena, series};
    if (at / 2 >= series->keys_count && arena_protect(&arena, 1, write_keys, &copy) != ARENA_DONE)
        return exhausted(state), VALUE_NULL;
    return (Value){.len = stride - 1 + at % 2, .as.numbers = series->keys + (size_t)(at / 2) * stride};
}

Value state_slot_get(const State *state, StateSlot slot) {
    const Series *series = state_series(state, slot);
    return series ? series_value(series, slot) : slot < state->count ? state_entry(state, slot)->value : VALUE_NULL;
}

Value state_slot_key(const State *state, StateSlot slot) {
    Series *series = state_series(state, slot);
    return series                ? series_key((State *)state, series, slot)
           : slot < state->count ? state_entry(state, slot)->key
                                 : VALUE_NULL;
}

Value state_slot_key_in(const State *state, StateSlot slot, double room[STATE_KEY_ROOM]) {
    const Series *series = state_series(state, slot);
    if (!series)
        return state_slot_key(state, slot);
    uint32_t at = slot - series->first;
    series_write_key(series, at / 2, room);
    return (Value){.len = series->prefix_len + 1 + at % 2, .as.numbers = room};
}

bool state_slot_has_key(const State *state, StateSlot slot, Value key) {
    const Series *series = state_series(state, slot);
    return series ? series_find(series, key) == slot
                  : slot < state->count && key_equal(state_entry(state, slot)->key, key);
}

const Value *state_slot_key_at(const State *state, StateSlot slot, Value *room) {
    if (!state_series(state, slot))
        return &state_entry(state, slot)->key;
    *room = state_slot_key(state, slot);
    return room;
}

const Value *state_slot_at(const State *state, StateSlot slot, Value *room) {
    const Series *series = state_series(state, slot);
    if (!series)
        return &state_entry(state, slot)->value;
    *room = series_value(series, slot);
    return room;
}

double state_slot_last_number(const State *state, StateSlot slot, uint32_t len) {
    const Series *series = state_series(state, slot);
    if (series)
        return series->prefix_len + 1 == len && (slot - series->first) % 2 == 0
                   ? series_id(series, (slot - series->first) / 2)
                   : NAN;
    Value key = state_slot_key(state, slot);
    Item last = key.len == len ? value_at(&key, len - 1) : (Item){.type = ITEM_STRING};
    return last.type == ITEM_NUMBER ? last.as.number : NAN;
}

// Makes entries of the slots of a series, behind those of the slots before. False if memory is used up.
static bool write_out(State *state, Series *gone) {
    Series series = *gone;
    uint32_t at = (uint32_t)(state_entry(state, series.first) - state->entries), added = 0;
    if (series_key(state, gone, series.first + series.count - 1).len == 0 || !reserve_entries(state, series.count))
        return false;
    series = *gone;
    StateEntry *entries = state->entries + at;
    memmove(entries + series.count, entries, (state->entry_count - at) * sizeof *entries);
    for (; added < series.count; added++) {
        StateSlot slot = series.first + added;
        Value key = series_key(state, gone, slot), value = series_value(&series, slot);
        uint64_t hash = key_hash(key);
        if (!index_add(&state->index, hash, slot))
            break;
        entries[added] = (StateEntry){key, value, (uint32_t)(hash >> 32), value.len ? series.lender : 0};
    }
    if (added < series.count) {
        while (added-- > 0)
            index_remove(&state->index, (uint64_t)entries[added].hash << 32, series.first + added);
        memmove(entries, entries + series.count, (state->entry_count - at) * sizeof *entries);
        meter_give(state->meter, series.count * SLOT_BYTES);
        return exhausted(state);
    }
    memmove(gone, gone + 1, (size_t)(state->series + --state->series_count - gone) * sizeof *gone);
    state->entry_count += series.count;
    return true;
}

// The same for the series of a slot, if it is in one.
static bool alone(State *state, StateSlot slot) {
    Series *series = state_series(state, slot);
    return !series || write_out(state, series);
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
    Value present = state_slot_get(state, slot);
    if (present.len == value.len && (value.len == 0 || value_equal(NULL, present, value)))
        return true; // equal values leave the stored bits alone
    if (!alone(state, slot))
        return false;
    StateEntry *entry = state_entry(state, slot);
    Value *stored = &entry->value;
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
    Series *series = state_series(state, slot);
    uint32_t lent = series ? series->lent : 0;
    if (series && series_borrow(series, slot, lender, numbers, len)) {
        state->live += series->lent - lent;
        return;
    }
    if (!alone(state, slot))
        return;
    StateEntry *entry = state_entry(state, slot);
    if (entry->lender == lender && entry->value.len == len) {
        entry->value.as.numbers = numbers;
        return;
    }
    replace(state, entry, value_numbers_view(numbers, len));
    entry->lender = lender;
}

bool state_slot_borrows(const State *state, StateSlot slot, StateLender lender) {
    const Series *series = state_series(state, slot);
    if (series)
        return lender && series_borrows(series, slot, lender);
    return lender && slot < state->count && state_entry(state, slot)->lender == lender;
}

bool state_slot_own_copy(State *state, StateSlot slot, StateLender lender) {
    if (!state_slot_borrows(state, slot, lender))
        return true;
    if (!alone(state, slot)) { // the series cannot keep what its lender is about to take away
        Series *series = state_series(state, slot);
        state->live -= series->lent;
        series->lent = series->fresh = 0;
        state->disturbed[lender - 1] = true;
        return false;
    }
    StateEntry *entry = state_entry(state, slot);
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

bool state_next(const State *state, uint32_t *cursor, Value *key, Value *value, double room[STATE_KEY_ROOM]) {
    while (*cursor < state->count) {
        StateSlot slot = (*cursor)++;
        *value = state_slot_get(state, slot);
        if (value->len > 0) {
            *key = state_slot_key_in(state, slot, room);
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
