// table.c: see table.h. Open addressing with linear probing; at most 3/4 full.
#include "base/table.h"

#include "base/heap.h"

#ifdef PETRI_STRESS
enum { FIRST_SLOTS = 2 };
#else
enum { FIRST_SLOTS = 16 };
#endif
static const uint32_t DELETED = 0xffffffff;

uint64_t hash_mix(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

uint64_t hash_bytes(uint64_t seed, const void *bytes, size_t len) {
    uint64_t hash = seed ^ 0xcbf29ce484222325u;
    for (size_t i = 0; i < len; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
    return hash_mix(hash);
}

void index_free(Index *index) {
    heap_give(index->slots);
    *index = (Index){0};
}

void index_clear(Index *index) {
    for (uint32_t i = 0; index->slots && i <= index->mask; i++)
        index->slots[i] = (IndexSlot){0};
    index->used = index->live = 0;
}

// Only the upper half of a hash is stored; the probe starts from it alone, so that growing needs nothing else.
static uint32_t probe_start(uint32_t upper, uint32_t mask) {
    return (uint32_t)hash_mix(upper) & mask;
}

uint32_t index_find(const Index *index, uint64_t hash, IndexMatch *match, const void *owner, const void *key) {
    if (!index->slots)
        return INDEX_NONE;
    uint32_t upper = (uint32_t)(hash >> 32);
    for (uint32_t i = probe_start(upper, index->mask);; i = (i + 1) & index->mask) {
        IndexSlot slot = index->slots[i];
        if (!slot.entry)
            return INDEX_NONE;
        if (slot.hash == upper && slot.entry != DELETED && match(owner, slot.entry - 1, key))
            return slot.entry - 1;
    }
}

static bool index_resize(Index *index, uint32_t count) {
    IndexSlot *slots = heap_zeroed(count, sizeof *slots);
    if (!slots)
        return false;
    for (uint32_t i = 0; index->slots && i <= index->mask; i++) {
        IndexSlot slot = index->slots[i];
        if (!slot.entry || slot.entry == DELETED)
            continue;
        uint32_t at = probe_start(slot.hash, count - 1);
        while (slots[at].entry)
            at = (at + 1) & (count - 1);
        slots[at] = slot;
    }
    heap_give(index->slots);
    index->slots = slots;
    index->mask = count - 1;
    index->used = index->live;
    return true;
}

bool index_add(Index *index, uint64_t hash, uint32_t entry) {
    uint32_t count = index->slots ? index->mask + 1 : 0;
    if (index->used + 1 > count / 4 * 3) {
        uint32_t wanted = index->live + 1 > count / 2 ? (count ? count * 2 : FIRST_SLOTS) : count;
        if (!index_resize(index, wanted < 4 ? 4 : wanted))
            return false;
    }
    uint32_t upper = (uint32_t)(hash >> 32);
    uint32_t at = probe_start(upper, index->mask);
    while (index->slots[at].entry && index->slots[at].entry != DELETED)
        at = (at + 1) & index->mask;
    index->used += index->slots[at].entry == 0;
    index->live++;
    index->slots[at] = (IndexSlot){upper, entry + 1};
    return true;
}

void index_remove(Index *index, uint64_t hash, uint32_t entry) {
    uint32_t at = probe_start((uint32_t)(hash >> 32), index->mask);
    while (index->slots[at].entry != entry + 1)
        at = (at + 1) & index->mask;
    index->slots[at].entry = DELETED;
    index->live--;
}
