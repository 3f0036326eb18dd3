// test_seed_state.c: several systems and counters; particles and systems that appear and disappear; feedback from the
// state; results that are not finite.
#include "cases.h"

static void test_several_systems(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "!physics state=:s dimensions=1\n !particle id=:a velocity=1\n"
               "!physics state=:s;:t dimensions=2 time=2*time resolution=2\n !particle id=:a velocity=1;2\n"
               "!physics state=7;\"x\" dimensions=3 run=5\n !particle id=:a velocity=1;2;3\n"
               "!other\n !physics state=:inner dimensions=1\n  !particle id=:a\n");
    world_to(&world, 3);
    EXPECT(&world, ":s;:a", 3);
    EXPECT(&world, ":s;:clock", 3);
    EXPECT(&world, ":s;:t;:a", 6, 12);
    EXPECT(&world, ":s;:t;:clock", 6);
    EXPECT(&world, "7;'x';:a", 3, 6, 9);
    EXPECT(&world, "7;'x';:run", 5);
    EXPECT_ABSENT(&world, ":inner"); // only top-level nodes are systems
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

// All keys of a system begin with its prefix.
static void test_all_keys(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               P1 " !particle id=:a\n !anchor id=:b\n !group\n  !particle id=:c;:d\n !collision\n"
                  "!particle id=:outside velocity=3\n!anchor id=:out\n!constant force=1\n");
    world_to(&world, 2);
    assert_string_equal(world_state(&world),
                        "$:s = 0\n"
                        "$(:s;:a) = 0\n$(:s;:a;:velocity) = 0\n"
                        "$(:s;:b) = 0\n$(:s;:b;:velocity) = 0\n"
                        "$(:s;:c;:d) = 0\n$(:s;:c;:d;:velocity) = 0\n"
                        "$(:s;:clock) = 2\n$(:s;:iteration) = 2\n$(:s;:last) = 2\n$(:s;:run) = 0\n");
    world_close(&world);
}

// Two systems with the same prefix use the same keys in turn. This is reported once. Each of them advances the
// iteration count.
static void test_shared_prefix(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               P1 " !particle id=:a velocity=1\n" P1 " !particle id=:b velocity=2\n !anchor id=:c position=frame\n");
    world_to(&world, 3);
    EXPECT(&world, ":s;:a", 3);
    EXPECT(&world, ":s;:iteration", 7);
    EXPECT(&world, ":s;:clock", 3);
    EXPECT(&world, ":s;:c", 3);
    EXPECT_REPORTED(&world, "duplicate-prefix");
    world_close(&world);
}

// Counters with different rates. One of them is the time of a system. The script reads values of the previous frame.
static void test_counters_can_drive_a_system(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "let T=$:turn or 0\n"
               "!counter state=:turn rate=2\n"
               "!counter state=:slow;1 rate=0.5 initial=10\n"
               "!counter state=:low rate=-1 minimum=-2\n"
               "!counter state=:pair rate=1;-2\n"
               "!physics state=:s dimensions=1 time=T resolution=2\n"
               " !particle id=:a velocity=1\n"
               " !anchor id=:b position=$(:slow;1) or -1\n");
    for (int frame = 0; frame < 6; frame++) {
        world_to(&world, frame);
        EXPECT(&world, ":turn", 2.0 * frame);
        EXPECT(&world, ":slow;1", 10 + 0.5 * frame);
        EXPECT(&world, ":low", frame < 2 ? -frame : -2);
        if (frame == 0) // the counter is new, so its value is `initial`
            EXPECT(&world, ":pair", 0);
        else
            EXPECT(&world, ":pair", frame, -2.0 * frame);
        EXPECT(&world, ":s;:clock", frame ? 2.0 * (frame - 1) : 0);
        EXPECT(&world, ":s;:b", frame ? 10 + 0.5 * (frame - 1) : -1);
        if (frame > 1)
            EXPECT(&world, ":s;:a", 2.0 * (frame - 1));
    }
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

// The script computes a spring force from the position in the state. With steps of length 1, the period is 6.
static void test_force_can_depend_on_the_last_position(void **state) {
    (void)state;
    static const double positions[] = {0, -8, -8, 0, 8, 8};
    World world;
    world_open(&world, 1, "let P=$(:s;:a)\n" P1 " !particle id=:a position=8 force=-(8 if P == null else P)\n");
    for (int frame = 1; frame < 30; frame++) {
        world_to(&world, frame);
        EXPECT(&world, ":s;:a", positions[(frame - 1) % 6]);
    }
    world_close(&world);
}

// A script reads the clock of the previous frame. An anchor of one system follows a particle of another.
static void test_feedback_between_systems(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               P1 " !particle id=:a velocity=1\n"
                  "!physics state=:t dimensions=2\n !anchor id=:b position=$(:s;:a) or 0;$(:s;:clock) or 0\n");
    for (int frame = 1; frame < 5; frame++) {
        world_to(&world, frame);
        EXPECT(&world, ":t;:b", frame - 1, frame - 1);
    }
    world_close(&world);
}

