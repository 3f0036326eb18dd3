// far_sort.c: sorts the keys of a tree (far_field.h).
#include "physics/far_field.h"

#include <string.h>

enum { DIGIT_BITS = 11, KEY_DIGITS = 1 << DIGIT_BITS, KEY_BITS = 63, PASSES = 6, MAX_INSERTION = 24 };
_Static_assert(PASSES *DIGIT_BITS >= KEY_BITS, "the passes must cover a key");

static uint64_t key_part(const FarKey *key, bool low) {
    return low ? key->low : key->high;
}

static void insertion_sort(FarKey *keys, size_t count, bool low) {
    for (size_t i = 1; i < count; i++) {
        FarKey key = keys[i];
        size_t at = i;
        for (; at > 0 && key_part(&keys[at - 1], low) > key_part(&key, low); at--)
            keys[at] = keys[at - 1];
        keys[at] = key;
    }
}

// Moves the keys from `from` to `to`, sorted by one digit. `start` holds the number of keys of each digit.
static void scatter_keys(const FarKey *from, FarKey *to, size_t count, bool low, int shift, uint32_t *start) {
    uint32_t next = 0;
    for (size_t digit = 0; digit < KEY_DIGITS; digit++) {
        uint32_t number = start[digit];
        start[digit] = next;
        next += number;
    }
    for (size_t i = 0; i < count; i++)
        to[start[key_part(&from[i], low) >> shift & (KEY_DIGITS - 1)]++] = from[i];
}

// Sorts by one part of the keys, digit by digit from the least significant one. Skips digits that are equal in all
// keys.
static void radix_sort(FarKey *keys, FarKey *spare, size_t count, bool low) {
    uint32_t start[PASSES][KEY_DIGITS];
    memset(start, 0, sizeof start);
    for (size_t i = 0; i < count; i++)
        for (int pass = 0; pass < PASSES; pass++)
            start[pass][key_part(&keys[i], low) >> pass * DIGIT_BITS & (KEY_DIGITS - 1)]++;
    FarKey *from = keys, *to = spare;
    for (int pass = 0; pass < PASSES; pass++) {
        int shift = pass * DIGIT_BITS;
        if (start[pass][key_part(&from[0], low) >> shift & (KEY_DIGITS - 1)] == count)
            continue;
        scatter_keys(from, to, count, low, shift, start[pass]);
        FarKey *swap = from;
        from = to;
        to = swap;
    }
    if (from != keys)
        memcpy(keys, from, count * sizeof *keys);
}

static void sort_part(FarKey *keys, FarKey *spare, size_t count, bool low) {
    if (count > MAX_INSERTION)
        radix_sort(keys, spare, count, low);
    else
        insertion_sort(keys, count, low);
}

void phys_far_sort(FarKey *keys, FarKey *spare, size_t count) {
    sort_part(keys, spare, count, false);
    for (size_t first = 0, end; first < count; first = end) {
        for (end = first + 1; end < count && keys[end].high == keys[first].high; end++)
            continue;
        sort_part(keys + first, spare, end - first, true);
    }
}
