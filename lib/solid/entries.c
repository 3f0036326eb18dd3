// entries.c: see entries.h. Counting sort by bucket; buckets are usually small.
#include "solid/entries.h"

#include <stdlib.h>
#include <string.h>

static int compare_entries(const void *a, const void *b) {
    const Entry *one = a, *two = b;
    if (one->key != two->key)
        return one->key < two->key ? -1 : 1;
    return one->value < two->value ? -1 : one->value > two->value;
}

static void sort_bucket(Entry *entries, uint32_t count) {
    enum { SMALL = 16 };
    if (count > SMALL) {
        qsort(entries, count, sizeof *entries, compare_entries);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        Entry entry = entries[i];
        uint32_t at = i;
        for (; at > 0 && compare_entries(&entries[at - 1], &entry) > 0; at--)
            entries[at] = entries[at - 1];
        entries[at] = entry;
    }
}

uint32_t *entries_sort(Arena *arena, Entry *entries, uint32_t count, uint32_t bucket_count) {
    uint32_t *starts = arena_alloc_array(arena, (size_t)bucket_count + 2, sizeof *starts);
    memset(starts, 0, ((size_t)bucket_count + 2) * sizeof *starts);
    for (uint32_t i = 0; i < count; i++)
        starts[entries[i].bucket + 2]++;
    for (uint32_t i = 2; i < bucket_count + 2; i++)
        starts[i] += starts[i - 1];
    ArenaMark mark = arena_mark(arena);
    Entry *copy = arena_alloc_array(arena, count, sizeof *copy);
    if (count > 0)
        memcpy(copy, entries, count * sizeof *copy);
    for (uint32_t i = 0; i < count; i++)
        entries[starts[copy[i].bucket + 1]++] = copy[i];
    arena_rewind(arena, mark);
    for (uint32_t i = 0; i < bucket_count; i++)
        sort_bucket(entries + starts[i], starts[i + 1] - starts[i]);
    return starts;
}
