// test_seed_reports.c: diagnostics of systems: each error is reported once, with the node, its id and the value.
#include "world.h"

typedef struct Report {
    const char *script;
    const char *code;
    const char *parts[4]; // strings that the message must contain
} Report;

static void check_report(const Report *row) {
    World world;
    world_open(&world, 1, row->script);
    world_to(&world, 5);
    check_reported(&world, row->code, row->script, __FILE__, __LINE__);
    assert_int_equal(petri_diagnostic_count(world.session, PETRI_WARNING), world.reported_count);
    for (int i = 0; i < 4 && row->parts[i]; i++)
        if (!strstr(world.reported[0].text, row->parts[i]))
            fail_msg("'%s' does not say %s", world.reported[0].text, row->parts[i]);
    world_close(&world);
}

static void check_reports(const Report *rows, size_t count) {
    for (size_t i = 0; i < count; i++)
        check_report(&rows[i]);
}

static void test_malformed_attribute_is_reported_with_node_and_value(void **state) {
    (void)state;
    static const Report rows[] = {
        {P2 " !particle id=:a position=1;2;3\n", "bad-attribute", {"!particle", ":a", "position", "1;2;3"}},
        {P2 " !particle id=:a;1 velocity=\"fast\"\n", "bad-attribute", {"!particle", ":a;1", "velocity", "fast"}},
        {P2 " !particle id=:a force=1;\"x\"\n", "bad-attribute", {"!particle", ":a", "force", "1;'x'"}},
        {P2 " !particle id=:a mass=1;2\n", "bad-attribute", {"!particle", ":a", "mass", "1;2"}},
        {P2 " !particle id=:a radius=:big;1\n", "bad-attribute", {"radius", ":big;1"}},
        {P2 " !particle id=:a charge=nan\n", "bad-attribute", {"charge", "nan"}},
        {P2 " !particle id=:a ease=!node\n", "bad-attribute", {"ease", "node"}},
        {P2 " !anchor id=:b position=1;2;3\n", "bad-attribute", {"!anchor", ":b", "position", "1;2;3"}},
        {P2 " !constant strength=1;2\n", "bad-attribute", {"!constant", "strength", "1;2"}},
        {P2 " !field direction=..5\n", "bad-attribute", {"!field", "direction", "0;1;2;3;4"}},
        {P2 " !field direction=..5000\n", "bad-attribute", {"!field", "direction", "5000"}},
        {P1 " !group\n  !collision power=1;2\n", "bad-attribute", {"!collision", "power"}},
        {"!physics state=:s dimensions=2 run=:x;1\n", "bad-attribute", {"!physics", "run", ":x;1"}},
        {"!physics state=:s dimensions=2 time=\"noon\"\n", "bad-attribute", {"!physics", "time", "noon"}},
        {P1 " !particle id=:a mass=1;2\n !particle id=:b mass=1;2\n", "bad-attribute bad-attribute", {":a"}},
        {P1 " !particle id=:a mass=1;2 radius=1;2\n", "bad-attribute bad-attribute", {":a"}},
    };
    check_reports(rows, COUNT_OF(rows));
}

// An attribute with a different invalid value in each frame is reported once.
static void test_changing_values(void **state) {
    (void)state;
    static const Report rows[] = {
        {P2 " !particle id=:a mass=frame;1\n", "bad-attribute", {"!particle", ":a", "mass"}},
        {P2 " !particle id=:a force=frame;1;2\n", "bad-attribute", {"!particle", ":a", "force"}},
        {P2 " !group\n  !drag flow=1;2;frame\n", "bad-attribute", {"!drag", "flow"}},
        {"!physics state=:s dimensions=1 run=1;frame\n", "bad-attribute", {"!physics", ":s", "run"}},
    };
    check_reports(rows, COUNT_OF(rows));
}

