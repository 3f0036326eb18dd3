// test_seed_attributes.c: every attribute of every node inside `!physics`: default, one number for a vector, wrong
// shapes, nan, null and ease. Runs a scene with different values of the attribute and compares the states.
#include "world.h"

// Bodies for which every attribute matters, because they overlap, move, and are charged. The node under test is added
// after them.
static const char bodies[] = " !particle id=:a position=0;0 velocity=1;2 radius=1 mass=2 charge=3\n"
                             " !particle id=:b position=1;0.5 velocity=-1;0.5 radius=0.75 charge=-2\n"
                             " !anchor id=:c position=0.5;1 radius=0.5 mass=3 charge=1\n";

// Drops reports of nodes that do nothing here, because the test uses many such values on purpose.
static void drop_lints(World *world) {
    int kept = 0;
    for (int i = 0; i < world->reported_count && i < WORLD_MAX_REPORTED; i++)
        if (!strstr("barrier-side missing-index no-bounds no-charge no-radius", world->reported[i].code))
            world->reported[kept++] = world->reported[i];
    world->reported_count = kept;
}

// Returns the state after frame 4 of the scene with the node under test, and checks the diagnostics. The caller frees
// it.
static char *state_with(const char *node, const char *attribute, const char *codes) {
    World world;
    char *script = text_of(P2 "%s %s %s\n", bodies, node, attribute);
    world_open(&world, 16, script);
    world_to(&world, 4);
    drop_lints(&world);
    check_reported(&world, codes, script, __FILE__, __LINE__);
    // The message names the node and the attribute.
    for (int i = 0; i < world.reported_count; i++) {
        char kind[32];
        snprintf(kind, sizeof kind, "%.*s", (int)strcspn(node, " "), node);
        assert_ptr_equal(strstr(world.reported[i].text, kind), world.reported[i].text);
        size_t len = strcspn(attribute, "=");
        char name[32];
        snprintf(name, sizeof name, "%.*s", (int)len, attribute);
        assert_non_null(strstr(world.reported[i].text, name));
        assert_int_equal(world.reported[i].level, PETRI_WARNING);
    }
    char *text = text_of("%s", world_state(&world));
    world_close(&world);
    free(script);
    return text;
}

// Checks that the state with `attribute`=`value` equals the state with `attribute`=`other` (or differs from it, if
// `same` is false). An empty value means that the attribute is omitted.
static void compare_states(const char *node, const char *attribute, const char *value, const char *other, bool same,
                           const char *codes) {
    char *first = text_of("%s%s%s", *value ? attribute : "", *value ? "=" : "", value);
    char *second = text_of("%s%s%s", *other ? attribute : "", *other ? "=" : "", other);
    char *found = state_with(node, first, codes), *wanted = state_with(node, second, "");
    if ((strcmp(found, wanted) == 0) != same) {
        print_error("%s: '%s' and '%s' should be %s\n%s\n%s", node, first, second, same ? "the same" : "different",
                    found, wanted);
        fail();
    }
    free(first);
    free(second);
    free(found);
    free(wanted);
}

typedef struct Row {
    const char *node;
    const char *attribute;
    const char *default_value; // the default, which must act like omitting the attribute; "": there is none to test
    const char *other;         // a value that gives a different state
} Row;

