// test_session_digest.c: tests that the digest of a state does not depend on the number of threads that compute it.
#include "player.h"

#include <stdint.h>

enum { FRAMES = 4, DIGEST_SIZE = 16, MAX_THREADS = 5 };

// States of 160000 numbers, which threads share. The ids of the second state do not count up, so its entries are
// stored one by one; the third has entries of different lengths, and strings.
static const char *const SCRIPTS[] = {
    "!physics state=:p dimensions=2\n"
    "    for i in ..40000\n"
    "        !particle id=i position=i;0 velocity=0;i\n",
    "!physics state=:p dimensions=2\n"
    "    for i in ..40000\n"
    "        !particle id=(i*7919)%40009 position=i;0 velocity=0;i\n",
    "!physics state=:p dimensions=3\n"
    "    for i in ..27000\n"
    "        !particle id=i;'s' position=i;0;1 velocity=0;i;2\n"
    "!counter state=:c rate=3\n"
    "!counter state=:d rate=1;2;3\n",
};

// Computes the digests of all frames of a script.
static void compute_digests(const char *script, int threads, uint8_t digests[FRAMES][DIGEST_SIZE]) {
    Player player = {0};
    PetriOptions options = player_options(&player);
    options.threads = threads;
    player_open_with(&player, &options);
    assert_int_equal(player_load(&player, script), PETRI_OK);
    for (int frame = 0; frame < FRAMES; frame++) {
        assert_int_equal(petri_step(player.session), PETRI_OK);
        assert_int_equal(petri_digest(player.session, digests[frame]), PETRI_OK);
    }
    player_close(&player);
}

static void test_digest_does_not_depend_on_threads(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof SCRIPTS / sizeof SCRIPTS[0]; i++) {
        uint8_t expected[FRAMES][DIGEST_SIZE], digests[FRAMES][DIGEST_SIZE];
        compute_digests(SCRIPTS[i], 1, expected);
        assert_memory_not_equal(expected[FRAMES - 2], expected[FRAMES - 1], DIGEST_SIZE);
        for (int threads = 2; threads <= MAX_THREADS; threads++) {
            compute_digests(SCRIPTS[i], threads, digests);
            assert_memory_equal(digests, expected, sizeof expected);
        }
    }
}

TEST_GROUP(session_digest) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_digest_does_not_depend_on_threads)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
