// test_seed_clock.c: `time`, `resolution`, `run`, `speed_of_light` and the simulation clock in scripts.
#include "cases.h"

#include <math.h>

#define SYSTEM(attributes)                                                                                             \
    "!physics state=:s dimensions=1 " attributes "\n !particle id=:a velocity=1\n !constant force=2\n"

static void test_system_stores_its_clocks_in_the_state(void **state) {
    (void)state;
    static const Case cases[] = {
        {"frame 0", SYSTEM(""), 0, "$=0 :last=0 :clock=0 :run=0 :iteration=0 a=none", 0},
        {"frame 3", SYSTEM(""), 3, "$=0 :last=3 :clock=3 :run=0 :iteration=3 a'=7 a=15", 0},
        {"any clock", SYSTEM("time=100+2*time resolution=2"), 3, "$=100 :last=106 :clock=6 :iteration=3 a'=13", 0},
        {"time defaults to the global time", SYSTEM("time=null"), 3, ":last=3 :clock=3", 0},
        {"the beat (tempo 120)", SYSTEM("time=beat resolution=tempo/60/fps"), 3, ":last=6 :clock=6 a'=13 a=54", 0},
        {"a malformed time", SYSTEM("time=1;2"), 3, ":last=3 :clock=3", "bad-attribute"},
        {"a malformed resolution", SYSTEM("resolution=\"x\""), 3, ":clock=3 a'=7 a=15", "bad-attribute"},
        {"nan as resolution: the default", SYSTEM("resolution=nan"), 3, ":clock=3 a'=7 a=15", "bad-attribute"},
        {"an engine clock of another rate", "%pragma fps 2\n" SYSTEM(""), 3, ":last=1.5 :clock=1.5 a'=4 a=4.5", 0},
    };
    CHECK_CASES(cases);
}

static void test_resolution_limits_the_length_of_a_step(void **state) {
    (void)state;
    static const Case cases[] = {
        // p = v0 t + 2 d² m (m + 1) / 2 after m steps of length d: one step of 1, two of 1/2, or four of 1/4.
        {"1", SYSTEM("resolution=1"), 1, "a'=3 a=3 :clock=1", 0},
        {"1/2: as many steps as needed", SYSTEM("resolution=0.5"), 1, "a'=3 a=2.5 :clock=1", 0},
        {"1/4", SYSTEM("resolution=0.25"), 1, "a'=3 a=2.25 :clock=1", 0},
        {"delta below resolution: in lockstep with time", SYSTEM("resolution=1e6"), 3, "a'=7 a=15 :clock=3",
         "long-resolution"},
        {"a last step that is shorter", SYSTEM("resolution=0.75"), 1, "a'=3 a=2.625 :clock=1", 0},
        {"iterations count frames", SYSTEM("resolution=0.25"), 2, ":iteration=2 :clock=2", 0},
    };
    CHECK_CASES(cases);
}

// The seed's example: with a resolution of 1/60 at 30 frames per second, each frame takes two steps.
static void test_two_steps(void **state) {
    (void)state;
    for (int k = 1; k <= 6; k++) {
        World world;
        world_open(&world, 60.0 / k, SYSTEM("resolution=1/60"));
        for (int frame = 0; frame < 20; frame++) {
            world_to(&world, frame);
            assert_int_equal(last_frame(world.session).physics_steps, frame ? k : 0);
        }
        world_close(&world);
    }
    World world;
    world_open(&world, 60, SYSTEM(""));
    world_to(&world, 30);
    assert_int_equal(last_frame(world.session).physics_steps, 1);
    EXPECT(&world, ":s;:clock", world_number(&world, ":s;:clock"));
    EXPECT_NEAR(&world, ":s;:clock", 1e-15, 0.5);
    world_close(&world);
}

