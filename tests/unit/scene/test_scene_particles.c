// test_scene_particles.c: tests systems over several frames: runs, particles that appear and vanish, and several
// systems (physics.md sections 2 and 3). The rate is 8 fps, so that all sums are exact.
#include "player.h"

// Returns the state after `frames` frames, without the clock keys of systems.
static const char *state_after(Player *player, const char *script, int frames) {
    PetriOptions options = player_options(player);
    options.fps = 8;
    player_reopen(player, &options);
    player_run(player, script, frames);
    char *line = (char *)player_state(player), *out = player->printed.text;
    for (char *end; *line; line = end) {
        end = strchr(line, '\n') + 1;
        static const char *const clocks[] = {";:clock)", ";:iteration)", ";:last)", ";:run)"};
        bool dropped = false;
        for (size_t i = 0; i < COUNT_OF(clocks); i++) {
            char *found = strstr(line, clocks[i]);
            dropped |= found && found < end;
        }
        if (!dropped) {
            memmove(out, line, (size_t)(end - line));
            out += end - line;
        }
    }
    *out = 0;
    return player->printed.text;
}

typedef struct StateRow {
    const char *script;
    int frames;
    const char *wanted;
} StateRow;

static void check_states(Player *player, const StateRow *rows, size_t count) {
    for (size_t i = 0; i < count; i++)
        assert_text(rows[i].script, state_after(player, rows[i].script, rows[i].frames), rows[i].wanted);
}

#define SYSTEM "!physics state=:s dimensions=1\n"

static void test_first_frames(void **state) {
    static const StateRow rows[] = {
        {SYSTEM, 1, "$:s = 0\n"},
        {SYSTEM "    !particle id=1 position=5 velocity=8\n", 1, "$:s = 0\n"}, // no particles are stored in frame 0
        {SYSTEM "    !particle id=1 position=5 velocity=8\n", 2, "$:s = 0\n$(:s;1) = 6\n$(:s;1;:velocity) = 8\n"},
        {SYSTEM "    !particle id=1 position=5 velocity=8\n", 4, "$:s = 0\n$(:s;1) = 8\n$(:s;1;:velocity) = 8\n"},
        {SYSTEM "    !particle id=1 position=frame velocity=0\n", 3, "$:s = 0\n$(:s;1) = 1\n$(:s;1;:velocity) = 0\n"},
        {SYSTEM "    !particle id=1 position=1/0\n", 2,
         "$:s = 0\n$(:s;1;:velocity) = 0\n"}, // only finite values are stored
        {SYSTEM "    !particle id=:a;1\n    !particle id='s'\n", 2,
         "$:s = 0\n$(:s;:a;1) = 0\n$(:s;:a;1;:velocity) = 0\n$(:s;'s') = 0\n$(:s;'s';:velocity) = 0\n"},
    };
    check_states(*state, rows, COUNT_OF(rows));
}

static void test_anchors_are_stored_once_simulated(void **state) {
    static const StateRow rows[] = {
        {SYSTEM "    !anchor id=1 position=5\n    !particle id=2\n", 1,
         "$:s = 0\n$(:s;1) = 5\n$(:s;1;:velocity) = 0\n"},
        {SYSTEM "    !anchor id=1 position=frame velocity=9\n    !particle id=2\n", 3,
         "$:s = 0\n$(:s;1) = 2\n$(:s;1;:velocity) = 0\n$(:s;2) = 0\n$(:s;2;:velocity) = 0\n"},
        // A system that contains only anchors stores them when it is simulated, as the recorded language cases expect
        // (state-lookup-anchor-position and others). Spec physics.md 2.6 does not mention this exception.
        {SYSTEM "    !anchor id=1 position=5\n", 1, "$:s = 0\n"},
        {SYSTEM "    !anchor id=1 position=5\n", 2, "$:s = 0\n$(:s;1) = 5\n$(:s;1;:velocity) = 0\n"},
        {SYSTEM "    !anchor id=1 position=5\n    !constant force=3\n", 3,
         "$:s = 0\n$(:s;1) = 5\n$(:s;1;:velocity) = 0\n"},
    };
    check_states(*state, rows, COUNT_OF(rows));
}

