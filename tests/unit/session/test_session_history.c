// test_session_history.c: tests that going back and forth in a session gives the same bits, and that memory is bounded.
#include "petri-inspect.h"
#include "petri-live.h"
#include "player.h"

static const char *const SCRIPT = "%pragma tempo 60\n"
                                  "!physics state=:p dimensions=2 time=beat resolution=0.01\n"
                                  "    for i in ..4\n"
                                  "        !particle id=i position=10*uniform(:a)[i];10*uniform(:b)[i] radius=3\n"
                                  "    !collision\n"
                                  "    !random strength=10\n"
                                  "    !drag strength=0.1\n";

static uint64_t state_hash(Player *player) {
    uint64_t hash = UINT64_C(14695981039346656037);
    player->printed.len = 0;
    assert_int_equal(petri_print(player->session, PETRI_PRINT_STATE, note, &player->printed), PETRI_OK);
    for (const char *c = player->printed.text; *c; c++)
        hash = (hash ^ (unsigned char)*c) * UINT64_C(1099511628211);
    return hash;
}

enum { FRAMES = 20000 };

static PetriHistory *history;
enum { MAX_KEYFRAMES = 512, MAX_EPOCHS = 512, INTERVAL = 8 }; // as in history.c
static uint64_t hashes[FRAMES];

static void step(Player *player, int frames) {
    for (int i = 0; i < frames; i++) {
        assert_int_equal(petri_history_step(history), PETRI_OK);
        hashes[petri_frame_number(player->session)] = state_hash(player);
    }
}

static void go_to(Player *player, int64_t frame) {
    assert_int_equal(petri_history_goto(history, frame), PETRI_OK);
    assert_int_equal(petri_frame_number(player->session), frame);
    if (frame >= 0)
        assert_true(state_hash(player) == hashes[frame]);
}

static PetriHistoryInfo info(void) {
    PetriHistoryInfo found;
    assert_true(petri_history_info(history, &found, sizeof found));
    return found;
}

// Returns the number of configurations of the frames of the timeline.
static int count_epochs(void) {
    int count = 0;
    for (int64_t frame = info().first + 1; frame <= info().last; frame++)
        count += petri_history_config(history, frame) != petri_history_config(history, frame - 1);
    return count;
}

static void start_history(Player *player) {
    PetriOptions options = player_options(player);
    options.rollback_frames = true;
    player_reopen(player, &options);
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    history = petri_history_new(player->session, 0);
    assert_non_null(history);
}

static void test_goto_any_frame_gives_same_bits(void **state) {
    Player *player = *state;
    uint64_t random = 1;
    start_history(player);
    step(player, FRAMES);
    assert_true(info().keyframes <= MAX_KEYFRAMES);
    assert_true(info().bytes <= (size_t)64 << 20);
    for (int i = 0; i < 40; i++) {
        random = random * UINT64_C(6364136223846793005) + 1;
        go_to(player, (int64_t)((random >> 33) % FRAMES));
    }
    go_to(player, -1);
    go_to(player, 0);
    go_to(player, FRAMES - 1);
    // Recent frames have dense keyframes. The gap between keyframes is limited relative to their age.
    for (int64_t frame = FRAMES - 1; frame > 0; frame -= 37) {
        assert_int_equal(petri_history_rewind(history, frame), PETRI_OK);
        int64_t from = petri_frame_number(player->session);
        assert_true(from < frame && frame - from <= INTERVAL + (FRAMES - from) / 16 + 2 * INTERVAL);
    }
    petri_history_free(history);
}

// A change applies only to later frames. Earlier frames are recomputed without it.
static void test_change_applies_to_later_frames(void **state) {
    Player *player = *state;
    PetriPromptResult done;
    start_history(player);
    step(player, 50);
    assert_int_equal(
        petri_prompt(player->session, "!counter state=:typed", PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done),
        PETRI_OK);
    step(player, 50);
    assert_int_equal(petri_set_tempo(player->session, 90), PETRI_OK);
    step(player, 50);
    assert_int_equal(count_epochs(), 3);
    static const int64_t way[] = {20, 149, 49, 50, 99, 100, 3, 120, 60, 149};
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++)
        go_to(player, way[i]);
    // A step with other settings replaces the later frames.
    go_to(player, 30);
    assert_float_equal(last_frame(player->session).tempo, 90, 0);
    step(player, 40);
    assert_int_equal(info().last, 70);
    assert_int_equal(count_epochs(), 2);
    static const int64_t again[] = {29, 30, 31, 70, 10, 45, 70};
    for (size_t i = 0; i < sizeof again / sizeof again[0]; i++)
        go_to(player, again[i]);
    // A step with the same settings keeps the later frames.
    go_to(player, 50);
    step(player, 5);
    assert_int_equal(info().last, 70);
    go_to(player, 70);
    petri_history_free(history);
}

