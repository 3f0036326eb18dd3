// test_base_sha256.c: SHA-256, compared with the examples of the standard and, near block boundaries, with
// sha256sum(1).
#include "base/cpu.h"
#include "base/sha256.h"
#include "base/sha256_blocks.h"
#include "check.h"

// Returns the hash of `count` copies of the string, added in chunks of `piece` bytes.
static const char *hashed(const char *text, size_t count, size_t piece) {
    static char digits[SHA256_DIGITS + 1];
    static char whole[1000001];
    size_t length = strlen(text) * count;
    assert_true(length < sizeof whole);
    for (size_t i = 0; i < count; i++)
        memcpy(whole + i * strlen(text), text, strlen(text));
    Sha256 hash = sha256_new();
    for (size_t at = 0; at < length; at += piece)
        sha256_add(&hash, whole + at, length - at < piece ? length - at : piece);
    sha256_end(&hash, digits);
    return digits;
}

static const struct {
    const char *text;
    size_t count;
    const char *hash;
} rows[] = {
    {"", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
    {"abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
    {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1,
     "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
    {"a", 1000000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
    {"\xff", 55, "aadaed00a3c5fbb8072ae7f1984ba8199fbe5272de427d11eaf31583af37db51"},
    {"\xff", 56, "528ff50ab05e77bbbd224a9ec86165dbb6824a9a9efb544be0a1d57d5b416457"},
    {"\xff", 57, "6eaa0abf8d7eda3e157692f5191a59bc08196ac193f6ac3bdde2af54214f2240"},
    {"\xff", 63, "d12449c8124182545ae91924286cc6af13528bcf62a5ddbd5e00b891fffc1b48"},
    {"\xff", 64, "8667e718294e9e0df1d30600ba3eeb201f764aad2dad72748643e4a285e1d1f7"},
    {"\xff", 65, "855c9a28fff2bbbd71327165554a00c6fdd44d5d58c1f12b8fdff29b5d67f001"},
    {"\xff", 119, "b863f94597d433ef2280e3b4656f13ea265a79bb8047287321c218905b03c99b"},
    {"\xff", 120, "9088fee917e5a748c2f0b4f5458c1cbdabbd696291c69be6e605bae0ef779e8f"},
    {"\xff", 128, "e9175db65a9789096ca9cb5524d3abc2107df03e3c9ba3af1aca628f9c5d3bd2"},
};

static void test_hashes_match_standard(void **state) {
    (void)state;
    static const size_t pieces[] = {1, 3, 63, 64, 65, 1000000};
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        for (size_t j = 0; j < COUNT_OF(pieces); j++)
            assert_string_equal(hashed(rows[i].text, rows[i].count, pieces[j]), rows[i].hash);
}

// The processor's instructions and the portable code give equal states, for any state, data, alignment and number of
// blocks. Run again with PETRI_CPU=scalar, this compares the portable code with itself.
static void test_instructions_match_portable_code(void **state) {
    (void)state;
    enum { MAX_BLOCKS = 9 };
    unsigned char bytes[(MAX_BLOCKS + 1) * SHA256_BLOCK];
    uint64_t seed = 3;
    for (int i = 0; i < 2000; i++) {
        uint32_t states[2][8];
        for (size_t k = 0; k < sizeof bytes; k++)
            bytes[k] = (unsigned char)(i == 0 ? 0 : i == 1 ? 0xff : next_bits(&seed) >> 56);
        for (size_t k = 0; k < 8; k++)
            states[0][k] = states[1][k] = (uint32_t)(next_bits(&seed) >> 32);
        const unsigned char *start = bytes + next_bits(&seed) % SHA256_BLOCK;
        size_t count = next_bits(&seed) % (MAX_BLOCKS + 1);
        sha256_blocks(states[0], start, count);
        sha256_blocks_portable(states[1], start, count);
        assert_memory_equal(states[0], states[1], sizeof states[0]);
    }
    printf("instructions: %s\n", cpu_detected.sha256 ? "yes" : "no");
}

TEST_GROUP(base_sha256) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hashes_match_standard),
                                       cmocka_unit_test(test_instructions_match_portable_code)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
