// test_seed_singles.c: forces on single particles in scripts, with results calculated by hand from the seed's formulas.
#include "cases.h"

static void test_constant_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"force, one dimension", P1 " !particle id=:a\n !constant force=3\n", 1, "a=3 a'=3", 0},
        {"force over mass", P2 " !particle id=:a mass=4\n !constant force=2;-4\n", 1, "a=0.5;-1 a'=0.5;-1", 0},
        {"acceleration whatever the mass", P2 " !particle id=:a mass=4\n !constant acceleration=1;-2\n", 1, "a'=1;-2",
         0},
        {"both apply separately", P2 " !particle id=:a mass=4\n !constant force=4;0 acceleration=0;-1\n", 1, "a'=1;-1",
         0},
        {"strength multiplies both", P2 " !particle id=:a mass=4\n !constant force=4;0 acceleration=0;-1 strength=3\n",
         1, "a'=3;-3", 0},
        {"three dimensions", P3 " !particle id=:a\n !constant force=1;2;3\n", 1, "a'=1;2;3", 0},
        {"one number for all of five dimensions", P5 " !particle id=:a\n !constant force=2\n", 1, "a'=2;2;2;2;2", 0},
        {"nothing given", P2 " !particle id=:a\n !constant\n", 1, "a=0;0 a'=0;0", 0},
        {"all particles", P1 " !particle id=:a\n !particle id=:b mass=2\n !anchor id=:c\n !constant force=2\n", 1,
         "a'=2 b'=1 c'=0 c=0", 0},
        {"velocity first, then position with the new velocity",
         P1 " !particle id=:a position=10 velocity=5\n"
            " !constant force=-2\n",
         2, "a'=1 a=14", 0},
        {"the sum of all forces",
         P1 " !particle id=:a mass=2 force=1\n !constant force=4\n !constant acceleration=-1\n", 1, "a'=1.5", 0},
    };
    CHECK_CASES(cases);
}

static void test_field_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"in proportion to the charge",
         P2 " !particle id=:a charge=2\n !particle id=:b charge=4\n !field direction=1;-2\n", 1, "a'=2;-4 b'=4;-8", 0},
        {"negative charges the other way", P2 " !particle id=:a charge=-2\n !field direction=1;-2\n", 1, "a'=-2;4", 0},
        {"no charge is the default", P2 " !particle id=:a\n !field direction=1;-2\n", 1, "a'=0;0", "no-charge"},
        {"the direction is not normalised", P2 " !particle id=:a charge=2\n !field direction=3;4 strength=0.5\n", 1,
         "a'=3;4", 0},
        {"acceleration is q / m", P1 " !particle id=:a charge=3 mass=8\n !field direction=2\n", 1, "a'=0.75", 0},
        {"three dimensions", P3 " !particle id=:a charge=1\n !field direction=1;2;3 strength=-1\n", 1, "a'=-1;-2;-3",
         0},
        {"five dimensions, one number", P5 " !particle id=:a charge=1\n !field direction=2\n", 1, "a'=2;2;2;2;2", 0},
        {"no direction", P1 " !particle id=:a charge=1\n !field\n", 1, "a'=0", 0},
        {"anchors stay", P1 " !anchor id=:a charge=1 position=3\n !field direction=1\n", 1, "a=3 a'=0", 0},
    };
    CHECK_CASES(cases);
}

