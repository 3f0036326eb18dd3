// test_seed_pairs.c: forces between particles in scripts, with results calculated by hand from the formulas of the seed
// document (SEED.md).
#include "cases.h"

// Two particles of mass 1 in one dimension, with the given attributes.
#define PAIR(a, b, rest) P1 " !particle id=:a " a "\n !particle id=:b " b "\n " rest "\n"

static void test_collision_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"min is the sum of the radii", PAIR("radius=1", "radius=1 position=1.5", "!collision strength=4"), 1,
         "a'=-2 b'=2 a=-2 b=3.5", 0},
        {"the displacement to a power", PAIR("radius=1", "radius=1 position=1.5", "!collision strength=4 power=2"), 1,
         "a'=-1 b'=1", 0},
        {"strength and power are 1", PAIR("radius=1", "radius=1 position=1.5", "!collision"), 1, "a'=-0.5 b'=0.5", 0},
        {"over mass", PAIR("radius=1 mass=2", "radius=1 position=1.5", "!collision"), 1, "a'=-0.25 b'=0.5", 0},
        {"touching is not an overlap", PAIR("radius=1", "radius=0.5 position=1.5", "!collision"), 1, "a'=0 b'=0", 0},
        {"no radius", PAIR("", "radius=2 position=1.5", "!collision"), 1, "a'=0 b'=0", 0},
        {"an anchor pushes and stays",
         P1 " !particle id=:a radius=1\n !anchor id=:b radius=1 position=1.5\n !collision\n", 1, "a'=-0.5 b=1.5 b'=0",
         0},
        {"all pairs",
         P1 " !particle id=:a radius=1\n !particle id=:b radius=1 position=1.5\n"
            " !particle id=:c radius=1 position=3\n !collision\n",
         1, "a'=-0.5 b'=0 c'=0.5", 0},
        {"three dimensions", P3 " !particle id=:a radius=1\n !particle id=:b radius=1 position=0;0;1\n !collision\n", 1,
         "a'=0;0;-1 b'=0;0;1", 0},
        {"across five dimensions",
         P5 " !particle id=:a radius=2\n !anchor id=:b radius=2 position=1;1;1;1;0\n"
            " !collision strength=0.5\n",
         1, "a'=-0.5;-0.5;-0.5;-0.5;0", 0},
    };
    CHECK_CASES(cases);
}

static void test_gravity_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"product of masses over square of distance", PAIR("mass=2", "mass=3 position=2", "!gravity strength=4"), 1,
         "a'=3 b'=-2", 0},
        {"strength 1", PAIR("mass=2", "mass=2 position=2", "!gravity"), 1, "a'=0.5 b'=-0.5", 0},
        {"twice as far, a quarter", PAIR("mass=2", "mass=3 position=4", "!gravity strength=4"), 1, "a'=0.75 b'=-0.5",
         0},
        {"constant within the radii: 2", PAIR("mass=2 radius=2", "mass=3 radius=2 position=2", "!gravity strength=4"),
         1, "a'=0.75 b'=-0.5", 0},
        {"constant within the radii: 1", PAIR("mass=2 radius=2", "mass=3 radius=2 position=1", "!gravity strength=4"),
         1, "a'=0.75 b'=-0.5", 0},
        {"no mass", PAIR("mass=0", "mass=3 position=2", "!gravity"), 1, "a'=0 b'=0", 0},
        {"near enough", PAIR("mass=2", "mass=3 position=2", "!gravity strength=4 max_distance=2.5"), 1, "a'=3 b'=-2",
         0},
        {"too far", PAIR("mass=2", "mass=3 position=2", "!gravity strength=4 max_distance=1.5"), 1, "a'=0 b'=0", 0},
        {"as far as max_distance is too far", PAIR("mass=2", "mass=3 position=2", "!gravity max_distance=2"), 1, "a'=0",
         0},
        {"max_distance 0: no limit", PAIR("mass=2", "mass=2 position=2", "!gravity max_distance=0"), 1, "a'=0.5", 0},
        {"an anchor without mass does not attract",
         P1 " !particle id=:a\n !anchor id=:b mass=0 position=1\n"
            " !distance from=:a to=:b max=0.5\n !gravity\n",
         1, "a'=0.5", 0},
        {"two dimensions", P2 " !particle id=:a position=0;4\n !anchor id=:b mass=16\n !gravity\n", 1, "a'=0;-1", 0},
        {"three dimensions", P3 " !particle id=:a position=0;0;4\n !anchor id=:b mass=16\n !gravity\n", 1, "a'=0;0;-1",
         0},
        {"five dimensions: the square still",
         P5 " !particle id=:a position=1;1;1;1;0\n !anchor id=:b mass=8\n !gravity\n", 1, "a'=-1;-1;-1;-1;0", 0},
    };
    CHECK_CASES(cases);
}

