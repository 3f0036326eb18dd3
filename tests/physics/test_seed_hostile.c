// test_seed_hostile.c: hostile input must be processed in bounded time and report each error once. The state contains
// only finite numbers.
#include "cases.h"

// Runs a script for some frames. Checks that no frame fails, that all stored numbers are finite, and that at most
// `max_reported` diagnostics are reported.
static void check_survives(const char *script, int64_t frame, int max_reported) {
    World world;
    world_open(&world, 60, script);
    for (int64_t at = 0; at <= frame; at++) {
        world_to(&world, at);
        if (strstr(world_state(&world), "nan") || strstr(world_state(&world), "inf"))
            fail_msg("%s\n%s", script, world_state(&world));
    }
    if (world.reported_count > max_reported) {
        print_error("%.400s\n", script);
        world_print_reported(&world);
        fail();
    }
    world_close(&world);
}

static const char *const odd_numbers[] = {"nan",   "inf",    "-inf",   "-1",     "0", "-0",
                                          "1e308", "-1e308", "5e-324", "1e-200", ":x"};

// Extreme values for every number of every node. (NaN and an invalid normal are reported.)
static void test_odd_numbers(void **state) {
    (void)state;
    static const char *const nodes[][2] = {
        {"!particle id=:p position=1;2 velocity=1 radius=1 charge=1 force=1",
         "mass radius charge ease position velocity force"},
        {"!anchor id=:p position=1;2 radius=1 charge=1", "mass radius charge ease position velocity force"},
        {"!constant force=1", "force acceleration strength ease"},
        {"!random", "strength ease"},
        {"!field direction=1", "direction strength ease"},
        {"!distance from=:a to=:b fixed=3", "fixed power strength ease"},
        {"!distance from=:a to=:b", "min max minimum maximum"},
        {"!distance from=:a to=:b max=0.5 power=0.5", "min power strength"},
        {"!collision", "power strength ease max_distance"},
        {"!gravity", "strength ease max_distance theta"},
        {"!electrostatic", "strength ease max_distance theta"},
        {"!adhesion", "overlap strength ease max_distance"},
        {"!drag", "flow strength ease"},
        {"!buoyancy", "gravity density strength ease"},
        {"!barrier normal=1;2 min=3 max=2",
         "position normal restitution min max minimum maximum fixed power strength ease"},
    };
    for (size_t i = 0; i < COUNT_OF(nodes); i++) {
        for (const char *at = nodes[i][1]; *at; at += strspn(at, " ")) {
            size_t len = strcspn(at, " ");
            for (size_t k = 0; k < COUNT_OF(odd_numbers); k++) {
                char *script = text_of(P2 " !particle id=:a radius=1 charge=1 velocity=-1;2\n"
                                          " !particle id=:b position=1;1 radius=1 mass=2 charge=-3\n"
                                          " !collision\n !gravity\n !electrostatic\n !drag\n"
                                          " %s %.*s=%s\n",
                                       nodes[i][0], (int)len, at, odd_numbers[k]);
                check_survives(script, 4, 1);
                free(script);
            }
            at += len;
        }
    }
    for (size_t k = 0; k < COUNT_OF(odd_numbers); k++) {
        static const char *const attributes[] = {"speed_of_light", "run", "dimensions", "time"};
        for (size_t i = 0; i < COUNT_OF(attributes); i++) {
            char *script = text_of("!physics state=:s dimensions=2 %s=%s\n !particle id=:a velocity=1 force=1\n",
                                   attributes[i], odd_numbers[k]);
            // NaN for dimensions is reported twice: as a bad attribute and as an invalid system.
            check_survives(script, 4, 2);
            free(script);
        }
    }
}

