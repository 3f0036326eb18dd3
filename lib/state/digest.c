// digest.c: see digest.h and spec digest.md.
//
// The numbers of all values, in the canonical order of their keys, are divided into chunks of CHUNK_NUMBERS. The digest
// is a hash of the shape and of the chunks' hashes, so it does not depend on the number of parts or threads.
#include "base/cpu.h"
#include "base/heap.h"
#include "base/number.h"
#include "state/digest_hash.h"
#include "state/internal.h"

#include <string.h>

enum {
    LITTLE_ENDIAN_HOST = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
    VERSION = 1,
    CHUNK_NUMBERS = 4096,
    BUFFER_WORDS = 128,
    MIN_DIRECT = 64, // at least this many consecutive numbers are hashed without being copied to the buffer
};
#define STRING_MARK UINT64_MAX          // replaces the bits of a number; they are those of a NaN
#define MIXED_VALUE (UINT64_C(1) << 63) // added to the length of a value that has strings

// A hash of 64-bit words.
typedef struct WordHash {
    XXH3_state_t hash;
    DigestUpdate *update;
    uint32_t fill;
    uint64_t buffer[BUFFER_WORDS];
} WordHash;

static DigestUpdate *fastest_update(void) {
#ifdef DIGEST_AVX2
    if (cpu_detected.level >= CPU_AVX2)
        return digest_update_avx2;
#endif
    return digest_update_plain;
}

static void hash_begin(WordHash *hash) {
    hash->update = fastest_update();
    hash->fill = 0;
    XXH3_128bits_reset(&hash->hash);
}

static void hash_flush(WordHash *hash) {
    hash->update(&hash->hash, hash->buffer, hash->fill * sizeof *hash->buffer);
    hash->fill = 0;
}

static void hash_end(WordHash *hash, uint8_t digest[STATE_DIGEST_SIZE]) {
    hash_flush(hash);
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(&hash->hash));
    memcpy(digest, canonical.digest, STATE_DIGEST_SIZE);
}

static void add_bytes(WordHash *hash, const void *bytes, size_t size) {
    hash_flush(hash);
    hash->update(&hash->hash, bytes, size);
}

// Adds a word in little-endian byte order.
static inline void add_word(WordHash *hash, uint64_t word) {
    if (hash->fill == BUFFER_WORDS)
        hash_flush(hash);
    hash->buffer[hash->fill++] = LITTLE_ENDIAN_HOST ? word : __builtin_bswap64(word);
}

static void add_numbers(WordHash *hash, const double *numbers, size_t count) {
    if (count >= MIN_DIRECT && LITTLE_ENDIAN_HOST)
        add_bytes(hash, numbers, count * sizeof *numbers);
    else
        for (size_t i = 0; i < count; i++)
            add_word(hash, number_bits(numbers[i]));
}

// --- the shape: keys, and lengths and strings of values

static void add_string(WordHash *hash, Str text) {
    static const char padding[sizeof(uint64_t)];
    add_word(hash, STRING_MARK);
    add_word(hash, text.len);
    add_bytes(hash, text.bytes, text.len);
    add_bytes(hash, padding, -text.len % sizeof padding);
}

static void add_key(WordHash *hash, Value key) {
    add_word(hash, key.len);
    for (uint32_t i = 0; i < key.len; i++) {
        Item item = value_at(&key, i);
        if (item.type == ITEM_STRING)
            add_string(hash, item.as.string->text);
        else
            add_word(hash, number_bits(item.as.number));
    }
}

// Adds the length of a value, and its strings. Returns how many numbers it contains.
static uint32_t add_value_shape(WordHash *hash, Value value) {
    if (value.kind == VALUE_NUMBERS) {
        add_word(hash, value.len);
        return value.len;
    }
    uint32_t numbers = 0;
    add_word(hash, MIXED_VALUE + value.len);
    for (uint32_t i = 0; i < value.len; i++)
        if (value.as.items[i].type == ITEM_STRING) {
            add_string(hash, value.as.items[i].as.string->text);
        } else {
            add_word(hash, 0);
            numbers++;
        }
    return numbers;
}

// Adds the chunks that begin in a value of `count` numbers.
static bool add_chunks(State *state, uint32_t run, StateSlot slot, uint32_t count) {
    Digest *digest = &state->digest;
    uint64_t begin = (uint64_t)digest->chunk_count * CHUNK_NUMBERS;
    for (; begin < digest->numbers + count; begin += CHUNK_NUMBERS) {
        if (!state_grow(state, (void **)&digest->chunks, &digest->chunk_capacity, digest->chunk_count,
                        sizeof *digest->chunks))
            return false;
        digest->chunks[digest->chunk_count++] =
            (DigestChunk){.run = run, .slot = slot, .number = (uint32_t)(begin - digest->numbers)};
    }
    digest->numbers += count;
    return true;
}

static bool update_shape(State *state) {
    Digest *digest = &state->digest;
    WordHash hash;
    double buffer[STATE_KEY_BUFFER];
    hash_begin(&hash);
    digest->numbers = digest->chunk_count = 0;
    for (uint32_t run = 0; run < digest->order.count; run++) {
        SlotRun slots = digest->order.items[run];
        for (StateSlot slot = slots.first; slot < slots.first + slots.count; slot++) {
            Value value = state_slot_get(state, slot);
            if (value.len == 0)
                continue;
            add_key(&hash, state_slot_key_in(state, slot, buffer));
            if (!add_chunks(state, run, slot, add_value_shape(&hash, value)))
                return false;
        }
    }
    hash_end(&hash, digest->shape);
    digest->current = true;
    return true;
}

bool state_digest_is_stale(const State *state) {
    return !state->digest.current || state->digest.ordered < state->count;
}