static void test_come_and_go(void **state) {
    (void)state;
    static const Case cases[] = {
        {"removed with its keys", P1 " if frame < 3\n  !particle id=:a velocity=1\n !particle id=:b velocity=1\n", 3,
         "a=none a'=none b=3", 0},
        {"back: from its attributes", P1 " if frame != 3\n  !particle id=:a position=10 velocity=1\n", 5, "a=12", 0},
        {"an anchor goes", P1 " if frame < 3\n  !anchor id=:a\n !particle id=:b\n", 3, "a=none a'=none", 0},
        {"another order, another group: the same particle",
         P1 " if frame%2\n  !particle id=:a velocity=1\n  !particle id=:b velocity=2\n"
            " else\n  !particle id=:b velocity=2\n  !group\n   !particle id=:a velocity=1\n",
         6, "a=6 b=12", 0},
        {"an anchor that becomes a particle starts from where it was",
         P1 " if frame < 3\n  !anchor id=:a position=frame\n else\n  !particle id=:a position=9 force=1\n", 4,
         "a=5 a'=2", 0},
        {"a particle that becomes an anchor",
         P1 " if frame < 3\n  !particle id=:a velocity=1\n else\n"
            "  !anchor id=:a position=9 velocity=4\n",
         3, "a=9 a'=0", 0},
        {"a paused system continues and catches up",
         "if frame < 3 or frame > 5\n !physics state=:s dimensions=1\n  !particle id=:a velocity=1\n", 5,
         "a=2 :last=2 :iteration=2", 0},
        {"a paused system continues and catches up",
         "if frame < 3 or frame > 5\n !physics state=:s dimensions=1\n  !particle id=:a velocity=1\n", 6,
         "a=6 :last=6 :clock=6 :iteration=3", 0},
        {"a frame that is skipped keeps the particles",
         "!physics state=:s dimensions=(1 if frame != 3 else 0)\n !particle id=:a velocity=1\n", 4, "a=4 :iteration=3",
         "invalid-system"},
        {"other dimensions: from the attributes",
         "!physics state=:s dimensions=1+(frame >= 3)\n !particle id=:a position=5 velocity=1\n", 2, "a=7", 0},
        {"other dimensions: from the attributes",
         "!physics state=:s dimensions=1+(frame >= 3)\n !particle id=:a position=5 velocity=1\n", 3, "a=6;6", 0},
        {"a force that comes and goes", P1 " !particle id=:a\n if frame == 2\n  !constant force=1\n", 4, "a'=1 a=3", 0},
        {"all particles gone, the clock runs on", P1 " if frame < 3\n  !particle id=:a\n", 5,
         "a=none :clock=5 :iteration=5", 0},
    };
    CHECK_CASES(cases);
}

// Values that are not finite are not stored, and do not affect other particles.
static void test_not_finite(void **state) {
    (void)state;
    static const Case cases[] = {
        {"position", P2 " !particle id=:a position=inf;0 velocity=1;2\n", 2, "a=none a'=1;2", "not-finite"},
        {"velocity", P2 " !particle id=:a velocity=1;-inf\n", 2, "a=none a'=none", "not-finite"},
        {"nan in a vector", P2 " !particle id=:a position=1;nan velocity=1\n", 2, "a=none a'=1;1", "not-finite"},
        {"force: as it was", P2 " !particle id=:a velocity=1;2 force=inf;0\n", 2, "a=2;4 a'=1;2", "not-finite"},
        {"an anchor", P1 " !anchor id=:a position=inf\n !particle id=:b\n", 2, "a=none a'=0 b=0", "not-finite"},
        {"others are not affected",
         P1 " !particle id=:a position=inf radius=9 charge=1\n"
            " !particle id=:b position=1 radius=9 charge=1\n !particle id=:c position=3 radius=0.5 mass=4\n"
            " !gravity\n !collision\n !electrostatic\n !adhesion\n !distance from=:a to=:b max=1\n",
         1, "a=none", "not-finite"},
        {"an overflow in the run", P1 " !particle id=:a velocity=1e308\n", 3, "a=1e308 a'=1e308", 0},
    };
    CHECK_CASES(cases);
    // The other particles move the same way with and without a particle that is not finite.
    World with, without;
#define REST                                                                                                           \
    " !particle id=:b position=1 radius=9 charge=1\n !particle id=:c position=3 radius=0.5 mass=4\n"                   \
    " !gravity\n !collision\n !electrostatic\n !adhesion\n"
    world_open(&with, 1, P1 " !particle id=:a position=nan radius=9 charge=1\n" REST);
    world_open(&without, 1, P1 REST);
    world_to(&with, 3);
    world_to(&without, 3);
    EXPECT(&with, ":s;:b", world_number(&without, ":s;:b"));
    EXPECT(&with, ":s;:c", world_number(&without, ":s;:c"));
    world_close(&with);
    world_close(&without);
}

// A script that is loaded again starts at frame 0 with the old state, so the time goes back.
static void test_reloaded_script_keeps_the_state(void **state) {
    (void)state;
    World world;
    const char *script = P1 " !particle id=:a velocity=1\n";
    world_open(&world, 1, script);
    world_to(&world, 5);
    EXPECT(&world, ":s;:a", 5);
    assert_int_equal(petri_load_text(world.session, "world.fl", script, PETRI_NUL_TERMINATED), PETRI_OK);
    world_to(&world, 3);
    EXPECT(&world, ":s;:a", 8);
    EXPECT(&world, ":s;:clock", 8);
    EXPECT(&world, ":s;:last", 3);
    world_close(&world);
}

TEST_GROUP(seed_state) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_several_systems),
        cmocka_unit_test(test_all_keys),
        cmocka_unit_test(test_shared_prefix),
        cmocka_unit_test(test_counters_can_drive_a_system),
        cmocka_unit_test(test_force_can_depend_on_the_last_position),
        cmocka_unit_test(test_feedback_between_systems),
        cmocka_unit_test(test_come_and_go),
        cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_reloaded_script_keeps_the_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