static void test_too_many_dimensions_are_rejected(void **state) {
    (void)state;
    static const Case cases[] = {
        {"2.5 is 2", "!physics state=:s dimensions=2.5\n !particle id=:a velocity=1;2\n", 1, "a=1;2", 0},
        {"0", "!physics state=:s dimensions=0\n !particle id=:a velocity=1;2\n", 1, "$=none a=none", "invalid-system"},
        {"-1", "!physics state=:s dimensions=-1\n !particle id=:a velocity=1;2\n", 1, "$=none a=none",
         "invalid-system"},
        {"null", "!physics state=:s dimensions=null\n !particle id=:a\n", 1, "$=none a=none", "invalid-system"},
        {"1e9", "!physics state=:s dimensions=1e9\n !particle id=:a\n", 2, "a=none", "invalid-system"},
        {"1e9, much inside",
         "!physics state=:s dimensions=1e9\n for i in ..100\n  !particle id=i position=i\n !collision\n"
         " !drag\n !barrier normal=1\n",
         2, "a=none", "invalid-system"},
        {"1e9 + 1", "!physics state=:s dimensions=1e9+1\n", 2, "$=none", "invalid-system"},
        {"1e300", "!physics state=:s dimensions=1e300\n !particle id=:a\n", 2, "$=none", "invalid-system"},
        {"inf", "!physics state=:s dimensions=inf\n !particle id=:a\n", 2, "$=none", "invalid-system"},
    };
    CHECK_CASES(cases);
    // An empty system with 1e9 dimensions stores no vectors. It may run or be skipped, with at most one message.
    check_survives("!physics state=:s dimensions=1e9\n", 2, 1);
    // A thousand dimensions work.
    World world;
    world_open(&world, 1,
               "!physics state=:s dimensions=1000\n !particle id=:a velocity=..1000 radius=1\n"
               " !particle id=:b position=1 radius=20\n !collision\n !gravity\n !drag\n !barrier normal=1\n");
    world_to(&world, 2);
    EXPECT_REPORTED(&world, "");
    const char *value = world_find(&world, ":s;:a");
    int elements = 1;
    for (; *value != '\n'; value++)
        elements += *value == ';';
    assert_int_equal(elements, 1000);
    world_close(&world);
}

// With an extremely small resolution, a frame ends after a million steps. This is reported once.
static void test_endless_steps(void **state) {
    (void)state;
    World world;
    world_open(&world, 1, "!physics state=:s dimensions=1 resolution=1e-12\n !particle id=:a velocity=1\n");
    for (int frame = 1; frame <= 3; frame++) {
        world_to(&world, frame);
        assert_int_equal(last_frame(world.session).physics_steps, 1000000);
        EXPECT_NEAR(&world, ":s;:clock", 1e-15, frame * 1e-6);
        EXPECT_NEAR(&world, ":s;:a", 1e-15, frame * 1e-6);
        EXPECT(&world, ":s;:last", frame);
    }
    EXPECT_REPORTED(&world, "step-limit");
    world_close(&world);
    // A step that is too small to change the clock is not taken.
    world_open(&world, 1,
               "!physics state=:s dimensions=1 time=5+time resolution=5e-324\n !particle id=:a velocity=1\n");
    world_to(&world, 4);
    assert_int_equal(last_frame(world.session).physics_steps, 0);
    EXPECT(&world, ":s;:clock", 0);
    EXPECT(&world, ":s;:last", 9);
    EXPECT_REPORTED(&world, "step-limit");
    world_close(&world);
}

// Clocks stay finite: a step that would make a clock infinite is not taken.
static void test_clock_overflow(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "!physics state=:s dimensions=1 time=(-1.7e308 if frame==0 else 1.7e308) resolution=1e308\n"
               " !particle id=:a velocity=0\n");
    world_to(&world, 3);
    EXPECT(&world, ":s;:clock", 1e308);
    EXPECT(&world, ":s;:last", 1.7e308);
    EXPECT(&world, ":s;:a", 0);
    EXPECT_REPORTED(&world, "step-limit");
    world_close(&world);
}