bool state_digest_begin(State *state, uint64_t *numbers) {
    bool done = state_update_order(state) && (state->digest.current || update_shape(state));
    *numbers = state->digest.numbers;
    return done;
}

// --- the numbers of the values

// The hash of a chunk, while numbers are added.
typedef struct ChunkHash {
    WordHash hash;
    size_t missing; // number of numbers that are still to be added
} ChunkHash;

static void add_to_chunk(ChunkHash *chunk, const double *numbers, size_t count) {
    size_t added = count < chunk->missing ? count : chunk->missing;
    add_numbers(&chunk->hash, numbers, added);
    chunk->missing -= added;
}

// Adds the numbers of a value, except the first `skipped` ones.
static void add_value(ChunkHash *chunk, const Value *value, uint32_t skipped) {
    if (value->kind == VALUE_NUMBERS) {
        if (value->len)
            add_to_chunk(chunk, value_numbers(value) + skipped, value->len - skipped);
        return;
    }
    for (uint32_t i = 0; i < value->len; i++)
        if (value->as.items[i].type == ITEM_NUMBER) {
            if (skipped == 0)
                add_to_chunk(chunk, &value->as.items[i].as.number, 1);
            else
                skipped--;
        }
}

// Adds the values of slots `slot` to end - 1 of a range. The values are in at most two arrays.
static void add_range(ChunkHash *chunk, const KeyRange *range, StateSlot slot, StateSlot end, uint32_t skipped) {
    while (slot < end && slot - range->first < range->referenced) {
        uint32_t at = slot - range->first, stop = end - range->first;
        uint32_t array_end = at < range->stored ? range->stored : range->referenced;
        stop = stop < array_end ? stop : array_end;
        Value first = key_range_value(range, slot);
        add_to_chunk(chunk, first.as.numbers + skipped, (size_t)(stop - at) * range->len - skipped);
        slot = range->first + stop;
        skipped = 0;
    }
}

// Adds the values of at most `count` consecutive entries, and returns how many it has added. Values that an owner has
// stored one after the other are hashed without being copied.
static uint32_t add_entries(ChunkHash *chunk, const StateEntry *entry, uint32_t count, uint32_t skipped) {
    uint32_t len = entry->value.len, added = 1;
    if (entry->owner == 0 || len < 2) {
        add_value(chunk, &entry->value, skipped);
        return added;
    }
    const double *numbers = entry->value.as.numbers;
    size_t used = len;
    for (; added < count && used - skipped < chunk->missing; added++, used += len)
        if (entry[added].owner != entry->owner || entry[added].value.len != len ||
            entry[added].value.as.numbers != numbers + used)
            break;
    add_to_chunk(chunk, numbers + skipped, used - skipped);
    return added;
}

// Returns the number of slots from `slot` to end - 1 before the next key range.
static uint32_t entries_before_range(const State *state, StateSlot slot, StateSlot end) {
    for (uint32_t i = 0; i < state->range_count; i++)
        if (state->ranges[i].first > slot && state->ranges[i].first < end)
            return state->ranges[i].first - slot;
    return end - slot;
}

// Adds the values of slots `slot` to end - 1 until the chunk is complete.
static void add_slots(ChunkHash *chunk, const State *state, StateSlot slot, StateSlot end, uint32_t skipped) {
    while (slot < end && chunk->missing) {
        const KeyRange *range = state_key_range(state, slot);
        StateSlot stop = end;
        if (range) {
            stop = range->first + range->count < end ? range->first + range->count : end;
            add_range(chunk, range, slot, stop, skipped);
        } else {
            stop = slot + add_entries(chunk, state_entry(state, slot), entries_before_range(state, slot, end), skipped);
        }
        slot = stop;
        skipped = 0;
    }
}

static void hash_chunk(State *state, uint32_t number) {
    const Digest *digest = &state->digest;
    DigestChunk *begin = &digest->chunks[number];
    uint64_t rest = digest->numbers - (uint64_t)number * CHUNK_NUMBERS;
    ChunkHash chunk;
    hash_begin(&chunk.hash);
    chunk.missing = rest < CHUNK_NUMBERS ? (size_t)rest : CHUNK_NUMBERS;
    const SlotRun *run = &digest->order.items[begin->run];
    add_slots(&chunk, state, begin->slot, run->first + run->count, begin->number);
    for (run++; chunk.missing; run++)
        add_slots(&chunk, state, run->first, run->first + run->count, 0);
    hash_end(&chunk.hash, begin->digest);
}

void state_digest_part(State *state, int part, int parts) {
    uint64_t count = state->digest.chunk_count;
    uint64_t end = count * ((unsigned)part + 1) / (unsigned)parts;
    for (uint64_t i = count * (unsigned)part / (unsigned)parts; i < end; i++)
        hash_chunk(state, (uint32_t)i);
}

void state_digest_end(const State *state, uint8_t digest[STATE_DIGEST_SIZE]) {
    WordHash hash;
    hash_begin(&hash);
    add_word(&hash, VERSION);
    add_word(&hash, state_count(state));
    add_word(&hash, state->digest.numbers);
    add_bytes(&hash, state->digest.shape, STATE_DIGEST_SIZE);
    for (uint32_t i = 0; i < state->digest.chunk_count; i++)
        add_bytes(&hash, state->digest.chunks[i].digest, STATE_DIGEST_SIZE);
    hash_end(&hash, digest);
}

void state_free_digest(State *state) {
    Digest *digest = &state->digest;
    budget_release(state->budget, digest->order.capacity * sizeof *digest->order.items +
                                      digest->chunk_capacity * sizeof *digest->chunks);
    heap_free(digest->order.items);
    heap_free(digest->chunks);
    *digest = (Digest){0};
}