static void test_goto_before_start_is_rejected(void **state) {
    Player *player = *state;
    start_history(player);
    step(player, 30);
    assert_int_equal(petri_history_start(history, "for a reason"), PETRI_OK);
    step(player, 30);
    assert_int_equal(petri_history_goto(history, 12), PETRI_INVALID);
    assert_int_equal(info().first, 29);
    assert_string_equal(info().reason, "for a reason");
    assert_int_equal(petri_frame_number(player->session), 59);
    go_to(player, 30);
    assert_int_equal(petri_history_reset(history), PETRI_OK);
    assert_int_equal(petri_frame_number(player->session), 29);
    petri_history_free(history);
}

// A history keeps a limited number of changes. If there are more, the oldest frames are dropped.
static void test_many_changes_drop_the_oldest_frames(void **state) {
    enum { CHANGES = MAX_EPOCHS + 100 };
    Player *player = *state;
    start_history(player);
    for (int i = 0; i < CHANGES; i++) {
        assert_int_equal(petri_set_tempo(player->session, 60 + i), PETRI_OK);
        step(player, 2);
    }
    assert_true(info().keyframes <= MAX_KEYFRAMES);
    assert_true(count_epochs() <= MAX_EPOCHS);
    assert_in_range(info().first, 2 * 100 - 2, 2 * 100 + 20);
    assert_int_equal(petri_history_goto(history, info().first - 1), PETRI_INVALID);
    assert_string_equal(info().reason, "earlier frames were dropped to save memory");
    go_to(player, info().first);
    go_to(player, info().first + 1);
    go_to(player, 2 * CHANGES - 1);
    go_to(player, CHANGES);
    assert_int_equal(petri_history_reset(history), PETRI_OK); // the first frame itself is kept
    assert_int_equal(petri_frame_number(player->session), -1);
    petri_history_free(history);
}

// An allocator that can refuse to enlarge blocks, so that no snapshot can be taken.
static bool refuses_growth;

static void *allocate(void *user_data, size_t size) {
    (void)user_data;
    return malloc(size);
}

static void *resize(void *user_data, void *block, size_t size) {
    (void)user_data;
    return refuses_growth ? NULL : realloc(block, size);
}

static void release(void *user_data, void *block) {
    (void)user_data;
    free(block);
}

// Without memory for snapshots, there are no frames to drop, so the number of changes is limited by refusing them.
static void test_changes_without_snapshots_are_limited(void **state) {
    const PetriAllocator allocator = {sizeof allocator, allocate, resize, release, NULL};
    Player *player = *state;
    player_close(player);
    assert_int_equal(petri_set_allocator(&allocator), PETRI_OK);
    player_open(player);
    start_history(player);
    step(player, 3);
    refuses_growth = true;
    for (int i = 0; i < 2 * MAX_EPOCHS; i++) {
        assert_int_equal(petri_set_tempo(player->session, 60 + i), PETRI_OK);
        petri_history_step(history);
    }
    refuses_growth = false;
    assert_in_range(petri_frame_number(player->session), MAX_EPOCHS, MAX_EPOCHS + INTERVAL + 3);
    assert_int_equal(info().last, petri_frame_number(player->session));
    go_to(player, 2);
    petri_history_free(history);
    player_close(player);
    assert_int_equal(petri_set_allocator(NULL), PETRI_OK);
    player_open(player);
}

// Drops all data except the state of the current frame, as after an interrupted step.
static void lose_systems(Player *player) {
    PetriSystem system;
    PetriSnapshot *snapshot = petri_snapshot(player->session);
    assert_int_equal(petri_rewind(player->session, snapshot), PETRI_OK);
    petri_snapshot_free(snapshot);
    assert_false(petri_system(player->session, 0, &system, sizeof system));
}

// If only the state of a frame exists, history_recompute computes the rest of the frame again, with the configuration
// of the epoch (history.c) to which the frame belongs.
static void test_recompute_restores_whole_frame(void **state) {
    Player *player = *state;
    PetriSystem system;
    start_history(player);
    step(player, 50);
    for (int64_t frame = 49; frame > 30; frame -= 3) {
        go_to(player, frame);
        lose_systems(player);
        assert_int_equal(petri_set_tempo(player->session, 90 + (double)frame), PETRI_OK);
        uint64_t config = petri_config_revision(player->session);
        assert_int_equal(petri_history_recompute(history), PETRI_OK);
        assert_true(petri_system(player->session, 0, &system, sizeof system));
        assert_int_equal(system.particle_count, 4);
        assert_int_equal(petri_frame_number(player->session), frame);
        assert_true(state_hash(player) == hashes[frame]);
        assert_true(petri_config_revision(player->session) == config);
    }
    lose_systems(player);
    int64_t frame = petri_frame_number(player->session);
    petri_interrupt(player->session);
    assert_int_equal(petri_history_recompute(history), PETRI_INTERRUPTED);
    assert_int_equal(petri_frame_number(player->session), frame);
    assert_true(state_hash(player) == hashes[frame]);
    go_to(player, -1);
    assert_int_equal(petri_history_recompute(history), PETRI_OK); // there is nothing to recompute
    assert_int_equal(petri_frame_number(player->session), -1);
    petri_history_free(history);
}