static void test_particles_appear_and_vanish(void **state) {
    static const StateRow rows[] = {
        // Particle 2 appears in frame 2 with the values of its attributes.
        {SYSTEM "    !particle id=1 velocity=8\n    if frame>=2\n        !particle id=2 position=5 velocity=8\n", 4,
         "$:s = 0\n$(:s;1) = 3\n$(:s;1;:velocity) = 8\n$(:s;2) = 7\n$(:s;2;:velocity) = 8\n"},
        // Particle 1 and its keys vanish in frame 2.
        {SYSTEM "    if frame<2\n        !particle id=1 velocity=8\n    !particle id=2\n", 3,
         "$:s = 0\n$(:s;2) = 0\n$(:s;2;:velocity) = 0\n"},
        // A particle that returns starts from its attributes.
        {SYSTEM "    if frame!=2\n        !particle id=1 position=frame velocity=8\n    !particle id=2\n", 4,
         "$:s = 0\n$(:s;1) = 4\n$(:s;1;:velocity) = 8\n$(:s;2) = 0\n$(:s;2;:velocity) = 0\n"},
        // Particles keep their identity if their order changes.
        {SYSTEM "    (!particle id=i velocity=i*8) for i in (1;2;3 if frame%2 else 3;1;2)\n", 4,
         "$:s = 0\n$(:s;1) = 3\n$(:s;1;:velocity) = 8\n$(:s;2) = 6\n$(:s;2;:velocity) = 16\n$(:s;3) = 9\n"
         "$(:s;3;:velocity) = 24\n"},
        // A particle that becomes an anchor keeps its state key.
        {SYSTEM "    if frame<2\n        !particle id=1 velocity=8\n    else\n        !anchor id=1 position=-1\n", 3,
         "$:s = 0\n$(:s;1) = -1\n$(:s;1;:velocity) = 0\n"},
    };
    check_states(*state, rows, COUNT_OF(rows));
}

#define PAUSED "!physics state=:s dimensions=1 time=(0;1;1;2)[frame]/8\n" // paused in frame 2

// If a vanished particle shares keys with other particles, these keys are kept, even in a frame without simulation.
static void test_vanished_particle_leaves_shared_keys(void **state) {
    static const char velocity_vanishes[] = PAUSED "    !particle id=0 position=5 velocity=8\n"
                                                   "    if frame<2\n"
                                                   "        !particle id=0;:velocity position=3 velocity=16\n";
    static const char position_vanishes[] = PAUSED "    if frame<2\n"
                                                   "        !particle id=0 position=5 velocity=8\n"
                                                   "    !particle id=0;:velocity position=3 velocity=16\n";
    static const StateRow rows[] = {
        {velocity_vanishes, 3, "$:s = 0\n$(:s;0) = 6\n$(:s;0;:velocity) = 5\n"},
        {velocity_vanishes, 4, "$:s = 0\n$(:s;0) = 6.625\n$(:s;0;:velocity) = 5\n"},
        {position_vanishes, 3, "$:s = 0\n$(:s;0;:velocity) = 5\n$(:s;0;:velocity;:velocity) = 16\n"},
        {position_vanishes, 4, "$:s = 0\n$(:s;0;:velocity) = 7\n$(:s;0;:velocity;:velocity) = 16\n"},
    };
    check_states(*state, rows, COUNT_OF(rows));
}

static void test_changed_run_restarts_system(void **state) {
    static const StateRow rows[] = {
        // In the frame in which `run` changes, particles start from their attributes and are simulated for that frame's
        // delta.
        {"!physics state=:s dimensions=1 run=frame>=3\n    !particle id=1 velocity=8\n", 3,
         "$:s = 0\n$(:s;1) = 2\n$(:s;1;:velocity) = 8\n"},
        {"!physics state=:s dimensions=1 run=frame>=3\n    !particle id=1 velocity=8\n", 4,
         "$:s = 0.375\n$(:s;1) = 1\n$(:s;1;:velocity) = 8\n"},
        {"!physics state=:s dimensions=1 run=frame>=3\n    !particle id=1 velocity=8\n", 5,
         "$:s = 0.375\n$(:s;1) = 2\n$(:s;1;:velocity) = 8\n"},
        {"!physics state=:s dimensions=1 run=1/0\n    !particle id=1 velocity=8\n", 2,
         "$:s = 0\n$(:s;1) = 1\n$(:s;1;:velocity) = 8\n"}, // a time that is not finite counts as 0
    };
    check_states(*state, rows, COUNT_OF(rows));
    Player *player = *state;
    PetriOptions options = player_options(player);
    player_reopen(player, &options);
    player_run(player,
               "%pragma fps 8\n!physics state=:r dimensions=1 run=(frame>=2)*7\n    !particle id=1 velocity=8\n", 4);
    assert_text("clocks", strstr(player_state(player), "$:r"),
                "$:r = 0.25\n$(:r;:clock) = 0.25\n$(:r;:iteration) = 1\n$(:r;:last) = 0.375\n$(:r;:run) = 7\n"
                "$(:r;1) = 2\n$(:r;1;:velocity) = 8\n");
}