static void test_electrostatic_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"equal signs repel", PAIR("charge=2", "charge=3 position=2", "!electrostatic strength=4"), 1, "a'=-6 b'=6", 0},
        {"two negative charges repel", PAIR("charge=-2", "charge=-3 position=2", "!electrostatic strength=4"), 1,
         "a'=-6 b'=6", 0},
        {"opposite signs attract", PAIR("charge=-2", "charge=3 position=2", "!electrostatic strength=4"), 1,
         "a'=6 b'=-6", 0},
        {"over mass", PAIR("charge=2 mass=4", "charge=3 position=2", "!electrostatic strength=4"), 1, "a'=-1.5 b'=6",
         0},
        {"strength 1 by default (left open by the seed)", PAIR("charge=2", "charge=2 position=2", "!electrostatic"), 1,
         "a'=-1 b'=1", 0},
        {"twice as far, a quarter", PAIR("charge=2", "charge=3 position=4", "!electrostatic strength=4"), 1,
         "a'=-1.5 b'=1.5", 0},
        {"constant within the radii",
         PAIR("charge=2 radius=2", "charge=3 radius=2 position=1", "!electrostatic strength=4"), 1, "a'=-1.5 b'=1.5",
         0},
        {"no charge", PAIR("", "charge=3 position=2", "!electrostatic"), 1, "a'=0 b'=0", 0},
        {"near enough", PAIR("charge=2", "charge=3 position=2", "!electrostatic strength=4 max_distance=2.5"), 1,
         "a'=-6", 0},
        {"too far", PAIR("charge=2", "charge=3 position=2", "!electrostatic strength=4 max_distance=1.5"), 1, "a'=0",
         0},
        {"five dimensions",
         P5 " !particle id=:a charge=1 position=1;1;1;1;0\n !anchor id=:b charge=8\n !electrostatic\n", 1,
         "a'=1;1;1;1;0", 0},
    };
    CHECK_CASES(cases);
}

// Radii 1.5 and 0.5: l_max 2, l_min 1.
#define STICK(at, rest) PAIR("radius=1.5", "radius=0.5 position=" at, "!adhesion strength=4 " rest)

