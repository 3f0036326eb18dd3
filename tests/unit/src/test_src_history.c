// test_src_history.c: tests that going back and forth in a session gives the same bits, and that memory is bounded.
#include "cli/cli.h"
#include "cli/history.h"
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

static FrameHistory history;
static uint64_t hashes[FRAMES];

static void step(Player *player, int frames) {
    for (int i = 0; i < frames; i++) {
        assert_int_equal(history_step(&history, player->session), PETRI_OK);
        hashes[petri_frame_number(player->session)] = state_hash(player);
    }
}

static void go_to(Player *player, int64_t frame) {
    Text why = {0};
    PetriStatus status = history_goto(&history, player->session, frame, &why);
    if (status != PETRI_OK)
        print_error("%lld: %s\n", (long long)frame, why.bytes ? why.bytes : "");
    assert_int_equal(status, PETRI_OK);
    assert_int_equal(petri_frame_number(player->session), frame);
    if (frame >= 0)
        assert_true(state_hash(player) == hashes[frame]);
    text_free(&why);
}

static void start_history(Player *player) {
    PetriOptions options = player_options(player);
    options.rollback_frames = true;
    player_reopen(player, &options);
    assert_int_equal(player_load(player, SCRIPT), PETRI_OK);
    assert_true(history_start(&history, player->session, NULL));
}

static void test_goto_any_frame_gives_same_bits(void **state) {
    Player *player = *state;
    uint64_t random = 1;
    start_history(player);
    step(player, FRAMES);
    assert_true(history.keyframe_count <= HISTORY_MAX);
    assert_true(history.bytes <= HISTORY_BYTES);
    for (int i = 0; i < 40; i++) {
        random = random * UINT64_C(6364136223846793005) + 1;
        go_to(player, (int64_t)((random >> 33) % FRAMES));
    }
    go_to(player, -1);
    go_to(player, 0);
    go_to(player, FRAMES - 1);
    // Recent frames have dense keyframes. The gap between keyframes is limited relative to their age.
    for (size_t i = 1; i < history.keyframe_count; i++) {
        int64_t gap = history.keyframes[i].frame - history.keyframes[i - 1].frame;
        int64_t age = history.last - history.keyframes[i - 1].frame;
        assert_true(gap <= HISTORY_INTERVAL || gap < age / 16 + 2 * HISTORY_INTERVAL);
    }
    history_free(&history);
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
    assert_int_equal(history.epoch_count, 3);
    static const int64_t way[] = {20, 149, 49, 50, 99, 100, 3, 120, 60, 149};
    for (size_t i = 0; i < sizeof way / sizeof way[0]; i++)
        go_to(player, way[i]);
    // A step with other settings replaces the later frames.
    go_to(player, 30);
    assert_float_equal(last_frame(player->session).tempo, 90, 0);
    step(player, 40);
    assert_int_equal(history.last, 70);
    assert_int_equal(history.epoch_count, 2);
    static const int64_t again[] = {29, 30, 31, 70, 10, 45, 70};
    for (size_t i = 0; i < sizeof again / sizeof again[0]; i++)
        go_to(player, again[i]);
    // A step with the same settings keeps the later frames.
    go_to(player, 50);
    step(player, 5);
    assert_int_equal(history.last, 70);
    go_to(player, 70);
    history_free(&history);
}

static void test_goto_before_start_is_rejected(void **state) {
    Player *player = *state;
    Text why = {0};
    start_history(player);
    step(player, 30);
    assert_true(history_start(&history, player->session, "for a reason"));
    step(player, 30);
    assert_int_equal(history_goto(&history, player->session, 12, &why), PETRI_INVALID);
    assert_non_null(strstr(why.bytes, "starts at frame 29: for a reason"));
    assert_int_equal(petri_frame_number(player->session), 59);
    go_to(player, 30);
    assert_int_equal(history_reset(&history, player->session), PETRI_OK);
    assert_int_equal(petri_frame_number(player->session), 29);
    text_free(&why);
    history_free(&history);
}

// Each change needs its own keyframe, so that the oldest frames are dropped if there are more changes than keyframes.
static void test_many_changes_drop_the_oldest_frames(void **state) {
    enum { CHANGES = HISTORY_MAX + 100 };
    Player *player = *state;
    Text why = {0};
    start_history(player);
    for (int i = 0; i < CHANGES; i++) {
        assert_int_equal(petri_set_tempo(player->session, 60 + i), PETRI_OK);
        step(player, 2);
    }
    assert_true(history.keyframe_count <= HISTORY_MAX);
    assert_true(history.epoch_count <= HISTORY_MAX);
    assert_in_range(history.first, 2 * 100 - 2, 2 * 100 + 20);
    assert_int_equal(history_goto(&history, player->session, history.first - 1, &why), PETRI_INVALID);
    assert_non_null(strstr(why.bytes, "earlier frames were dropped to save memory"));
    go_to(player, history.first);
    go_to(player, history.first + 1);
    go_to(player, 2 * CHANGES - 1);
    go_to(player, CHANGES);
    assert_int_equal(history_reset(&history, player->session), PETRI_OK); // the first frame itself is kept
    assert_int_equal(petri_frame_number(player->session), -1);
    text_free(&why);
    history_free(&history);
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
// of the epoch (history.h) to which the frame belongs.
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
        assert_int_equal(history_recompute(&history, player->session), PETRI_OK);
        assert_true(petri_system(player->session, 0, &system, sizeof system));
        assert_int_equal(system.particle_count, 4);
        assert_int_equal(petri_frame_number(player->session), frame);
        assert_true(state_hash(player) == hashes[frame]);
        assert_true(petri_config_revision(player->session) == config);
    }
    lose_systems(player);
    int64_t frame = petri_frame_number(player->session);
    petri_interrupt(player->session);
    assert_int_equal(history_recompute(&history, player->session), PETRI_INTERRUPTED);
    assert_int_equal(petri_frame_number(player->session), frame);
    assert_true(state_hash(player) == hashes[frame]);
    go_to(player, -1);
    assert_int_equal(history_recompute(&history, player->session), PETRI_OK); // there is nothing to recompute
    assert_int_equal(petri_frame_number(player->session), -1);
    history_free(&history);
}

TEST_GROUP(src_history) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_goto_any_frame_gives_same_bits), PLAYER_TEST(test_change_applies_to_later_frames),
        PLAYER_TEST(test_goto_before_start_is_rejected),  PLAYER_TEST(test_many_changes_drop_the_oldest_frames),
        PLAYER_TEST(test_recompute_restores_whole_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