// Symbols are numbers, but huge ones, so that they cannot be meant as numbers.
static void test_symbols_as_numbers(void **state) {
    (void)state;
    static const Report rows[] = {
        {P2 " !particle id=:a force=:x\n", "bad-attribute divergence", {"!particle", ":a", "force", ":x"}},
        {P1 " !particle id=:a force=:x\n", "bad-attribute divergence", {"force", "one number", ":x"}},
        {P3 " !particle id=:a position=1;:x;2\n", "bad-attribute", {"position", "1;:x;2"}},
        {P2 " !particle id=:a mass=:x\n", "bad-attribute", {"mass", ":x"}},
        {P2 " !anchor id=:a radius=:x\n", "bad-attribute", {"!anchor", "radius", ":x"}},
        {P2 " !constant strength=:x\n", "bad-attribute", {"!constant", "strength", ":x"}},
        {P2 " !barrier normal=:x\n", "bad-normal", {"!barrier", "normal"}},
        {P2 " !collision max_distance=:x\n", "bad-attribute", {"max_distance", ":x"}},
        {"!physics state=:s dimensions=2 time=:x\n", "bad-attribute", {"!physics", "time", ":x"}},
        {"!physics state=:s dimensions=2 resolution=:x\n",
         "bad-attribute invalid-system",
         {"!physics", "resolution", ":x"}},
        // A run may have a name, a counter may store one, and a huge number is not a symbol.
        {"!counter state=:c initial=:x\n", "", {NULL}},
        {"!physics state=:s dimensions=2 run=:x\n", "", {NULL}},
        {P1 " !particle id=:a mass=1e308\n !constant force=-1.6e308\n", "", {NULL}},
    };
    check_reports(rows, COUNT_OF(rows));
}

// A symbol is reported and used as its number, as in Flitter: a mass below 0 counts as 0, so no force acts.
static void test_symbols_are_used_as_numbers(void **state) {
    (void)state;
    World world;
    world_open(&world, 1, P1 " !particle id=:a velocity=2 mass=:m\n !constant force=1\n !constant acceleration=1\n");
    world_to(&world, 2);
    EXPECT(&world, ":s;:a;:velocity", 2);
    world_close(&world);
}

// Vectors that are not finite. A vector that the frame does not use is not reported.
static void test_not_finite(void **state) {
    (void)state;
    static const Report rows[] = {
        {P2 " !particle id=:a position=0/0;1\n", "not-finite", {":a", "position=nan;1", "frame 0"}},
        {P2 " !particle id=:a position=1/0\n", "not-finite", {"position=inf;inf", "frame 0"}},
        {P1 " !particle id=:a velocity=-1/0\n", "not-finite", {"velocity=-inf", "frame 0"}},
        {P5 " !particle id=:a force=(0 if frame < 3 else 0/0)\n", "not-finite", {":a", "force=nan", "frame 3"}},
        {P2 " !anchor id=:a position=(1 if frame < 2 else 1/0);1\n", "not-finite", {"!anchor", "inf;1", "frame 2"}},
        {P2 " !group\n  !constant acceleration=0/0\n", "not-finite", {"!constant", "acceleration=nan"}},
        {P2 " !barrier position=1/0;0 normal=1;0\n", "not-finite", {"!barrier", "position=inf;0"}},
        {P2 " for i in ..3\n  !particle id=i force=0/0\n", "not-finite", {"id=0", "force"}},
        // Only the first frames use the position of a particle, and anchors have no force.
        {P2 " !particle id=:a position=(1 if frame < 3 else 0/0) velocity=(1 if frame < 3 else 1/0)\n",
         "changing-start changing-start",
         {NULL}},
        {P2 " !anchor id=:a force=0/0 velocity=1/0\n", "", {NULL}},
        {P2 " !particle id=:a position=1e308 force=-1e308\n", "", {NULL}},
    };
    check_reports(rows, COUNT_OF(rows));
}

// A particle that is not finite for a while starts as soon as its position is finite, and disturbs no other one.
static void test_not_finite_for_a_while(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               P1 " !particle id=:a position=(0/0 if frame < 3 else 7) charge=1\n"
                  " !particle id=:b position=8 charge=1\n"
                  " if frame < 3\n  !electrostatic\n");
    world_to(&world, 2);
    EXPECT(&world, ":s;:b", 8);
    EXPECT_ABSENT(&world, ":s;:a");
    world_to(&world, 4);
    EXPECT(&world, ":s;:b", 8);
    EXPECT(&world, ":s;:a", 7);
    world_close(&world);
}

