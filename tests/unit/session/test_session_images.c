// test_session_images.c: a session continues with the same digests after it went back to a snapshot or within a
// history, and a new session continues so from the texts of a keyframe, whatever happened before and after: frames,
// parameters, input, values that the host stored, statements of the prompt.
#include "petri-live.h"
#include "player.h"
#include "session/recorder.h"

static const char SCRIPT[] = "let N=N or 3 -- 1..9\n"
                             "let DIM=DIM or 2 -- 1..3\n"
                             "let KIND=KIND or 0 -- 0..3|1\n"
                             "!window size=10;10\n"
                             "    !pointer state=:mouse\n"
                             "    !key name=:space state='key';1\n"
                             "!physics state=:p dimensions=DIM time=beat resolution=0.01 run=frame//17\n"
                             "    !group\n"
                             "        for i in ..N\n"
                             "            !particle id=i position=10*uniform(:a;i)[..DIM] radius=2\n"
                             "        !collision\n"
                             "    !group\n"
                             "        for i in ..(KIND*2)\n"
                             "            !particle id=:q;i position=5*uniform(:b;i)[..DIM] radius=1+(push or 0)\n"
                             "        if KIND==1\n"
                             "            !gravity strength=3 ease=1\n"
                             "        elif KIND==2\n"
                             "            !adhesion strength=2\n"
                             "    if KIND==3\n"
                             "        !anchor id='x' position=$(:mouse)[0]\n"
                             "        !distance from='x' to=0 max=4 strength=9\n"
                             "    !random strength=5\n"
                             "    !drag strength=0.2\n"
                             "if N%3\n"
                             "    !physics state='text';1 dimensions=1 time=beat\n"
                             "        !particle id='p' position=($:host or 1) velocity=KIND\n"
                             "!counter state=:count rate=($('key';1) or 1);DIM initial=0;N\n";

enum { EVENTS = 60, BACK = 25, RUNS = 40 };

static const char *read_script(void *user_data, const char *name, size_t *length) {
    (void)user_data;
    *length = sizeof SCRIPT - 1;
    return strcmp(name, "t.fl") == 0 ? SCRIPT : NULL;
}

static uint32_t next_random(uint64_t *random, uint32_t count) {
    *random = *random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)(*random >> 33) % count;
}

static void set_parameter(PetriSession *session, const char *name, uint32_t value) {
    char text[16];
    snprintf(text, sizeof text, "%u", value);
    assert_int_equal(petri_set_parameter(session, name, text), PETRI_OK);
}

static void set_global(PetriSession *session, double value) {
    assert_int_equal(petri_set_global(session, "push", (PetriValue){.length = 1, .numbers = &value}), PETRI_OK);
}

// Applies an event of the sequence and stores the digest. `*push` is the value of the name that the host sets.
static void apply_event(PetriSession *session, uint64_t *random, double *push, uint8_t digest[16]) {
    PetriPromptResult done;
    char text[40];
    uint32_t kind = next_random(random, 16), value = next_random(random, 9);
    double key = petri_symbol(session, "host"), number = value / 3.0;
    PetriPointer pointer = {.size = sizeof pointer, .inside = value % 4, .x = value / 9.0, .y = 0.1, .buttons = value};
    if (kind == 0)
        set_parameter(session, "N", 1 + value);
    else if (kind == 1)
        set_parameter(session, "DIM", 1 + value % 3);
    else if (kind == 2)
        set_parameter(session, "KIND", value % 4);
    else if (kind == 3)
        assert_int_equal(petri_report_pointer(session, value == 8 ? NULL : &pointer), PETRI_OK);
    else if (kind == 4)
        assert_int_equal(petri_report_key(session, value % 3 ? "space" : "a", value % 2), PETRI_OK);
    else if (kind == 5)
        assert_int_equal(petri_state_set(session, (PetriValue){1, &key, NULL}, (PetriValue){1, &number, NULL}),
                         PETRI_OK);
    else if (kind == 6)
        set_global(session, *push = value / 9.0);
    else if (kind == 7)
        assert_int_equal(petri_set_tempo(session, 100 + value), PETRI_OK);
    else if (kind == 8 && snprintf(text, sizeof text, "!counter state=:c%u rate=%u", value, value) > 0)
        assert_int_equal(petri_prompt(session, text, PETRI_NUL_TERMINATED, NULL, NULL, &done, sizeof done), PETRI_OK);
    else
        assert_int_equal(petri_step(session), PETRI_OK);
    assert_int_equal(petri_digest(session, digest), PETRI_OK);
}