static const Row floats[] = {
    {"!constant force=1;2 acceleration=0;-3", "strength", "1", "-2"},
    {"!constant force=1;2", "ease", "0", "0.125"},
    {"!random", "strength", "1", "0.5"},
    {"!random", "ease", "0", "0.125"},
    {"!field direction=1;2", "strength", "1", "3"},
    {"!field direction=1;2", "ease", "0", "0.125"},
    {"!distance from=:a to=:b fixed=3", "strength", "1", "3"},
    {"!distance from=:a to=:b fixed=3", "power", "1", "1.5"},
    {"!distance from=:a to=:b fixed=3", "ease", "0", "0.125"},
    {"!distance from=:a to=:b", "fixed", "", "0"},
    {"!distance from=:a to=:b", "minimum", "", "4"},
    {"!distance from=:a to=:b", "min", "", "4"},
    {"!distance from=:a to=:b", "maximum", "", "0.25"},
    {"!distance from=:a to=:b", "max", "", "0.25"},
    {"!collision", "strength", "1", "30"},
    {"!collision", "power", "1", "1.5"},
    {"!collision", "ease", "0", "0.125"},
    {"!collision", "max_distance", "0", "1"},
    {"!gravity", "strength", "1", "5"},
    {"!gravity", "ease", "0", "0.125"},
    {"!gravity", "max_distance", "0", "1"},
    {"!electrostatic", "strength", "1", "0.5"},
    {"!electrostatic", "ease", "0", "0.125"},
    {"!electrostatic", "max_distance", "0", "1"},
    {"!adhesion", "overlap", "0.25", "0.75"},
    {"!adhesion", "strength", "1", "4"},
    {"!adhesion", "ease", "0", "0.125"},
    {"!adhesion", "max_distance", "0", "1"},
    {"!drag flow=0;1", "strength", "1", "0.125"},
    {"!drag", "ease", "0", "0.125"},
    {"!buoyancy", "density", "1", "2"},
    {"!buoyancy", "strength", "1", "0.5"},
    {"!buoyancy", "ease", "0", "0.125"},
    {"!barrier position=0;0.5 normal=1;1", "restitution", "1", "0.5"},
    {"!barrier position=-3;0 normal=1;1 min=9", "power", "1", "0.5"},
    {"!barrier position=-3;0 normal=1;1 min=9", "strength", "1", "0.5"},
    {"!barrier position=-3;0 normal=1;1 min=9", "ease", "0", "0.125"},
    {"!barrier position=-3;0 normal=1;1", "fixed", "", "0"},
    {"!barrier position=-3;0 normal=1;1", "minimum", "", "5"},
    {"!barrier position=-3;0 normal=1;1", "min", "", "5"},
    {"!barrier position=-3;0 normal=1;1", "maximum", "", "0.5"},
    {"!barrier position=-3;0 normal=1;1", "max", "", "0.5"},
};

// Particles and anchors, and forces that use all attributes of particles.
static const Row body_floats[] = {
    {"!particle id=:p position=1;1 radius=1 charge=1 force=5;5", "mass", "1", "3"},
    {"!particle id=:p position=1;1 force=5;5", "radius", "0", "1"},
    {"!particle id=:p position=1;1 radius=1", "charge", "0", "-1"},
    {"!particle id=:p position=1;1 force=5;5", "ease", "0", "0.125"},
    {"!anchor id=:p position=1;1 radius=1 charge=1", "mass", "1", "3"},
    {"!anchor id=:p position=1;1", "radius", "0", "1"},
    {"!anchor id=:p position=1;1 radius=1", "charge", "0", "-1"},
};

// Invalid values of an attribute that must be one number, and values that count as missing.
static void check_float(const Row *row) {
    static const char *const wrong[] = {"1;2", "\"3\"", ":x;1", "!node", "nan", "uniform(:x)[..3]"};
    if (*row->default_value)
        compare_states(row->node, row->attribute, row->default_value, "", true, "");
    compare_states(row->node, row->attribute, "null", "", true, "");
    compare_states(row->node, row->attribute, "uniform(:x)", "", true, ""); // a stream counts as null
    compare_states(row->node, row->attribute, row->other, "", false, "");
    for (size_t i = 0; i < COUNT_OF(wrong); i++)
        compare_states(row->node, row->attribute, wrong[i], "", true, "bad-attribute");
}

static void test_malformed_number_counts_as_the_default(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(floats); i++)
        check_float(&floats[i]);
}

static void test_body_floats(void **state) {
    (void)state;
    for (size_t i = 0; i < COUNT_OF(body_floats); i++) {
        // The forces come first, so the node under test is still the last one in the script.
        Row row = body_floats[i];
        char *node = text_of("!collision\n !gravity\n !electrostatic\n !drag\n !constant force=1;1\n %s", row.node);
        char *found[4];
        const char *const values[] = {"", row.default_value, row.other, "null"};
        for (int k = 0; k < 4; k++) {
            char *attribute = text_of("%s%s%s", *values[k] ? row.attribute : "", *values[k] ? "=" : "", values[k]);
            found[k] = state_with(node, attribute, "");
            free(attribute);
        }
        assert_string_equal(found[1], found[0]);
        assert_string_equal(found[3], found[0]);
        if (strcmp(found[2], found[0]) == 0)
            fail_msg("%s: %s=%s makes no difference", row.node, row.attribute, row.other);
        static const char *const wrong[] = {"1;2", "\"3\"", "!node", "nan"};
        for (size_t k = 0; k < COUNT_OF(wrong); k++) {
            World world;
            char *script = text_of(P2 "%s %s %s=%s\n", bodies, node, row.attribute, wrong[k]);
            world_open(&world, 16, script);
            world_to(&world, 4);
            assert_string_equal(world_state(&world), found[0]);
            EXPECT_REPORTED(&world, "bad-attribute");
            assert_non_null(strstr(world.reported[0].text, row.attribute));
            assert_non_null(strstr(world.reported[0].text, "id=:p"));
            world_close(&world);
            free(script);
        }
        for (int k = 0; k < 4; k++)
            free(found[k]);
        free(node);
    }
}

