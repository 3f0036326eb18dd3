// hash_index.c: see hash_index.h. Open addressing with linear probing; at most 3/4 full.
#include "base/hash_index.h"

#include "base/heap.h"

#ifdef PETRI_STRESS
enum { MIN_SLOTS = 2 };
#else
enum { MIN_SLOTS = 16 };
#endif
static const uint32_t INDEX_DELETED = 0xffffffff;

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

void hash_index_free(HashIndex *index) {
    heap_free(index->slots);
    *index = (HashIndex){0};
}

void hash_index_clear(HashIndex *index) {
    for (uint32_t i = 0; index->slots && i <= index->mask; i++)
        index->slots[i] = (HashIndexSlot){0};
    index->used = index->live = 0;
}

// Returns the first slot to probe. It depends only on the upper half of the hash, which the slots store, so that the
// table can be resized without the keys.
static uint32_t probe_start(uint32_t upper, uint32_t mask) {
    return (uint32_t)hash_mix(upper) & mask;
}

uint32_t hash_index_find(const HashIndex *index, uint64_t hash, HashIndexMatch *match, const void *owner,
                         const void *key) {
    if (!index->slots)
        return HASH_INDEX_NONE;
    uint32_t upper = (uint32_t)(hash >> 32);
    for (uint32_t i = probe_start(upper, index->mask);; i = (i + 1) & index->mask) {
        HashIndexSlot slot = index->slots[i];
        if (!slot.entry)
            return HASH_INDEX_NONE;
        if (slot.hash == upper && slot.entry != INDEX_DELETED && match(owner, slot.entry - 1, key))
            return slot.entry - 1;
    }
}

static bool index_resize(HashIndex *index, uint32_t count) {
    HashIndexSlot *slots = heap_calloc(count, sizeof *slots);
    if (!slots)
        return false;
    for (uint32_t i = 0; index->slots && i <= index->mask; i++) {
        HashIndexSlot slot = index->slots[i];
        if (!slot.entry || slot.entry == INDEX_DELETED)
            continue;
        uint32_t at = probe_start(slot.hash, count - 1);
        while (slots[at].entry)
            at = (at + 1) & (count - 1);
        slots[at] = slot;
    }
    heap_free(index->slots);
    index->slots = slots;
    index->mask = count - 1;
    index->used = index->live;
    return true;
}

bool hash_index_add(HashIndex *index, uint64_t hash, uint32_t entry) {
    uint32_t count = index->slots ? index->mask + 1 : 0;
    if (index->used + 1 > count / 4 * 3) {
        uint32_t wanted = index->live + 1 > count / 2 ? (count ? count * 2 : MIN_SLOTS) : count;
        if (!index_resize(index, wanted < 4 ? 4 : wanted))
            return false;
    }
    uint32_t upper = (uint32_t)(hash >> 32);
    uint32_t at = probe_start(upper, index->mask);
    while (index->slots[at].entry && index->slots[at].entry != INDEX_DELETED)
        at = (at + 1) & index->mask;
    index->used += index->slots[at].entry == 0;
    index->live++;
    index->slots[at] = (HashIndexSlot){upper, entry + 1};
    return true;
}

void hash_index_remove(HashIndex *index, uint64_t hash, uint32_t entry) {
    uint32_t at = probe_start((uint32_t)(hash >> 32), index->mask);
    while (index->slots[at].entry != entry + 1)
        at = (at + 1) & index->mask;
    index->slots[at].entry = INDEX_DELETED;
    index->live--;
}