// Applies the events from BACK to EVENTS and compares their digests.
static void check_events(PetriSession *session, uint64_t random, double push, uint8_t digests[][16], const char *how) {
    for (int i = BACK; i < EVENTS; i++) {
        uint8_t digest[16];
        apply_event(session, &random, &push, digest);
        if (memcmp(digest, digests[i], sizeof digest) != 0)
            fail_msg("%s, event %d", how, i);
    }
}

static PetriSession *open_session(Player *player) {
    PetriOptions options = player_options(player);
    options.read_file = read_script;
    PetriSession *session = petri_open(&options);
    assert_non_null(session);
    return session;
}

static char *copy_text(PetriSession *session, RecorderText what) {
    Str text;
    assert_int_equal(recorder_write(session, what, &text), PETRI_OK);
    return strndup(text.bytes, text.len);
}

static void test_sessions_continue_the_same(void **state) {
    Player *player = *state;
    for (uint64_t run = 0; run < RUNS; run++) {
        uint64_t random = run, at = 0;
        uint8_t digests[EVENTS][16];
        double push = 0, push_at = 0;
        PetriSnapshot *snapshot = NULL;
        char *setup = NULL, *texts = NULL;
        PetriSession *session = open_session(player);
        set_global(session, push);
        assert_int_equal(petri_load(session, "t.fl"), PETRI_OK);
        for (int i = 0; i < EVENTS; i++) {
            if (i == BACK) {
                at = random;
                push_at = push;
                snapshot = petri_snapshot(session);
                setup = copy_text(session, RECORDER_SETUP);
                texts = copy_text(session, RECORDER_STATE);
            }
            apply_event(session, &random, &push, digests[i]);
        }
        for (int i = 0; i < 2; i++) {
            assert_int_equal(petri_rewind(session, snapshot), PETRI_OK);
            set_global(session, push_at); // not a part of snapshots
            char *again = copy_text(session, RECORDER_SETUP), *state_again = copy_text(session, RECORDER_STATE);
            assert_string_equal(again, setup);
            assert_string_equal(state_again, texts);
            free(again);
            free(state_again);
            check_events(session, at, push_at, digests, "snapshot");
        }
        petri_snapshot_free(snapshot);
        petri_close(&session);
        session = open_session(player);
        assert_int_equal(recorder_restore(session, str_from(setup), str_from(texts)), PETRI_OK);
        check_events(session, at, push_at, digests, "keyframe");
        petri_close(&session);
        free(setup);
        free(texts);
    }
}

// Changes the configuration, in some cases so that it is the same as before.
static void change_config(PetriSession *session, uint64_t *random) {
    uint32_t kind = next_random(random, 5), value = next_random(random, 9);
    if (kind == 0)
        set_parameter(session, "N", 1 + value);
    else if (kind == 1)
        set_parameter(session, "DIM", 1 + value % 3);
    else if (kind == 2)
        set_parameter(session, "KIND", value % 4);
    for (uint32_t i = 0; kind > 2 && i < 3; i++)
        assert_int_equal(petri_set_tempo(session, (i % 2 ? 100 : 110) + (kind == 3 ? value * i : 0)), PETRI_OK);
}

enum { MAX_FRAME = 400 };

// Digests and configurations of the frames that were computed, by number.
typedef struct Known {
    uint8_t digests[MAX_FRAME][16];
    uint64_t configs[MAX_FRAME];
} Known;

