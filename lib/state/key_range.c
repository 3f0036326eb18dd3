// key_range.c: see key_range.h.
//
// In each frame, the owner refers to the slots in order. Until it has reached a slot, the slot's value remains in the
// previous array, which is why the owner keeps that array readable.
#include "state/key_range.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

static bool same_bits(double x, double y) {
    return number_bits(x) == number_bits(y);
}

double key_range_id(const KeyRange *range, uint32_t pair) {
    return number_counted(range->head[range->prefix_len], pair);
}

void key_range_write_key(const KeyRange *range, uint32_t pair, double *to) {
    memcpy(to, range->head, (range->prefix_len + 2) * sizeof *to);
    to[range->prefix_len] = key_range_id(range, pair);
}

static bool begins_with(const double *numbers, const double *prefix, uint32_t len) {
    uint32_t i = 0; // a loop is faster than memcmp for short prefixes
    while (i < len && same_bits(numbers[i], prefix[i]))
        i++;
    return i == len;
}

// Returns true if a key has the range's prefix and a valid length. The key of a second slot must also end with the
// range's symbol.
static bool has_range_form(const KeyRange *range, Value key) {
    uint32_t n = range->prefix_len;
    return key.kind == VALUE_NUMBERS && (key.len == n + 1 || key.len == n + 2) &&
           begins_with(key.as.numbers, range->head, n) &&
           (key.len == n + 1 || same_bits(key.as.numbers[n + 1], range->head[n + 1]));
}

// Returns the only pair that can have this id, or UINT32_MAX if none can. The difference of two ids is rounded to the
// nearest number of pairs, because it is inexact if they have fractions: 4.1 - 0.1 is less than 4.
static uint32_t pair_of(const KeyRange *range, double id) {
    double pair = floor(id - range->head[range->prefix_len] + 0.5);
    if (!(pair >= 0 && pair < UINT32_MAX) || !same_bits(key_range_id(range, (uint32_t)pair), id))
        return UINT32_MAX;
    return (uint32_t)pair;
}

StateSlot key_range_find(const KeyRange *range, Value key) {
    if (!has_range_form(range, key))
        return STATE_NO_SLOT;
    uint32_t pair = pair_of(range, key.as.numbers[range->prefix_len]);
    if (pair > range->count / 2)
        return STATE_NO_SLOT;
    uint32_t at = 2 * pair + (key.len > range->prefix_len + 1);
    return at < range->count ? range->first + at : STATE_NO_SLOT;
}

bool key_range_is_next(const KeyRange *range, Value key) {
    return has_range_form(range, key) && key.len == range->prefix_len + 1 + range->count % 2 &&
           pair_of(range, key.as.numbers[range->prefix_len]) == range->count / 2;
}

bool key_range_follows(Value position, Value velocity, Value next_position, Value next_velocity) {
    if (velocity.kind != VALUE_NUMBERS || velocity.len < 3 || position.len != velocity.len - 1 ||
        position.kind != VALUE_NUMBERS || !begins_with(position.as.numbers, velocity.as.numbers, position.len))
        return false;
    KeyRange range = {.count = 2, .prefix_len = velocity.len - 2, .head = velocity.as.numbers};
    if (!key_range_is_next(&range, next_position))
        return false;
    range.count++;
    return key_range_is_next(&range, next_velocity);
}

Value key_range_value(const KeyRange *range, StateSlot slot) {
    uint32_t at = slot - range->first;
    if (at >= range->referenced)
        return VALUE_NULL;
    const double *numbers = at < range->stored ? range->numbers : range->previous;
    return (Value){.len = range->len, .as.numbers = numbers + (size_t)at * range->len};
}

bool key_range_reference(KeyRange *range, StateSlot slot, StateOwner owner, const double *numbers, uint32_t len) {
    uint32_t at = slot - range->first;
    if (at == 0 && (range->referenced == 0 ||
                    (range->stored >= range->referenced && range->owner == owner && range->len == len))) {
        range->previous = range->numbers;
        range->numbers = numbers;
        range->owner = owner;
        range->len = len;
        range->stored = 0;
    }
    if (at != range->stored || range->owner != owner || range->len != len ||
        numbers != range->numbers + (size_t)at * len)
        return key_range_references(range, slot, owner) && range->len == len &&
               numbers == key_range_value(range, slot).as.numbers;
    range->stored++;
    if (range->referenced < range->stored)
        range->referenced = range->stored;
    return true;
}