static void test_drag_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"one dimension: no cross-section", P1 " !particle id=:a radius=2 velocity=2\n !drag strength=0.25\n", 1,
         "a'=1 a=1", 0},
        {"two: radius", P2 " !particle id=:a radius=2 velocity=3;4\n !drag strength=1/16\n", 1, "a'=1.125;1.5", 0},
        {"three: its square", P3 " !particle id=:a radius=2 velocity=0;3;4\n !drag strength=1/32\n", 1,
         "a'=0;1.125;1.5", 0},
        {"five: its fourth power", P5 " !particle id=:a radius=2 velocity=3;0;4;0;0\n !drag strength=1/128\n", 1,
         "a'=1.125;0;1.5;0;0", 0},
        {"twice the speed, four times the force", P2 " !particle id=:a radius=2 velocity=6;8\n !drag strength=1/64\n",
         1, "a'=4.125;5.5", 0},
        {"force over mass", P2 " !particle id=:a radius=2 velocity=3;4 mass=2\n !drag strength=1/16\n", 1,
         "a'=2.0625;2.75", 0},
        {"relative to the flow", P2 " !particle id=:a radius=2 velocity=4;4\n !drag strength=1/16 flow=1;0\n", 1,
         "a'=2.125;1.5", 0},
        {"one number as flow", P2 " !particle id=:a radius=2 velocity=4;5\n !drag strength=1/16 flow=1\n", 1,
         "a'=2.125;2.5", 0},
        {"the flow takes along what rests", P1 " !particle id=:a radius=1\n !drag strength=0.25 flow=2\n", 1, "a'=1",
         0},
        {"no radius, no drag", P1 " !particle id=:a velocity=2\n !drag strength=0.25\n", 1, "a'=2", "no-radius"},
        {"limited: at most stops", P2 " !particle id=:a radius=1 velocity=3;4\n !drag strength=1e9\n", 1, "a'=0;0", 0},
        {"limited: at most moves with the medium",
         P2 " !particle id=:a radius=1 velocity=3;4 mass=8\n"
            " !drag strength=1e9 flow=1;-1\n",
         3, "a'=1;-1", 0},
        {"no mass", P1 " !particle id=:a radius=1 velocity=2 mass=0\n !drag\n", 2, "a'=2 a=4", 0},
    };
    CHECK_CASES(cases);
}

static void test_buoyancy_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"one dimension: radius", P1 " !particle id=:a radius=2\n !buoyancy density=1/8\n", 1, "a'=-0.75", 0},
        {"two: its square, without pi", P2 " !particle id=:a radius=2\n !buoyancy density=1/8\n", 1, "a'=0;-0.5", 0},
        {"three: its cube; as dense as the fluid", P3 " !particle id=:a radius=2\n !buoyancy density=1/8\n", 1,
         "a'=0;0;0", 0},
        {"three: heavier sinks", P3 " !particle id=:a radius=2 mass=2\n !buoyancy density=1/8\n", 1, "a'=0;0;-0.5", 0},
        {"three: lighter rises", P3 " !particle id=:a radius=2 mass=0.5\n !buoyancy density=1/8\n", 1, "a'=0;0;1", 0},
        {"five: down the last axis", P5 " !particle id=:a radius=2\n !buoyancy density=1/8\n", 1, "a'=0;0;0;0;3", 0},
        {"density 1 is the default", P2 " !particle id=:a radius=2\n !buoyancy\n", 1, "a'=0;3", 0},
        {"any gravity", P2 " !particle id=:a radius=2\n !buoyancy density=1/8 gravity=3;4\n", 1, "a'=1.5;2", 0},
        {"one number as gravity", P2 " !particle id=:a radius=2\n !buoyancy density=1/8 gravity=-2\n", 1, "a'=-1;-1",
         0},
        {"no gravity at all", P2 " !particle id=:a radius=2\n !buoyancy gravity=0\n", 1, "a'=0;0", 0},
        {"strength", P2 " !particle id=:a radius=2\n !buoyancy density=1/8 strength=4\n", 1, "a'=0;-2", 0},
        {"a negative density", P2 " !particle id=:a radius=1\n !buoyancy density=-1\n", 1, "a'=0;-2", 0},
        {"no radius", P2 " !particle id=:a mass=2\n !buoyancy\n", 1, "a'=0;0", "no-radius"},
        {"no mass", P2 " !particle id=:a mass=0 radius=2\n !buoyancy\n", 1, "a'=0;0", 0},
    };
    CHECK_CASES(cases);
}

// The forces of `!random` equal normal(prefix;run;iteration). The script evaluates this stream as well, and anchors
// have the expected velocities.
static void test_random_force_equals_the_normal_stream(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "let N=normal(:s;0;frame) M=normal(:s;0;frame;0)\n"
               "!physics state=:s dimensions=2\n"
               " !particle id=:a;frame mass=2\n"
               " !anchor id=:w position=0.5*N[0;1]\n"
               " !particle id=:b;frame\n"
               " !anchor id=:x position=N[2;3]\n"
               " !group\n"
               "  !particle id=:c;frame\n"
               "  !anchor id=:y position=M[0;1]*3+N[4;5]\n"
               "  !random strength=3\n"
               " !random\n");
    for (int frame = 1; frame < 4; frame++) {
        char key[64];
        double wanted[2];
        static const char *const pairs[][2] = {{":a", ":s;:w"}, {":b", ":s;:x"}};
        world_to(&world, frame);
        for (size_t i = 0; i < COUNT_OF(pairs); i++) {
            assert_int_equal(world_numbers(&world, pairs[i][1], wanted), 2);
            snprintf(key, sizeof key, ":s;%s;%d;:velocity", pairs[i][0], frame);
            EXPECT(&world, key, wanted[0], wanted[1]);
        }
    }
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