// Compares the current frame with its known digest, if the timeline still has all frames to `*last`, else stores it.
// Sets `*last` to its last frame.
static void check_frame(PetriSession *session, PetriHistory *history, int64_t *last, Known *known, uint64_t run) {
    uint8_t digest[16];
    int64_t frame = petri_frame_number(session);
    PetriHistoryInfo info;
    assert_true(petri_history_info(history, &info, sizeof info));
    bool is_known = frame <= *last && info.last >= *last;
    *last = info.last;
    if (frame <= info.first)
        return;
    uint64_t config = petri_history_config(history, frame);
    assert_true(config != 0 && frame < MAX_FRAME);
    assert_int_equal(petri_digest(session, digest), PETRI_OK);
    bool replaced = frame == info.last && known->configs[frame] != config; // the last frame, after a change before it
    if (is_known && !replaced &&
        (known->configs[frame] != config || memcmp(digest, known->digests[frame], sizeof digest) != 0))
        fail_msg("run %llu: frame %lld differs", (unsigned long long)run, (long long)frame);
    known->configs[frame] = config;
    memcpy(known->digests[frame], digest, sizeof digest);
}

// Moves a particle of the current frame. The arguments may be invalid.
static void move_particle(PetriSession *session, PetriHistory *history, uint64_t *random, int64_t *last) {
    PetriSystem system;
    double numbers[3];
    size_t number = next_random(random, 2);
    uint32_t particle = next_random(random, 5), chosen = next_random(random, 4);
    for (int i = 0; i < 3; i++)
        numbers[i] = next_random(random, 100) / 7.0;
    bool exists = petri_system(session, number, &system, sizeof system) && particle < system.particle_count &&
                  !system.anchor[particle * system.anchor_stride];
    PetriStatus status = petri_history_move_particle(history, number, particle, chosen > 0 ? numbers : NULL,
                                                     chosen != 1 ? numbers : NULL);
    assert_int_equal(status, exists ? PETRI_OK : PETRI_INVALID);
    assert_true(!exists || petri_history_is_moved(history, petri_frame_number(session)));
    *last = exists ? petri_frame_number(session) - 1 : *last; // this frame has changed
}

// Goes back and forth at random, changes the configuration and moves particles at random, and compares each frame that
// is computed again. The history may keep only few snapshots.
static void test_history_gives_the_same_digests(void **state) {
    static Known known;
    Player *player = *state;
    for (uint64_t run = 0; run < RUNS; run++) {
        uint64_t random = run;
        int64_t last = -1;
        PetriSession *session = open_session(player);
        assert_int_equal(petri_load(session, "t.fl"), PETRI_OK);
        PetriHistory *history = petri_history_new(session, run % 3 ? 20000 : 0);
        for (int i = 0; i < 150; i++) {
            PetriHistoryInfo info;
            assert_true(petri_history_info(history, &info, sizeof info));
            uint32_t kind = next_random(&random, 14);
            int64_t span = info.last - info.first + 1, frame = info.first + next_random(&random, (uint32_t)span);
            if (kind == 0)
                change_config(session, &random);
            else if (kind == 1)
                assert_int_equal(petri_history_goto(history, frame), PETRI_OK);
            else if (kind == 2 && frame > info.first)
                assert_int_equal(petri_history_rewind(history, frame), PETRI_OK);
            else if (kind == 3)
                assert_int_equal(petri_history_recompute(history), PETRI_OK);
            else if (kind == 12)
                move_particle(session, history, &random, &last);
            else if (kind < 8 && petri_frame_number(session) < MAX_FRAME - 1)
                assert_int_equal(petri_history_step(history), PETRI_OK);
            else if (petri_frame_number(session) < MAX_FRAME - 40)
                for (uint32_t k = next_random(&random, 30); k > 0; k--) {
                    assert_int_equal(petri_history_step(history), PETRI_OK);
                    check_frame(session, history, &last, &known, run);
                }
            check_frame(session, history, &last, &known, run);
        }
        petri_history_free(history);
        petri_close(&session);
    }
}

TEST_GROUP(session_images) {
    const struct CMUnitTest tests[] = {PLAYER_TEST(test_sessions_continue_the_same),
                                       PLAYER_TEST(test_history_gives_the_same_digests)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