// If the time jumps, the maximum number of steps is taken and the rest of the time is skipped. The next frame is
// normal.
static void test_time_jump_stops_at_the_step_limit(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "!physics state=:s dimensions=1 time=(0;1;1e9;1e9+1;1e9+2)[frame]\n !particle id=:a velocity=1\n");
    world_to(&world, 2);
    assert_int_equal(last_frame(world.session).physics_steps, 1000000);
    EXPECT(&world, ":s;:clock", 1000001);
    EXPECT(&world, ":s;:last", 1e9);
    EXPECT(&world, ":s;:a", 1000001);
    world_to(&world, 4);
    assert_int_equal(last_frame(world.session).physics_steps, 1);
    EXPECT(&world, ":s;:a", 1000003);
    EXPECT_REPORTED(&world, "step-limit");
    world_close(&world);
    static const Case cases[] = {
        {"in one step", "!physics state=:s dimensions=1 time=frame*1e9 resolution=1e9\n !particle id=:a velocity=1\n",
         2, "a=2000000000 :clock=2000000000", 0},
        {"back by 1e9", "!physics state=:s dimensions=1 time=(0;1;-1e9;1-1e9)[frame]\n !particle id=:a velocity=1\n", 3,
         "a=2 :clock=2", 0},
    };
    CHECK_CASES(cases);
}

// The forces of 1e5 nodes of one kind on the same two particles add up.
static void test_many_forces(void **state) {
    (void)state;
    static const struct {
        const char *node;
        double force; // force of a single node on `:a`
    } rows[] = {
        {"!distance from=:a to=:b max=3", 1},
        {"!distance from=:b to=:a fixed=5", -1},
        {"!collision", -0.5},
        {"!gravity", 0.0625},
        {"!electrostatic", -0.0625},
        {"!constant force=0.25", 0.25},
        {"!field direction=0.25", 0.25},
        {"!barrier position=-1 normal=1 min=2", 1},
        {"!group\n   !constant force=1\n", 0},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        char *script =
            text_of(P1 " !particle id=:a charge=1 radius=0.5\n !particle id=:b position=4 charge=1 radius=4\n"
                       " for i in ..100000\n  %s\n",
                    rows[i].node);
        World world;
        world_open(&world, 1, script);
        world_to(&world, 1);
        double force = rows[i].force;
        if (strstr(rows[i].node, "gravity") || strstr(rows[i].node, "electro"))
            force = copysign(1 / (4.5 * 4.5), force); // the radii overlap, so the force is constant
        EXPECT_NEAR(&world, ":s;:a;:velocity", 1e-6 * fabs(force * 1e5), force * 1e5);
        EXPECT_REPORTED(&world, strstr(rows[i].node, "fixed") ? "unstable-force" : ""); // a stiff bundle of springs
        world_close(&world);
        free(script);
    }
}

// Links in a cycle, from a particle to itself, and in both directions.
static void test_links_may_form_cycles(void **state) {
    (void)state;
    static const Case cases[] = {
        {"to itself", P1 " !particle id=:a position=2\n !distance from=:a to=:a fixed=5\n", 2, "a=2 a'=0",
         "self-distance"},
        {"both ways",
         P1 " !particle id=:a\n !particle id=:b position=4\n !distance from=:a to=:b fixed=2\n"
            " !distance from=:b to=:a fixed=2\n",
         1, "a'=4 b'=-4", 0},
        {"a ring",
         P2 " !particle id=:a\n !particle id=:b position=4;0\n !particle id=:c position=2;0\n"
            " !distance from=:a to=:b max=2\n !distance from=:b to=:c max=1\n !distance from=:c to=:a max=1\n",
         1, "a'=3;0 b'=-3;0 c'=0;0", 0},
    };
    CHECK_CASES(cases);
}

// Coincident particles have no direction, so no force acts between them. They still act on other particles.
static void test_same_place(void **state) {
    (void)state;
    for (int n = 1; n <= 5; n += 2) {
        char *script = text_of("!physics state=:s dimensions=%d\n"
                               " for i in ..40\n  !particle id=i position=3 radius=1+i charge=1 mass=2\n"
                               " !collision strength=1e3\n !gravity\n !electrostatic\n !adhesion\n !drag\n"
                               " for i in ..39\n  !distance from=i to=i+1 fixed=5\n",
                               n);
        World world;
        world_open(&world, 60, script);
        world_to(&world, 20);
        for (int i = 0; i < 40; i++) {
            char key[64];
            double v[WORLD_MAX_NUMBERS];
            snprintf(key, sizeof key, ":s;%d;:velocity", i);
            assert_int_equal(world_numbers(&world, key, v), n);
            for (int k = 0; k < n; k++)
                NEAR(v[k], 0, 0);
            snprintf(key, sizeof key, ":s;%d", i);
            assert_int_equal(world_numbers(&world, key, v), n);
            for (int k = 0; k < n; k++)
                NEAR(v[k], 3, 0);
        }
        EXPECT_REPORTED(&world, "");
        world_close(&world);
        free(script);
    }
    // Particles so close that the inverse of the distance overflows.
    check_survives(
        P2 " !particle id=:a charge=1 radius=1\n !particle id=:b position=5e-324;0 charge=1 radius=1\n !collision\n"
           " !gravity\n !electrostatic\n !adhesion\n !distance from=:a to=:b fixed=3\n",
        5, 0);
    check_survives(
        P2 " !particle id=:a charge=1\n !particle id=:b position=1e-160;1e-170 charge=1\n !gravity\n !electrostatic\n",
        5, 0);
}