// Keys of the state that two particles or two systems share, in either order.
static void test_colliding_keys(void **state) {
    (void)state;
    static const Report rows[] = {
        {P2 " !particle id=:a\n !particle id=:a;:velocity\n", "colliding-keys", {":a;:velocity", "position"}},
        {P2 " !particle id=:a;:velocity\n !particle id=:a\n", "colliding-keys", {"id=:a:", "velocity"}},
        {P2 " !anchor id=:a\n !group\n  !particle id=:a;:velocity\n", "colliding-keys", {":a;:velocity"}},
        {P1 " !particle id=:a\n!physics state=:s;:a dimensions=2\n", "colliding-keys", {"state=:s;:a", "$(:s;:a)"}},
        {"!physics state=:s;:a dimensions=2\n" P1 " !particle id=:a\n", "colliding-keys", {"state=:s:", "$(:s;:a)"}},
        {P1 " !particle id=:a;:b\n!physics state=:s;:a dimensions=1\n !particle id=:b\n",
         "colliding-keys",
         {"$(:s;:a;:b)"}},
        {P1 " !particle id=:a;:clock\n!physics state=:s;:a dimensions=1\n", "colliding-keys", {"$(:s;:a;:clock)"}},
        // Longer keys are different keys.
        {P1 " !particle id=:a;:speed\n !particle id=:a\n!physics state=:s;:b dimensions=1\n !particle id=:a\n",
         "",
         {NULL}},
        {P1 " !particle id=:velocity\n !particle id=:velocity;1\n", "", {NULL}},
    };
    check_reports(rows, COUNT_OF(rows));
}

static void test_unknown_name_is_reported_with_a_suggestion(void **state) {
    (void)state;
    static const Report rows[] = {
        {P1 " !particle id=:a raduis=1\n", "unknown-attribute", {"!particle", ":a", "'raduis'", "'radius'"}},
        {P1 " !particle id=:a acceleration=1\n", "unknown-attribute", {"!particle", "'acceleration'"}},
        {P1 " !anchor id=:a postion=1\n", "unknown-attribute", {"!anchor", "'postion'", "'position'"}},
        {P1 " !collision strenght=1\n", "unknown-attribute", {"!collision", "'strenght'", "'strength'"}},
        {P1 " !gravity max_dist=1\n", "unknown-attribute", {"!gravity", "'max_dist'"}},
        {P1 " !gravity maxdistance=1\n", "unknown-attribute", {"!gravity", "'max_distance'"}},
        {P1 " !barrier normal=1 resitution=1\n", "unknown-attribute", {"!barrier", "'resitution'", "'restitution'"}},
        {"!physics state=:s dimensions=1 speed_of_ligth=1\n", "unknown-attribute", {"!physics", "'speed_of_light'"}},
        {P1 " !partcle id=:a\n", "unknown-node", {"!partcle", "!particle"}},
        {P1 " !gravitiy\n", "unknown-node", {"!gravitiy", "!gravity"}},
        {P1 " !group\n  !colision\n", "unknown-node", {"!colision", "!collision"}},
        {P1 " !canvas\n", "unknown-node", {"!canvas"}},
        {P1 " !physics state=:t dimensions=1\n", "unknown-node", {"!physics"}},
    };
    check_reports(rows, COUNT_OF(rows));
    // An unknown name that resembles no existing one is reported without a suggestion.
    World world;
    world_open(&world, 1, P1 " !particle id=:a zzzzzzzz=1\n !qqqqqqqqqqqq\n");
    world_to(&world, 2);
    EXPECT_REPORTED(&world, "unknown-attribute unknown-node");
    for (int i = 0; i < 2; i++)
        assert_null(strstr(world.reported[i].text, "did you mean"));
    world_close(&world);
    // Nodes in the wrong place are reported.
    world_open(&world, 1, "!particle raduis=1\n!canvas size=1\n!window\n !physics\n");
    world_to(&world, 2);
    EXPECT_REPORTED(&world, "misplaced-node misplaced-node misplaced-node");
    world_close(&world);
}