// In real time, a frame takes one step of `resolution`, or two after hundreds of fast frames. The simulation clock
// falls behind, and the particles follow that clock.
static void test_real_time(void **state) {
    (void)state;
    World world;
    PetriOptions options = petri_default_options();
    options.fps = 200;
    options.realtime = true;
    world_open_with(&world, options, SYSTEM("resolution=1/1024"));
    for (int frame = 1; frame <= 8; frame++) {
        world_to(&world, frame);
        assert_int_equal(last_frame(world.session).physics_steps, 1);
        // The step after a late frame may be shorter than `resolution` but not longer.
        double clock = world_number(&world, ":s;:clock");
        assert_true(clock > 0 && clock <= frame / 1024.0);
        EXPECT_NEAR(&world, ":s;:a;:velocity", 1e-12, 1 + 2 * clock);
        assert_true(world_number(&world, ":s;:last") - world_number(&world, ":s") >= frame * 0.004);
    }
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

#define CLOCK(expression) SYSTEM("time=(" expression ")")

static void test_odd_clocks(void **state) {
    (void)state;
    static const Case cases[] = {
        {"paused", CLOCK("frame if frame < 3 else 2"), 6, ":last=2 :clock=2 :iteration=6 a'=5 a=8", 0},
        {"continues after a pause", CLOCK("frame if frame < 3 else frame-4 if frame > 6 else 2"), 8,
         ":last=4 :clock=4 a'=9 a=24", 0},
        {"backwards: no step, the clock stands", CLOCK("10-frame"), 5, "$=10 :last=5 :clock=0 :iteration=5 a=none", 0},
        {"backwards, then continues", CLOCK("(0;1;2;-8;-7)[frame]"), 4, ":last=-7 :clock=3 a'=7 a=15", 0},
        {"nan: that frame is skipped", CLOCK("(0;1;2;nan;4)[frame]"), 3, ":last=2 :clock=2 :iteration=2 a=8",
         "invalid-system"},
        {"nan: continues in the next frame", CLOCK("(0;1;2;nan;4)[frame]"), 4,
         ":last=4 :clock=4 :iteration=3 a'=9 a=24", "invalid-system"},
        {"infinite", CLOCK("(0;1;2;inf;3)[frame]"), 4, ":last=3 :clock=3", "invalid-system"},
        {"nan from the start", CLOCK("nan"), 3, "$=none :run=none a=none", "invalid-system"},
        {"a clock that starts below 0", CLOCK("frame-5"), 2, "$=-5 :last=-3 :clock=2", 0},
    };
    CHECK_CASES(cases);
}

static void test_system_restarts_when_run_changes(void **state) {
    (void)state;
    static const Case cases[] = {
        {"floored", SYSTEM("run=-2.5"), 2, ":run=-3 :clock=2", 0},
        {"0 by default", SYSTEM(""), 2, ":run=0", 0},
        {"the same floor: the same run", SYSTEM("run=3+0.1*frame"), 4, ":run=3 :clock=4 :iteration=4", 0},
        // In the frame in which `run` changes, the step starts from the attributes.
        {"starts again", SYSTEM("run=(frame >= 3)"), 3, "$=3 :run=1 :clock=1 :iteration=0 :last=3 a'=3 a=3", 0},
        {"continues after the restart", SYSTEM("run=(frame >= 3)"), 5,
         "$=3 :run=1 :clock=3 :iteration=2 :last=5 a'=7 a=15", 0},
        {"run=time/interval", SYSTEM("run=time/4"), 7, "$=4 :run=1 :clock=4 :iteration=3 a'=9", 0},
        {"run=time/interval", SYSTEM("run=time/4"), 8, "$=8 :run=2 :clock=1 :iteration=0 a'=3 a=3", 0},
        {"back to an old number is also a change", SYSTEM("run=(frame == 2)"), 3,
         "$=3 :run=0 :clock=1 :iteration=0 a'=3", 0},
        {"ease begins again",
         "!physics state=:s dimensions=1 run=(frame >= 3)\n !particle id=:a\n !constant force=2 ease=4\n", 4, "a'=0.5",
         0},
        {"a position that has changed since",
         "!physics state=:s dimensions=1 run=(frame >= 3)\n !particle id=:a position=frame\n", 4, "a=3", 0},
        {"abandoned: entries of removed particles are removed",
         "!physics state=:s dimensions=1 time=(frame if frame < 3 else 2) run=(frame >= 3)\n"
         " !particle id=:a\n !anchor id=:b\n",
         3, "a=none a'=none b=0", 0},
        {"not finite: 0", SYSTEM("run=inf"), 2, ":run=0 :clock=2", 0},
        {"nan: 0", SYSTEM("run=nan"), 2, ":run=0 :clock=2", "bad-attribute"},
        {"malformed: 0", SYSTEM("run=1;2"), 2, ":run=0 :clock=2", "bad-attribute"},
        {"huge", SYSTEM("run=1e300"), 2, ":run=1e300 :clock=2", 0},
    };
    CHECK_CASES(cases);
}

#define LIGHT(limit)                                                                                                   \
    "!physics state=:s dimensions=2 " limit "\n !particle id=:a force=3;4\n !particle id=:b mass=0 velocity=30;40\n"

static void test_speed_of_light(void **state) {
    (void)state;
    static const Case cases[] = {
        {"none", LIGHT(""), 1, "a'=3;4", 0},
        {"below it", LIGHT("speed_of_light=5"), 1, "a'=3;4 b'=30;40", 0},
        {"limited", LIGHT("speed_of_light=2.5"), 1, "a'=1.5;2 a=1.5;2 b'=30;40", 0},
        {"again and again", LIGHT("speed_of_light=2.5"), 9, "a'=1.5;2", 0},
        {"0: no limit", LIGHT("speed_of_light=0"), 1, "a'=3;4", 0},
        {"below 0: no limit", LIGHT("speed_of_light=-1"), 1, "a'=3;4", 0},
        {"infinite: no limit", LIGHT("speed_of_light=inf"), 1, "a'=3;4", 0},
        {"nan: no limit", LIGHT("speed_of_light=nan"), 1, "a'=3;4", "bad-attribute"},
        {"malformed: no limit", LIGHT("speed_of_light=1;2"), 1, "a'=3;4", "bad-attribute"},
    };
    CHECK_CASES(cases);
}

// `ease` uses the simulation clock.
static void test_ease_runs_on_the_clock(void **state) {
    (void)state;
    static const Case cases[] = {
        {"time runs at double speed",
         "!physics state=:s dimensions=1 time=2*time resolution=2\n !particle id=:a force=1 ease=8\n", 3, "a'=1.5", 0},
        {"steps of 1/2 within a frame",
         "!physics state=:s dimensions=1 resolution=0.5\n !particle id=:a force=1 ease=4\n", 2, "a'=0.375", 0},
    };
    CHECK_CASES(cases);
}

TEST_GROUP(seed_clock) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_system_stores_its_clocks_in_the_state),
        cmocka_unit_test(test_resolution_limits_the_length_of_a_step),
        cmocka_unit_test(test_two_steps),
        cmocka_unit_test(test_real_time),
        cmocka_unit_test(test_odd_clocks),
        cmocka_unit_test(test_system_restarts_when_run_changes),
        cmocka_unit_test(test_speed_of_light),
        cmocka_unit_test(test_ease_runs_on_the_clock),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