// Returns a script with nested groups. Forces of the top group act on a particle in the innermost group.
static char *nested(int wraps, int rounds) {
    size_t size = 4096 + (size_t)rounds * 32;
    char *lets = malloc(size);
    assert_non_null(lets);
    size_t len = 0;
    for (int i = 0; i < rounds; i++)
        len += (size_t)snprintf(lets + len, size - len, "let g=wrap(g, %d)\n", wraps);
    char *script = text_of("func wrap(inner, n)\n (!group << (wrap(inner, n-1) if n > 1 else inner))\n"
                           "let g=(!particle id=:deep radius=1)\n%s" P1
                           " g\n !particle id=:top radius=1 position=1.5\n !collision\n !constant force=1\n"
                           " !barrier position=-100 normal=1\n",
                           lets);
    free(lets);
    return script;
}

static void test_deep_groups(void **state) {
    (void)state;
    char *script = nested(400, 25); // a depth of 1e4
    World world;
    world_open(&world, 1, script);
    world_to(&world, 1);
    EXPECT(&world, ":s;:deep;:velocity", 0.5);
    EXPECT(&world, ":s;:top;:velocity", 1.5);
    EXPECT_REPORTED(&world, "");
    world_close(&world);
    free(script);
    // A depth of 1e6 exceeds the height limit of trees. The tree is rejected with one message, and the rest of the
    // script works.
    script = nested(400, 2500);
    world_open(&world, 1, script);
    world_to(&world, 1);
    assert_int_equal(world.reported_count, 1);
    EXPECT(&world, ":s;:top;:velocity", 1);
    world_close(&world);
    free(script);
}

static void test_many_groups(void **state) {
    (void)state;
    World world;
    world_open(&world, 1, P1 " for i in ..1000000\n  !group\n !particle id=:a\n !constant force=1\n");
    world_to(&world, 1);
    EXPECT(&world, ":s;:a;:velocity", 1);
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

// State keys with a million elements.
static void test_long_keys(void **state) {
    (void)state;
    static const char *const scripts[] = {
        P1 " !particle id=..1000000 velocity=1\n !particle id=:a velocity=1\n !distance from=..1000000 to=:a min=9\n",
        P1 " !particle id=:a velocity=1\n !distance from=..1000000 to=:a min=9\n",
        "!physics state=..1000000 dimensions=1\n !particle id=:a\n" P1 " !particle id=:a velocity=1\n",
    };
    for (size_t i = 0; i < COUNT_OF(scripts); i++) {
        World world;
        world_open(&world, 1, scripts[i]);
        world_to(&world, 1);
        // In the first script, the two particles are pushed apart.
        if (i > 0)
            EXPECT(&world, ":s;:a", 1);
        assert_true(world.reported_count <= 1);
        world_close(&world);
    }
}

TEST_GROUP(seed_hostile) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_odd_numbers),
        cmocka_unit_test(test_too_many_dimensions_are_rejected),
        cmocka_unit_test(test_endless_steps),
        cmocka_unit_test(test_clock_overflow),
        cmocka_unit_test(test_time_jump_stops_at_the_step_limit),
        cmocka_unit_test(test_many_forces),
        cmocka_unit_test(test_links_may_form_cycles),
        cmocka_unit_test(test_same_place),
        cmocka_unit_test(test_deep_groups),
        cmocka_unit_test(test_many_groups),
        cmocka_unit_test(test_long_keys),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