// Vector attributes: the default, one number for both components, and two numbers.
static const Row vectors[] = {
    {"!constant acceleration=1;0", "force", "0", "2;-1"},
    {"!constant force=1;0", "acceleration", "0", "2;-1"},
    {"!field strength=2", "direction", "0", "2;-1"},
    {"!drag strength=0.25", "flow", "0", "2;-1"},
    {"!buoyancy density=2", "gravity", "0;-1", "2;-1"},
    {"!barrier normal=1;2", "position", "0", "0.5;1"},
    {"!particle id=:p velocity=1;1 radius=1", "position", "0", "2;-1"},
    {"!particle id=:p position=1;1 radius=1", "velocity", "0", "2;-1"},
    {"!particle id=:p position=1;1", "force", "0", "2;-1"},
    {"!anchor id=:p radius=1", "position", "0", "2;-1"},
};

static void test_malformed_vector_counts_as_the_default(void **state) {
    (void)state;
    static const char *const wrong[] = {"1;2;3", "\"x\"", "1;\"x\"", "!node", "..9"};
    for (size_t i = 0; i < COUNT_OF(vectors); i++) {
        const Row *row = &vectors[i];
        compare_states(row->node, row->attribute, row->default_value, "", true, "");
        compare_states(row->node, row->attribute, "null", "", true, "");
        compare_states(row->node, row->attribute, row->other, "", false, "");
        compare_states(row->node, row->attribute, "3", "3;3", true, "");
        for (size_t k = 0; k < COUNT_OF(wrong); k++)
            compare_states(row->node, row->attribute, wrong[k], "", true, "bad-attribute");
    }
}

// A force that is eased in over 4 has 0, 1/4, 2/4 and 3/4 of its strength in the steps that begin at clock 0, 1, 2 and
// 3, and its full strength after that. The particles are new in each frame, so their velocity is the result of one
// step.
static void test_ease_is_linear(void **state) {
    (void)state;
    static const char *const nodes[] = {
        "!constant force=1;2 acceleration=2;1",
        "!random strength=2",
        "!field direction=1;2",
        "!distance from=:a;frame to=:b;frame fixed=3",
        "!distance from=:a;frame to=:b;frame max=0.5 power=2",
        "!collision strength=3",
        "!gravity strength=3",
        "!electrostatic strength=3",
        "!adhesion strength=3",
        "!drag strength=1/64 flow=8",
        "!buoyancy strength=3",
        "!barrier position=-3;0 normal=0;1 min=9",
        "!barrier position=0;-9 normal=0;1 max=8",
    };
    for (size_t i = 0; i < COUNT_OF(nodes); i++) {
        World plain, eased;
        World *const worlds[] = {&plain, &eased};
        for (int k = 0; k < 2; k++) {
            char *script = text_of(P2 " !particle id=:a;frame position=0;1 radius=1 mass=2 charge=3\n"
                                      " !particle id=:b;frame position=1;1 radius=0.75 charge=-2\n %s%s\n",
                                   nodes[i], k ? " ease=4" : "");
            world_open(worlds[k], 1, script);
            free(script);
        }
        for (int frame = 1; frame <= 6; frame++) {
            double full[WORLD_MAX_NUMBERS], factor = frame > 4 ? 1 : (frame - 1) / 4.0;
            char key[64];
            snprintf(key, sizeof key, ":s;:a;%d;:velocity", frame);
            world_to(&plain, frame);
            world_to(&eased, frame);
            assert_int_equal(world_numbers(&plain, key, full), 2);
            if (full[0] == 0 && full[1] == 0)
                fail_msg("%s does nothing", nodes[i]);
            EXPECT_NEAR(&eased, key, 4e-16 * hypot(full[0], full[1]), full[0] * factor, full[1] * factor);
        }
        world_close(&plain);
        world_close(&eased);
    }
}

TEST_GROUP(seed_attributes) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_malformed_number_counts_as_the_default),
        cmocka_unit_test(test_body_floats),
        cmocka_unit_test(test_malformed_vector_counts_as_the_default),
        cmocka_unit_test(test_ease_is_linear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