static void test_time_attribute(void **state) {
    static const StateRow rows[] = {
        {"!physics state=:s dimensions=1 time=5+frame*2 resolution=1\n    !particle id=1 velocity=1\n", 3,
         "$:s = 5\n$(:s;1) = 4\n$(:s;1;:velocity) = 1\n"},
        // the time stands still
        {"!physics state=:s dimensions=1 time=5\n    !particle id=1 velocity=1\n", 3, "$:s = 5\n"},
        // the time goes backwards
        {"!physics state=:s dimensions=1 time=5-frame\n    !particle id=1 velocity=1\n", 3, "$:s = 5\n"},
    };
    check_states(*state, rows, COUNT_OF(rows));
    Player *player = *state;
    PetriOptions options = player_options(player);
    player_reopen(player, &options);
    player_run(player, "!physics state=:s dimensions=1 time=5-frame\n    !particle id=1\n", 3);
    assert_non_null(strstr(player_state(player), "$(:s;:last) = 3\n"));
    assert_non_null(strstr(player_state(player), "$(:s;:clock) = 0\n"));
}

static void test_absent_system_keeps_state(void **state) {
    static const StateRow rows[] = {
        // A system that returns continues from its state and simulates the time of its absence.
        {"if frame!=2\n    !physics state=:s dimensions=1\n        !particle id=1 velocity=8\n", 3,
         "$:s = 0\n$(:s;1) = 1\n$(:s;1;:velocity) = 8\n"},
        {"if frame!=2\n    !physics state=:s dimensions=1\n        !particle id=1 velocity=8\n", 4,
         "$:s = 0\n$(:s;1) = 3\n$(:s;1;:velocity) = 8\n"},
        // Particle 2 was not in the previous frame's tree, so its keys are kept.
        {"if frame!=2\n    !physics state=:s dimensions=1\n        !particle id=1 velocity=8\n"
         "        if frame<2\n            !particle id=2 velocity=8\n",
         4, "$:s = 0\n$(:s;1) = 3\n$(:s;1;:velocity) = 8\n$(:s;2) = 1\n$(:s;2;:velocity) = 8\n"},
        // A change of `run` after an absence also keeps keys. Particles in the tree start from their attributes.
        {"if frame!=2\n    !physics state=:s dimensions=1 run=frame>2\n        !particle id=1 velocity=8\n"
         "        if frame<2\n            !particle id=2 velocity=8\n",
         4, "$:s = 0.375\n$(:s;1) = 2\n$(:s;1;:velocity) = 8\n$(:s;2) = 1\n$(:s;2;:velocity) = 8\n"},
        // A skipped frame is not an absence: the system keeps its list of particles.
        {"!physics state=:s dimensions=frame!=2\n    !particle id=1 velocity=8\n    if frame<2\n        !particle "
         "id=2\n",
         4, "$:s = 0\n$(:s;1) = 3\n$(:s;1;:velocity) = 8\n"},
    };
    check_states(*state, rows, COUNT_OF(rows));
}

static void test_several_systems(void **state) {
    Player *player = *state;
    static const StateRow rows[] = {
        {"!physics state=:a dimensions=1\n    !particle id=1 velocity=8\n"
         "!physics state=:b dimensions=2\n    !particle id=1 velocity=8;16\n",
         3, "$:a = 0\n$(:a;1) = 2\n$(:a;1;:velocity) = 8\n$:b = 0\n$(:b;1) = 2;4\n$(:b;1;:velocity) = 8;16\n"},
        {"!physics state=:a;1 dimensions=1\n    !particle id=1 velocity=8\n"
         "!physics state=:a dimensions=1\n    !particle id=2 velocity=16\n",
         2, "$:a = 0\n$(:a;1) = 0\n$(:a;1;1) = 1\n$(:a;1;1;:velocity) = 8\n$(:a;2) = 2\n$(:a;2;:velocity) = 16\n"},
        {"!a\n    !physics state=:s dimensions=1\n        !particle id=1\n", 3, ""}, // systems are top-level nodes only
    };
    check_states(player, rows, COUNT_OF(rows));
    player_run(
        player,
        "!physics state=:z dimensions=1\n    !particle id=1\n!physics state=:z dimensions=1\n    !particle id=2\n", 3);
    assert_text("diagnostics", player_diagnostics(player),
                "warning !physics state=:z: another !physics has the same attribute 'state'; give each system its own "
                "[duplicate-prefix]\n");
    assert_non_null(strstr(player_state(player), "$(:z;:iteration) = 5\n")); // both systems count in each frame
}