static void test_adhesion_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"too near: apart", STICK("1", "overlap=0.5"), 1, "a'=-2 b'=2", 0},
        {"too far: together", STICK("1.75", "overlap=0.5"), 1, "a'=0.25 b'=-0.25", 0},
        {"at the adhesion distance", STICK("1.5", "overlap=0.5"), 1, "a'=0 b'=0", 0},
        {"no contact", STICK("2", "overlap=0.5"), 1, "a'=0 b'=0", 0},
        {"overlap 0.25 by default: rests at 1.75", STICK("1.75", ""), 1, "a'=0 b'=0", 0},
        {"overlap 0.25 by default", STICK("1.5", ""), 1, "a'=-0.5 b'=0.5", 0},
        {"overlap 1: the smaller one within the larger", STICK("1.5", "overlap=1"), 1, "a'=1 b'=-1", 0},
        {"overlap 1: l_min", STICK("1", "overlap=1"), 1, "a'=0 b'=0", 0},
        {"overlap 0", STICK("1.5", "overlap=0"), 1, "a'=-1 b'=1", 0},
        {"is a collision with power 2", PAIR("radius=1.5", "radius=0.5 position=1.5", "!collision power=2 strength=4"),
         1, "a'=-1 b'=1", 0},
        {"overlap below 0 is 0", STICK("1.5", "overlap=-3"), 1, "a'=-1 b'=1", 0},
        {"overlap above 1 is 1", STICK("1.5", "overlap=7"), 1, "a'=1 b'=-1", 0},
        {"no radius", PAIR("radius=1.5", "position=1", "!adhesion strength=4"), 1, "a'=0 b'=0", 0},
        {"over mass", PAIR("radius=1.5 mass=4", "radius=0.5 position=1", "!adhesion strength=4 overlap=0.5"), 1,
         "a'=-0.5 b'=2", 0},
        {"three dimensions",
         P3 " !particle id=:a radius=1.5\n !anchor id=:b radius=0.5 position=0;1;0\n"
            " !adhesion strength=4 overlap=0.5\n",
         1, "a'=0;-2;0", 0},
    };
    CHECK_CASES(cases);
}

// A link between two particles at distance 4.
#define LINK(attributes) P1 " !particle id=:a\n !particle id=:b position=4\n !distance from=:a to=:b " attributes "\n"

static void test_distance_equals_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"nearer than min: apart", LINK("min=6 strength=0.5"), 1, "a'=-1 b'=1", 0},
        {"further than max: together", LINK("max=3 strength=0.5"), 1, "a'=0.5 b'=-0.5", 0},
        {"between them: nothing", LINK("min=3 max=5"), 1, "a'=0 b'=0", 0},
        {"neither given: nothing", LINK(""), 1, "a'=0 b'=0", "no-bounds"},
        {"fixed: apart", LINK("fixed=6"), 1, "a'=-2 b'=2", 0},
        {"fixed: together", LINK("fixed=2"), 1, "a'=2 b'=-2", 0},
        {"power 2", LINK("max=2 power=2"), 1, "a'=4 b'=-4", 0},
        {"power 2 below min also restores (left open by the seed)", LINK("min=6 power=2"), 1, "a'=-4 b'=4", 0},
        {"power 3", LINK("min=6 power=3"), 1, "a'=-8 b'=8", 0},
        {"power 1/2", LINK("max=0 power=0.5"), 1, "a'=2 b'=-2", 0},
        {"power 0", LINK("max=1 power=0"), 1, "a'=1 b'=-1", 0},
        {"power below 0 is 0", LINK("max=1 power=-3"), 1, "a'=1 b'=-1", 0},
        {"a negative strength", LINK("max=3 strength=-1"), 1, "a'=-1 b'=1", 0},
        {"rest length 0 by max", LINK("max=0"), 1, "a'=4 b'=-4", 0},
        {"rest length 0 by fixed", LINK("fixed=0"), 1, "a'=4 b'=-4", 0},
        {"min 0 never acts", LINK("min=0"), 1, "a'=0 b'=0", 0},
        {"min below 0 never acts", LINK("min=-5"), 1, "a'=0 b'=0", 0},
        {"max below 0 pulls", LINK("max=-1"), 1, "a'=5 b'=-5", 0},
        {"minimum", LINK("minimum=6"), 1, "a'=-2 b'=2", 0},
        {"maximum", LINK("maximum=2"), 1, "a'=2 b'=-2", 0},
        {"minimum over min", LINK("min=9 minimum=6"), 1, "a'=-2", 0},
        {"maximum over max", LINK("max=0 maximum=2"), 1, "a'=2", 0},
        {"fixed over all: apart", LINK("min=9 max=0 minimum=20 maximum=0 fixed=6"), 1, "a'=-2", 0},
        {"fixed over all: together", LINK("min=9 max=0 minimum=20 maximum=0 fixed=2"), 1, "a'=2", 0},
        {"malformed minimum: min", LINK("minimum=\"x\" min=6"), 1, "a'=-2", "bad-attribute"},
        {"malformed maximum: max", LINK("maximum=1;2 max=2"), 1, "a'=2", "bad-attribute"},
        {"malformed min: none", LINK("min=6;7"), 1, "a'=0", "bad-attribute"},
        {"nan counts as missing", LINK("minimum=nan min=6"), 1, "a'=-2", "bad-attribute"},
        {"an infinite minimum pushes without end", LINK("min=inf"), 1, "a'=0 a=0", 0},
        {"ids are vectors",
         P1 " !particle id=:x;\"y\";1\n !anchor id=0 position=4\n !particle id=:x position=9\n"
            " !distance from=:x;\"y\";1 to=0 fixed=2\n",
         1, "x'=0 :x;'y';1=2", 0},
        {"an anchor stays", P1 " !anchor id=:a\n !particle id=:b position=4\n !distance from=:a to=:b fixed=2\n", 1,
         "a=0 b'=-2", 0},
        {"no mass: not moved",
         P1 " !particle id=:a mass=0\n !particle id=:b position=4\n"
            " !distance from=:a to=:b fixed=2\n",
         1, "a'=0 b'=-2", 0},
        {"two dimensions", P2 " !particle id=:a\n !anchor id=:b position=0;4\n !distance from=:b to=:a max=3\n", 1,
         "a'=0;1", 0},
        {"three dimensions", P3 " !particle id=:a\n !anchor id=:b position=0;0;-4\n !distance from=:b to=:a max=3\n", 1,
         "a'=0;0;-1", 0},
        {"across five dimensions",
         P5 " !particle id=:a\n !anchor id=:b position=1;1;1;1;0\n"
            " !distance from=:a to=:b max=1\n",
         1, "a'=0.5;0.5;0.5;0.5;0", 0},
        {"only these two",
         P1 " !particle id=:a\n !particle id=:b position=4\n !particle id=:c position=8\n"
            " !distance from=:a to=:b max=3\n",
         1, "a'=1 b'=-1 c'=0", 0},
        {"max_distance is none of its attributes", LINK("max=3 max_distance=1"), 1, "a'=1", "unknown-attribute"},
    };
    CHECK_CASES(cases);
}