static void move_particle(size_t system, uint32_t particle, const double *position, const double *velocity,
                          PetriStatus expected) {
    assert_int_equal(petri_history_move_particle(history, system, particle, position, velocity), expected);
}

static void digest_now(Player *player, uint8_t digest[16]) {
    assert_int_equal(petri_digest(player->session, digest), PETRI_OK);
}

// A move is a part of its frame, wherever the timeline starts, and discards the frames after it.
static void test_moves_are_part_of_their_frames(void **state) {
    static const double there[] = {3, 4}, fast[] = {-50, 9};
    Player *player = *state;
    PetriSystem system;
    start_history(player);
    move_particle(0, 0, there, NULL, PETRI_INVALID); // there are no particles yet
    step(player, 30);
    move_particle(0, 2, there, NULL, PETRI_OK);
    move_particle(0, 2, NULL, fast, PETRI_OK);
    move_particle(0, 3, there, there, PETRI_OK);
    hashes[29] = state_hash(player);
    assert_true(petri_system(player->session, 0, &system, sizeof system));
    assert_memory_equal(system.position.data + 2 * system.position.stride, there, sizeof there);
    assert_memory_equal(system.velocity.data + 2 * system.velocity.stride, fast, sizeof fast);
    step(player, 30);
    assert_true(petri_history_is_moved(history, 29) && !petri_history_is_moved(history, 28));
    static const int64_t way[] = {20, 29, 30, 28, 59, 29, 3, 45, 29, 59};
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++)
        go_to(player, way[i]);
    assert_int_equal(petri_history_rewind(history, 30), PETRI_OK);
    while (petri_frame_number(player->session) < 59) {
        uint64_t before = hashes[petri_frame_number(player->session) + 1];
        step(player, 1);
        assert_true(hashes[petri_frame_number(player->session)] == before);
    }
    go_to(player, 29);
    step(player, 1);
    go_to(player, 29);
    assert_int_equal(petri_history_start(history, NULL), PETRI_OK);
    move_particle(0, 0, there, NULL, PETRI_OK); // in the first frame
    assert_int_equal(info().last, 29);
    hashes[29] = state_hash(player);
    step(player, 20);
    assert_int_equal(petri_history_reset(history), PETRI_OK);
    assert_true(state_hash(player) == hashes[29]);
    go_to(player, 40);
    go_to(player, 49);
    petri_history_free(history);
}

// Moves that are not valid change nothing, nor does a move to where a particle is.
static void test_moves_without_effect(void **state) {
    static const double infinite[] = {1, INFINITY}, there[] = {1, 2};
    Player *player = *state;
    PetriSystem system;
    uint8_t before[16], after[16];
    start_history(player);
    assert_int_equal(player_load(player, "!physics state=:p dimensions=2\n    !particle id=0 position=1;2\n"
                                         "    !anchor id=1 position=0;0\n"),
                     PETRI_OK);
    assert_int_equal(petri_history_start(history, NULL), PETRI_OK);
    step(player, 9);
    digest_now(player, before);
    move_particle(1, 0, there, there, PETRI_INVALID);
    move_particle(0, 2, there, there, PETRI_INVALID);
    move_particle(0, 1, there, there, PETRI_INVALID); // an anchor
    move_particle(0, 0, there, infinite, PETRI_INVALID);
    move_particle(0, 0, infinite, there, PETRI_INVALID);
    assert_false(petri_history_is_moved(history, 8));
    assert_true(petri_system(player->session, 0, &system, sizeof system));
    move_particle(0, 0, system.position.data, system.velocity.data, PETRI_OK);
    digest_now(player, after);
    assert_memory_equal(before, after, sizeof after);
    petri_history_free(history);
}

TEST_GROUP(session_history) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_goto_any_frame_gives_same_bits),        PLAYER_TEST(test_change_applies_to_later_frames),
        PLAYER_TEST(test_goto_before_start_is_rejected),         PLAYER_TEST(test_many_changes_drop_the_oldest_frames),
        PLAYER_TEST(test_changes_without_snapshots_are_limited), PLAYER_TEST(test_recompute_restores_whole_frame),
        PLAYER_TEST(test_moves_are_part_of_their_frames),        PLAYER_TEST(test_moves_without_effect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