// The seed of a `!random` depends on the number of `!random` nodes before it. Those in its group and those in enclosing
// groups are counted, but not those in other groups.
static void test_random_seeds(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "let N=normal(:s;7;frame) M=normal(:s;7;frame;0)\n"
               "!physics state=:s dimensions=1 run=7.9\n"
               " !random strength=0.5\n"
               " !particle id=:a;frame\n"
               " !anchor id=:w position=N[0]*0.5\n"
               " !group\n"
               "  !particle id=:b;frame\n"
               "  !anchor id=:x position=M[0]*2+N[1]*0.5\n"
               "  !random strength=2\n"
               " !group\n"
               "  !particle id=:c;frame mass=0\n"
               "  !particle id=:d;frame\n"
               "  !anchor id=:y position=M[1]*2+N[3]*0.5\n"
               "  !random strength=2\n");
    world_to(&world, 2);
    EXPECT(&world, ":s;:a;2;:velocity", world_number(&world, ":s;:w"));
    EXPECT(&world, ":s;:b;2;:velocity", world_number(&world, ":s;:x"));
    EXPECT(&world, ":s;:c;2;:velocity", 0);
    EXPECT(&world, ":s;:d;2;:velocity", world_number(&world, ":s;:y"));
    world_close(&world);
}

// Each step of a frame uses different variates: items continue after those of the previous step.
static void test_random_steps(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "let N=normal(:s;0;frame)\n"
               "!physics state=:s dimensions=1 resolution=0.5\n"
               " !particle id=:a;frame\n"
               " !particle id=:b;frame\n"
               " !anchor id=:w position=N[0]*0.5+N[2]*0.5\n"
               " !anchor id=:x position=N[1]*0.5+N[3]*0.5\n"
               " !random\n");
    world_to(&world, 1);
    EXPECT(&world, ":s;:a;1;:velocity", world_number(&world, ":s;:w"));
    EXPECT(&world, ":s;:b;1;:velocity", world_number(&world, ":s;:x"));
    world_close(&world);
}

// The variates have mean 0, variance 1, and the fourth moment of a normal distribution, 3.
static void test_random_is_normal(void **state) {
    (void)state;
    enum { COUNT = 4000 };
    World world;
    world_open(&world, 1, "!physics state=:s dimensions=2\n for i in ..4000\n  !particle id=i\n !random\n");
    world_to(&world, 1);
    double sums[5] = {0};
    for (int i = 0; i < COUNT; i++) {
        char key[64];
        double v[WORLD_MAX_NUMBERS];
        // The lines are in order, so the test need not search for each of 8000 keys.
        static const char *at;
        at = i ? at : world_state(&world);
        snprintf(key, sizeof key, "\n$(:s;%d;:velocity) = ", i);
        at = strstr(at, key);
        assert_non_null(at);
        at += strlen(key);
        assert_int_equal(read_numbers(at, v, NULL), 2);
        sums[0] += v[0] * v[1];
        for (int power = 1; power <= 4; power++)
            sums[power] += pow(v[0], power) + pow(v[1], power);
    }
    NEAR(sums[0] / COUNT, 0, 0.1); // the components are independent
    NEAR(sums[1] / (2 * COUNT), 0, 0.05);
    NEAR(sums[2] / (2 * COUNT), 1, 0.06);
    NEAR(sums[3] / (2 * COUNT), 0, 0.2);
    NEAR(sums[4] / (2 * COUNT), 3, 0.4);
    world_close(&world);
}

TEST_GROUP(seed_singles) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_constant_equals_the_seeds_formula),
        cmocka_unit_test(test_field_equals_the_seeds_formula),
        cmocka_unit_test(test_drag_equals_the_seeds_formula),
        cmocka_unit_test(test_buoyancy_equals_the_seeds_formula),
        cmocka_unit_test(test_random_force_equals_the_normal_stream),
        cmocka_unit_test(test_random_seeds),
        cmocka_unit_test(test_random_steps),
        cmocka_unit_test(test_random_is_normal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