// The force between two particles that are not on a common axis acts along the line between them.
static void test_pair_force_acts_along_the_line_between_particles(void **state) {
    (void)state;
    static const char *const forces[] = {"!distance from=:a to=:b max=4", "!gravity strength=25",
                                         "!electrostatic strength=-25", "!adhesion overlap=1 strength=1/3"};
    for (size_t i = 0; i < COUNT_OF(forces); i++) {
        World world;
        char *script = text_of(P3 " !particle id=:a charge=1 radius=4\n"
                                  " !particle id=:b charge=1 radius=4 position=0;3;-4\n %s\n",
                               forces[i]);
        world_open(&world, 1, script);
        world_to(&world, 1);
        double k = i == 0 ? 1 : i == 3 ? 5 : 25.0 / 64;
        EXPECT_NEAR(&world, ":s;:a;:velocity", 1e-14, 0, 0.6 * k, -0.8 * k);
        EXPECT_NEAR(&world, ":s;:b;:velocity", 1e-14, 0, -0.6 * k, 0.8 * k);
        world_close(&world);
        free(script);
    }
}

TEST_GROUP(seed_pairs) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_collision_equals_the_seeds_formula),
        cmocka_unit_test(test_gravity_equals_the_seeds_formula),
        cmocka_unit_test(test_electrostatic_equals_the_seeds_formula),
        cmocka_unit_test(test_adhesion_equals_the_seeds_formula),
        cmocka_unit_test(test_distance_equals_the_seeds_formula),
        cmocka_unit_test(test_pair_force_acts_along_the_line_between_particles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
