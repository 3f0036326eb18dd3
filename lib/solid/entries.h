// entries.h: sorting of records by small integers.
#pragma once

#include "base/arena.h"

typedef struct Entry {
    uint64_t key;
    uint32_t bucket;
    uint32_t value;
} Entry;

// Sorts by bucket, then key, then value. Returns an array of bucket_count + 1 numbers: the entries of bucket i are
// those from starts[i] to starts[i + 1] - 1.
uint32_t *entries_sort(Arena *arena, Entry *entries, uint32_t count, uint32_t bucket_count);