// Each system keeps its internal data if the order changes, even if two have the same prefix.
static void test_systems_keep_state_in_any_order(void **state) {
    Player *player = *state;
    static const char systems[] = "let a=((!physics state=:a dimensions=1) << (!particle id=1 velocity=8))\n"
                                  "let b=((!physics state=:b dimensions=1) << (!particle id=1 velocity=16))\n"
                                  "let y=((!physics state=:z dimensions=1) << (!particle id=1 velocity=2))\n"
                                  "let z=((!physics state=:z dimensions=1) << (!particle id=2 velocity=4))\n";
    char script[600], wanted[2000];
    snprintf(script, sizeof script, "%sa;b;y;z\n", systems);
    player_run(player, script, 6);
    snprintf(wanted, sizeof wanted, "%s", player_state(player));
    snprintf(script, sizeof script, "%s(a;b;y;z) if frame %% 2 == 0 else (b;y;a;z) if frame %% 3 else (y;z;b;a)\n",
             systems);
    petri_reset(player->session);
    player_run(player, script, 6);
    assert_text("another order", player_state(player), wanted);
}

// Systems and counters are updated in document order (spec counters.md), so later ones read the new values of earlier
// ones.
static void test_update_order(void **state) {
    Player *player = *state;
    // The system and the counter of :s write the same key, `$:s`. If its value is not a single number, the system sets
    // it to t, the time of the system.
    static const StateRow rows[] = {
        {"!counter state=:s initial=42 rate=0\n!physics state=:s dimensions=1\n", 1, "$:s = 42\n$(:s;:time) = 0\n"},
        {"!physics state=:s dimensions=1\n!counter state=:s initial=42 rate=0\n", 1, "$:s = 0\n$(:s;:time) = 0\n"},
        {"!counter state=:c initial=1\n!physics state=:s dimensions=1\n!counter state=:c initial=2 reset=1\n", 1,
         "$:c = 2\n$(:c;:time) = 0\n$:s = 0\n"},
        // Two counters with the same key, and between them a system that writes the key.
        {"!counter state=:s initial=1;1\n!physics state=:s dimensions=1\n!counter state=:s initial=2;2 reset=1\n", 1,
         "$:s = 2;2\n$(:s;:time) = 0\n"},
        {"!physics state=:s dimensions=1\n!counter state=:s rate=1;1\n", 1, "$:s = 0;0\n$(:s;:time) = 0\n"},
    };
    check_states(player, rows, COUNT_OF(rows));
}

// If the new value equals the stored one, the stored one is kept: 0 is not replaced by -0.
static void test_equal_value_is_not_replaced(void **state) {
    static const StateRow rows[] = {
        {SYSTEM "    !anchor id=1 position=(0 if frame==0 else -0)\n    !particle id=2\n", 3,
         "$:s = 0\n$(:s;1) = 0\n$(:s;1;:velocity) = 0\n$(:s;2) = 0\n$(:s;2;:velocity) = 0\n"},
    };
    check_states(*state, rows, COUNT_OF(rows));
}

static void test_steps_are_counted(void **state) {
    Player *player = *state;
    player_run(player,
               "%pragma fps 8\n!physics state=:s dimensions=1 resolution=0.03125\n    !particle id=1\n"
               "!physics state=:t dimensions=1\n    !particle id=1\n",
               1);
    assert_int_equal(last_frame(player->session).physics_steps, 0);
    player_step(player, 1);
    assert_int_equal(last_frame(player->session).physics_steps, 5);
}

static void test_step_limit(void **state) {
    Player *player = *state;
    player_run(player, "!physics state=:s dimensions=1 resolution=1e-9\n", 2);
    assert_true(last_frame(player->session).physics_steps <= 1000000);
    assert_non_null(strstr(player_diagnostics(player), "[step-limit]"));
}

TEST_GROUP(scene_particles) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_first_frames),
        PLAYER_TEST(test_anchors_are_stored_once_simulated),
        PLAYER_TEST(test_particles_appear_and_vanish),
        PLAYER_TEST(test_vanished_particle_leaves_shared_keys),
        PLAYER_TEST(test_changed_run_restarts_system),
        PLAYER_TEST(test_time_attribute),
        PLAYER_TEST(test_absent_system_keeps_state),
        PLAYER_TEST(test_several_systems),
        PLAYER_TEST(test_systems_keep_state_in_any_order),
        PLAYER_TEST(test_update_order),
        PLAYER_TEST(test_equal_value_is_not_replaced),
        PLAYER_TEST(test_steps_are_counted),
        PLAYER_TEST(test_step_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
