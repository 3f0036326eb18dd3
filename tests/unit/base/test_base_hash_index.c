// test_base_hash_index.c: the hash index, compared with a simple model.
#include "base/hash_index.h"
#include "check.h"

#include <stdlib.h>

enum { KEYS = 3000 };

// Entries are numbers. With `weak` hashes, many entries share a probe sequence.
typedef struct Owner {
    HashIndex index;
    uint32_t entries[KEYS];
    bool weak;
} Owner;

static bool same_key(const void *owner, uint32_t entry, const void *key) {
    return ((const Owner *)owner)->entries[entry] == *(const uint32_t *)key;
}

static uint64_t hash_of(const Owner *owner, uint32_t key) {
    return owner->weak ? (uint64_t)(key % 3) << 32 : hash_mix(key + UINT64_C(1));
}

static uint32_t find_key(const Owner *owner, uint32_t key) {
    return hash_index_find(&owner->index, hash_of(owner, key), same_key, owner, &key);
}

static void add_key(Owner *owner, uint32_t entry, uint32_t key) {
    owner->entries[entry] = key;
    assert_true(hash_index_add(&owner->index, hash_of(owner, key), entry));
}

static void test_empty_index_finds_nothing(void **state) {
    (void)state;
    Owner owner = {0};
    assert_true(find_key(&owner, 1) == HASH_INDEX_NONE);
    hash_index_clear(&owner.index);
    hash_index_free(&owner.index);
    assert_null(owner.index.slots);
}

static void add_and_find(bool weak, uint32_t count) {
    Owner owner = {.weak = weak};
    for (uint32_t i = 0; i < count; i++) {
        assert_true(find_key(&owner, i * 7) == HASH_INDEX_NONE);
        add_key(&owner, i, i * 7);
        assert_int_equal(owner.index.live, i + 1);
    }
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(find_key(&owner, i * 7), i);
        assert_true(find_key(&owner, i * 7 + 1) == HASH_INDEX_NONE);
    }
    hash_index_clear(&owner.index);
    assert_int_equal(owner.index.live, 0);
    for (uint32_t i = 0; i < count; i++)
        assert_true(find_key(&owner, i * 7) == HASH_INDEX_NONE);
    add_key(&owner, 0, 5);
    assert_int_equal(find_key(&owner, 5), 0);
    hash_index_free(&owner.index);
}

static void test_added_keys_are_found(void **state) {
    (void)state;
    add_and_find(false, KEYS);
    add_and_find(true, 300);
}

// Random additions, removals and moves. After each change, every key has the same position as in the model.
static void add_and_remove_keys(bool weak, uint32_t keys, int rounds) {
    const uint32_t nowhere = UINT32_MAX;
    Owner owner = {.weak = weak};
    uint32_t place[KEYS], live = 0;
    uint64_t seed = 42;
    for (uint32_t k = 0; k < keys; k++)
        place[k] = nowhere;
    for (int round = 0; round < rounds; round++) {
        uint32_t key = (uint32_t)(next_bits(&seed) % keys);
        if (place[key] == nowhere) {
            place[key] = live;
            add_key(&owner, live++, key);
        } else {
            // Removes an entry and moves the last entry to its position, like a caller that stores its entries in a
            // dense array.
            uint32_t hole = place[key], last = --live, moved = owner.entries[last];
            hash_index_remove(&owner.index, hash_of(&owner, key), hole);
            place[key] = nowhere;
            if (hole != last) {
                hash_index_remove(&owner.index, hash_of(&owner, moved), last);
                assert_true(hash_index_add(&owner.index, hash_of(&owner, moved), hole));
                owner.entries[hole] = moved;
                place[moved] = hole;
            }
        }
        assert_int_equal(owner.index.live, live);
        assert_true(owner.index.used >= live && owner.index.used <= owner.index.mask);
        for (uint32_t k = 0; k < keys; k += round % 50 ? 41 : 1)
            assert_int_equal(find_key(&owner, k), place[k] == nowhere ? HASH_INDEX_NONE : place[k]);
    }
    hash_index_free(&owner.index);
}

static void test_index_matches_model(void **state) {
    (void)state;
    add_and_remove_keys(false, 500, 20000);
    add_and_remove_keys(true, 60, 5000);
}

// Repeated removals and additions do not make the table grow.
static void test_deleted_slots_are_reclaimed(void **state) {
    (void)state;
    Owner owner = {0};
    for (uint32_t i = 0; i < 100000; i++) {
        add_key(&owner, 0, i);
        hash_index_remove(&owner.index, hash_of(&owner, i), 0);
    }
    assert_int_equal(owner.index.live, 0);
    assert_true(owner.index.mask < 64);
    hash_index_free(&owner.index);
}

static void test_hash_has_known_values(void **state) {
    (void)state;
    assert_true(hash_bytes(0, "ab", 2) != hash_bytes(0, "ba", 2));
    assert_true(hash_bytes(0, "ab", 2) != hash_bytes(1, "ab", 2));
    assert_true(hash_bytes(0, "a\0", 2) != hash_bytes(0, "a", 1));
    assert_true(hash_bytes(0, NULL, 0) == hash_bytes(0, "x", 0));
    assert_true(hash_mix(1) == UINT64_C(0x5692161d100b05e5)); // expected value from the finaliser of SplitMix64
}

TEST_GROUP(base_hash_index) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty_index_finds_nothing), cmocka_unit_test(test_added_keys_are_found),
        cmocka_unit_test(test_index_matches_model),       cmocka_unit_test(test_deleted_slots_are_reclaimed),
        cmocka_unit_test(test_hash_has_known_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