static void test_missing_or_duplicate_id_is_reported(void **state) {
    (void)state;
    static const Report rows[] = {
        {P1 " !particle position=1\n", "missing-id", {"!particle", "id"}},
        {P1 " !anchor id=null\n", "missing-id", {"!anchor", "id"}},
        {P1 " !particle id=!node\n", "missing-id", {"!particle", "id"}},
        {P1 " !particle id=nan\n", "missing-id", {"!particle", "id"}},
        {P1 " !particle id=:a\n !particle id=:a\n", "duplicate-id", {"!particle", ":a"}},
        {P1 " !particle id=1;2\n !group\n  !anchor id=1;2\n", "duplicate-id", {"!anchor", "1;2"}},
        {P1 " !particle id=:a\n !distance from=:a to=:b max=1\n", "unknown-particle", {"!distance", "to", ":b"}},
        {P1 " !particle id=:b\n !distance from=:a to=:b max=1\n", "unknown-particle", {"!distance", "from", ":a"}},
        {P1 " !particle id=:b\n !distance to=:b max=1\n", "unknown-particle", {"!distance", "from"}},
        {P1 " !distance max=1\n", "unknown-particle", {"!distance"}},
        {P1 " !particle id=:b\n !distance from=:velocity to=:b max=1\n", "unknown-particle", {":velocity"}},
    };
    check_reports(rows, COUNT_OF(rows));
    // The other particles are simulated.
    World world;
    world_open(&world, 1, P1 " !particle velocity=1\n !particle id=:a velocity=2\n !particle id=:a velocity=3\n");
    world_to(&world, 2);
    EXPECT(&world, ":s;:a", 4);
    EXPECT_REPORTED(&world, "missing-id duplicate-id");
    world_close(&world);
}

// Particles whose ids collide with keys of the system are reported but simulated.
static void test_reserved_ids(void **state) {
    (void)state;
    static const char *const names[] = {":last", ":clock", ":run", ":iteration"};
    for (size_t i = 0; i < COUNT_OF(names); i++) {
        for (int anchor = 0; anchor < 2; anchor++) {
            const char *kind = anchor ? "!anchor" : "!particle";
            char *script = text_of(P2 " %s id=%s velocity=1;0 radius=1 position=1.5;0\n"
                                      " !particle id=:other radius=1\n !collision\n",
                                   kind, names[i]);
            const Report row = {script, "reserved-id", {kind, names[i]}};
            check_report(&row);
            // Two dimensions, because with one dimension the system's number under that key would be read as the
            // position.
            World world;
            char key[64];
            world_open(&world, 1, script);
            world_to(&world, 1);
            snprintf(key, sizeof key, ":s;%s;:velocity", names[i]);
            EXPECT(&world, key, anchor ? 0 : 1.5, 0);
            EXPECT(&world, ":s;:other;:velocity", -0.5, 0);
            world_close(&world);
            free(script);
        }
    }
    // Ids that only begin or end with such a name, and all other names, are valid.
    World world;
    world_open(&world, 1,
               P1 " !particle id=:last;1\n !particle id=1;:clock\n !particle id=:time\n !anchor id=\"run\"\n");
    world_to(&world, 2);
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

static void test_invalid_system_is_reported(void **state) {
    (void)state;
    static const Report rows[] = {
        {"!physics dimensions=1\n !particle id=:a\n", "invalid-system", {"!physics", "state"}},
        {"!physics state=null dimensions=1\n", "invalid-system", {"!physics", "state"}},
        {"!physics state=!node dimensions=1\n", "invalid-system", {"!physics", "state"}},
        {"!physics state=:s\n !particle id=:a\n", "invalid-system", {"!physics", ":s", "dimensions"}},
        {"!physics state=:s dimensions=null\n", "invalid-system", {":s", "dimensions"}},
        {"!physics state=:s dimensions=0\n", "invalid-system", {":s", "dimensions"}},
        {"!physics state=:s dimensions=-1\n", "invalid-system", {":s", "dimensions"}},
        {"!physics state=:s dimensions=0.99\n", "invalid-system", {":s", "dimensions"}},
        {"!physics state=:s dimensions=inf\n", "invalid-system", {":s", "dimensions"}},
        {"!physics state=:s dimensions=1 resolution=0\n", "invalid-system", {":s", "resolution"}},
        {"!physics state=:s dimensions=1 resolution=-1\n", "invalid-system", {":s", "resolution"}},
        {"!physics state=:s dimensions=1 resolution=inf\n", "invalid-system", {":s", "resolution"}},
        {"!physics state=:s dimensions=1 resolution=-inf\n", "invalid-system", {":s", "resolution"}},
        {"!physics state=:s dimensions=1 time=nan\n", "invalid-system", {":s", "time"}},
        {"!physics state=:s dimensions=1 time=-inf\n", "invalid-system", {":s", "time"}},
        {P1 "!physics state=:s dimensions=2\n", "duplicate-prefix", {"!physics", ":s"}},
        {P1 P1 P1, "duplicate-prefix", {":s"}},
    };
    check_reports(rows, COUNT_OF(rows));
    // A skipped system does not change the state.
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        if (strcmp(rows[i].code, "invalid-system") != 0)
            continue;
        World world;
        world_open(&world, 1, rows[i].script);
        world_to(&world, 3);
        assert_string_equal(world_state(&world), "");
        world_close(&world);
    }
}

// A system with invalid dimensions is skipped. The attribute itself may also be reported.
static void test_malformed_dimensions(void **state) {
    (void)state;
    static const char *const forms[] = {"\"2\"", "1;2", "nan", "!node", ":two;1"};
    for (size_t i = 0; i < COUNT_OF(forms); i++) {
        World world;
        char *script = text_of("!physics state=:s dimensions=%s\n !particle id=:a velocity=1\n", forms[i]);
        world_open(&world, 1, script);
        world_to(&world, 3);
        assert_string_equal(world_state(&world), "");
        assert_int_equal(world_count_reported(&world, "invalid-system"), 1);
        assert_true(world_count_reported(&world, "bad-attribute") <= 1);
        assert_int_equal(world.reported_count, 1 + world_count_reported(&world, "bad-attribute"));
        world_close(&world);
        free(script);
    }
}

static void test_ignored_barrier_or_theta_is_reported(void **state) {
    (void)state;
    static const Report rows[] = {
        {P1 " !barrier\n", "bad-normal", {"!barrier", "normal"}},
        {P1 " !gravity theta=0.5\n", "no-far-field", {"!gravity", "theta"}},
        {"!physics state=:s dimensions=4\n !electrostatic theta=2\n", "no-far-field", {"!electrostatic", "theta"}},
        {P2 " !barrier normal=0;0\n", "bad-normal", {"!barrier", "normal"}},
        {P2 " !barrier normal=1;inf\n", "bad-normal", {"!barrier", "normal"}},
        {P2 " !barrier normal=1;nan\n", "bad-normal", {"!barrier", "normal"}},
    };
    check_reports(rows, COUNT_OF(rows));
}

static void test_correct_system_is_not_reported(void **state) {
    (void)state;
    World world;
    world_open(
        &world, 60,
        "!physics state=:s dimensions=2 time=time resolution=1/60 run=0 speed_of_light=100\n"
        " !anchor id=:o position=0;0 velocity=0 force=1 ease=1 radius=1 mass=1 charge=1\n"
        " !particle id=:p position=5;1 velocity=1 force=1 ease=1 radius=1 mass=1 charge=1\n"
        " !group\n"
        "  !constant force=1 acceleration=1 strength=1 ease=1\n"
        "  !random strength=1 ease=1\n"
        "  !field direction=1 strength=1 ease=1\n"
        "  !distance from=:o to=:p minimum=1 min=1 maximum=2 max=2 power=1 strength=1 ease=1\n"
        "  !distance from=:o to=:p fixed=1\n"
        "  !collision power=1 strength=1 ease=1 max_distance=9\n"
        "  !gravity strength=1 ease=1 max_distance=9 theta=1\n"
        "  !electrostatic strength=1 ease=1 max_distance=9 theta=1\n"
        "  !adhesion overlap=1 strength=1 ease=1 max_distance=9\n"
        "  !drag flow=1 strength=1 ease=1\n"
        "  !buoyancy gravity=1 density=1 strength=1 ease=1\n"
        "  !barrier position=-9 normal=1 restitution=1 minimum=1 min=1 maximum=2 max=2 power=1 strength=1 ease=1\n"
        "  !barrier position=-9 normal=1 fixed=1\n");
    world_to(&world, 10);
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

TEST_GROUP(seed_reports) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_malformed_attribute_is_reported_with_node_and_value),
        cmocka_unit_test(test_changing_values),
        cmocka_unit_test(test_symbols_as_numbers),
        cmocka_unit_test(test_symbols_are_used_as_numbers),
        cmocka_unit_test(test_not_finite),
        cmocka_unit_test(test_not_finite_for_a_while),
        cmocka_unit_test(test_colliding_keys),
        cmocka_unit_test(test_unknown_name_is_reported_with_a_suggestion),
        cmocka_unit_test(test_missing_or_duplicate_id_is_reported),
        cmocka_unit_test(test_reserved_ids),
        cmocka_unit_test(test_invalid_system_is_reported),
        cmocka_unit_test(test_malformed_dimensions),
        cmocka_unit_test(test_ignored_barrier_or_theta_is_reported),
        cmocka_unit_test(test_correct_system_is_not_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
