// test_seed_barriers.c: reflections and soft boundaries in scripts, with results calculated by hand.
#include "cases.h"

// A bead at 2 with velocity -4. After one step without a barrier, its position would be -2; the contact is in the
// middle of the step.
#define BEAD(attributes, barrier) P1 " !particle id=:a position=2 velocity=-4 " attributes "\n !barrier " barrier "\n"

static void test_hard_barrier_reflects_by_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"elastic by default", BEAD("", "normal=1"), 1, "a'=4 a=2", 0},
        {"restitution 1", BEAD("", "normal=1 restitution=1"), 1, "a'=4 a=2", 0},
        {"restitution 1/2", BEAD("", "normal=1 restitution=0.5"), 1, "a'=2 a=1", 0},
        {"restitution 0: all absorbed", BEAD("", "normal=1 restitution=0"), 1, "a'=0 a=0", 0},
        {"restitution above 1 is 1", BEAD("", "normal=1 restitution=3"), 1, "a'=4 a=2", 0},
        {"restitution below 0 is 0", BEAD("", "normal=1 restitution=-1"), 1, "a'=0 a=0", 0},
        {"the normal's length does not matter", BEAD("", "normal=8"), 1, "a'=4 a=2", 0},
        {"the other side is the inside", BEAD("", "position=3 normal=-1"), 1, "a'=-4 a=-2", 0},
        {"position", P1 " !particle id=:a position=12 velocity=-4\n !barrier position=10 normal=1\n", 1, "a'=4 a=12",
         0},
        {"the outer edge bounces", P1 " !particle id=:a position=3 velocity=-4 radius=1\n !barrier normal=1\n", 1,
         "a'=4 a=3", 0},
        {"not reached", P1 " !particle id=:a position=4 velocity=-4\n !barrier normal=1\n", 1, "a'=-4 a=0", 0},
        {"independent of the mass", BEAD("mass=8", "normal=1 restitution=0.5"), 1, "a'=2 a=1", 0},
        {"mass 0 bounces", BEAD("mass=0", "normal=1 restitution=0.5"), 1, "a'=2 a=1", 0},
        {"anchors stay behind it", P1 " !anchor id=:a position=-3\n !barrier normal=1\n", 1, "a=-3 a'=0", 0},
        {"a line: reflected in the normal", P2 " !particle id=:a position=0;2 velocity=8;-4\n !barrier normal=0;2\n", 1,
         "a'=8;4 a=8;2", 0},
        {"a line: the whole velocity times restitution",
         P2 " !particle id=:a position=0;2 velocity=8;-4\n !barrier normal=0;2 restitution=0.5\n", 1, "a'=4;2 a=6;1",
         0},
        {"a plane", P3 " !particle id=:a position=5;2;7 velocity=1;-4;2\n !barrier normal=0;1;0\n", 1,
         "a'=1;4;2 a=6;2;9", 0},
        {"five dimensions", P5 " !particle id=:a position=0;0;0;0;2 velocity=1;2;3;4;-4\n !barrier normal=0;0;0;0;1\n",
         1, "a'=1;2;3;4;4 a=1;2;3;4;2", 0},
        {"two barriers, a corner",
         P2 " !particle id=:a position=2;2 velocity=-4;-4\n !barrier normal=1;0\n"
            " !barrier normal=0;1\n",
         1, "a'=4;4 a=2;2", 0},
        {"found behind it, moving away: put on the surface",
         P1 " !particle id=:a position=-9 velocity=1 radius=2\n !barrier normal=1\n", 1, "a'=1 a=2", "barrier-side"},
        {"constrained permanently",
         P1 " !particle id=:a position=1\n !constant force=-1\n !barrier normal=1 restitution=0\n", 50, "a=0", 0},
    };
    CHECK_CASES(cases);
}

// A particle at distance 4 from a wall.
#define SOFT(attributes) P1 " !particle id=:a position=4\n !barrier normal=1 " attributes "\n"

static void test_soft_barrier_pushes_back_by_the_seeds_formula(void **state) {
    (void)state;
    static const Case cases[] = {
        {"nearer than min", SOFT("min=6"), 1, "a'=2 a=6", 0},
        {"further than max", SOFT("max=3"), 1, "a'=-1 a=3", 0},
        {"max without min", SOFT("maximum=3"), 1, "a'=-1", 0},
        {"between them", SOFT("min=3 max=5"), 1, "a'=0", 0},
        {"fixed: pushed", SOFT("fixed=6"), 1, "a'=2", 0},
        {"fixed: pulled", SOFT("fixed=2"), 1, "a'=-2 a=2", 0},
        {"minimum over min", SOFT("min=9 minimum=6"), 1, "a'=2", 0},
        {"maximum over max", SOFT("max=0 maximum=3"), 1, "a'=-1", 0},
        {"fixed over all: pushed", SOFT("min=9 max=0 minimum=20 maximum=0 fixed=6"), 1, "a'=2", 0},
        {"fixed over all: pulled", SOFT("min=9 max=0 minimum=20 maximum=0 fixed=2"), 1, "a'=-2", 0},
        {"malformed minimum: min", SOFT("minimum=:x;1 min=6"), 1, "a'=2", "bad-attribute"},
        {"malformed fixed: the others", SOFT("fixed=\"x\" min=6"), 1, "a'=2", "bad-attribute"},
        {"min 0 does nothing", SOFT("min=0"), 1, "a'=0", 0},
        {"power", SOFT("min=6 power=3"), 1, "a'=8", 0},
        {"power 2 pulls back from beyond max", SOFT("max=2 power=2"), 1, "a'=-4", 0},
        {"power below 0 is 0", SOFT("min=9 power=-1"), 1, "a'=1", 0},
        {"strength", SOFT("min=6 strength=0.25"), 1, "a'=0.5", 0},
        {"from the centre, whatever the radius", P1 " !particle id=:a position=4 radius=1\n !barrier normal=1 min=6\n",
         1, "a'=2", 0},
        {"along the normal", P2 " !particle id=:a position=7;4\n !barrier normal=0;-1 position=0;8 min=6\n", 1,
         "a'=0;-2", 0},
        {"a plane", P3 " !particle id=:a position=7;4;5\n !barrier normal=0;3;0 min=6\n", 1, "a'=0;2;0", 0},
        {"five dimensions", P5 " !particle id=:a position=7;4;5;1;2\n !barrier normal=0;0;0;0;1 min=6\n", 1,
         "a'=0;0;0;0;4", 0},
        {"anchors do not feel it", P1 " !anchor id=:a position=4\n !barrier normal=1 min=6\n", 1, "a=4 a'=0", 0},
        {"with a hard bounce",
         P1 " !particle id=:a position=2 velocity=-4.5\n"
            " !barrier normal=1 min=4 strength=0.25\n",
         1, "a'=4.5 a=2.25", 0},
        {"behind it there is no push, only the bounce", P1 " !particle id=:a position=-2\n !barrier normal=1 min=6\n",
         1, "a'=0 a=0", "barrier-side"},
    };
    CHECK_CASES(cases);
}

// A particle that lies on a barrier moves along it as it would without the barrier. On the floor, v = 3;-2 and p = 3;-2
// after one step. The contact was a whole step earlier, with velocity 0, which is not a hit. The motion is repeated,
// and its part along the normal is removed.
#define ON_FLOOR(attributes, barrier) P2 " !particle id=:a " attributes "\n !barrier normal=0;1 " barrier "\n"

static void test_lying_particle_slides_along_the_barrier(void **state) {
    (void)state;
    static const Case cases[] = {
        {"pushed along the floor", ON_FLOOR("force=3;-2", ""), 1, "a'=3;0 a=3;0", 0},
        {"for two steps", ON_FLOOR("force=3;-2", ""), 2, "a'=6;0 a=9;0", 0},
        {"whatever the restitution", ON_FLOOR("force=3;-2", "restitution=0"), 2, "a'=6;0 a=9;0", 0},
        {"slides without friction", ON_FLOOR("velocity=4;0 force=0;-2", "restitution=0.5"), 3, "a'=4;0 a=12;0", 0},
        // It arrives at speed 1, to which the force alone accelerates it in half a step. Only this part is reflected.
        {"no hit: keeps its speed along it", ON_FLOOR("velocity=1;-1 force=0;-2", "restitution=0.5"), 1, "a'=1;0 a=1;0",
         0},
        // At speed 3, it hits: the velocity at the contact is 1;-3, and half of it 0.5;1.5 after the reflection.
        {"a hit: loses speed along it", ON_FLOOR("velocity=1;-3 force=0;-1", "restitution=0.5"), 1,
         "a'=0.5;0.5 a=0.5;0.5", 0},
        {"pushed away from it", ON_FLOOR("force=1;2", ""), 1, "a'=1;2 a=1;2", 0},
    };
    CHECK_CASES(cases);
    World world; // a slope of 3 to 4
    world_open(&world, 1, P2 " !particle id=:a force=0;-12.5\n !barrier normal=3;4\n");
    world_to(&world, 2);
    EXPECT_NEAR(&world, ":s;:a", 1e-13, 18, -13.5);
    EXPECT_NEAR(&world, ":s;:a;:velocity", 1e-13, 12, -9);
    world_close(&world);
}

// The reflected velocity w' is computed from the velocity at the contact, without the acceleration after the contact
// (section 4.4).
static void test_bounce_under_force(void **state) {
    (void)state;
    static const Case cases[] = {
        // v = -2 - 2 = -4, p = 2 - 4 = -2: the contact was half a step earlier. The velocity at the contact is v = -4 +
        // 1 = -3, reflected 3. Half a step of the same force then gives 3 - 1 = 2.
        {"elastic", P1 " !particle id=:a position=2 velocity=-2\n !constant force=-2\n !barrier normal=1\n", 1,
         "a'=2 a=1", 0},
        // With restitution 1/2, the reflected velocity is 1.5. Then 1.5 - 1 = 0.5 and p = 0.25.
        {"half",
         P1 " !particle id=:a position=2 velocity=-2\n !constant force=-2\n !barrier normal=1 restitution=0.5\n", 1,
         "a'=0.5 a=0.25", 0},
    };
    CHECK_CASES(cases);
}

static void test_barrier_needs_a_finite_normal(void **state) {
    (void)state;
    static const Case cases[] = {
        {"none", BEAD("", "position=0"), 1, "a'=-4 a=-2", "bad-normal"},
        {"zero", BEAD("", "normal=0"), 1, "a'=-4 a=-2", "bad-normal"},
        {"infinite", BEAD("", "normal=inf"), 1, "a'=-4 a=-2", "bad-normal"},
        {"overflowing", BEAD("", "normal=1e200"), 1, "a'=-4 a=-2", "bad-normal"},
        {"nan", BEAD("", "normal=nan"), 1, "a'=-4 a=-2", "bad-normal"},
    };
    CHECK_CASES(cases);
    World world;
    world_open(&world, 1, P2 " !particle id=:a position=2;0 velocity=-4;0\n !barrier normal=1;2;3\n");
    world_to(&world, 1);
    EXPECT(&world, ":s;:a", -2, 0);
    assert_int_equal(world_count_reported(&world, "bad-attribute"), 1);
    world_close(&world);
    // A single number is used for all components, which gives a diagonal wall.
    world_open(&world, 1, P2 " !particle id=:a position=2;0 velocity=-4;0\n !barrier normal=1\n");
    world_to(&world, 1);
    EXPECT_NEAR(&world, ":s;:a", 1e-14, 0, 2);
    EXPECT_NEAR(&world, ":s;:a;:velocity", 1e-14, 0, 4);
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

TEST_GROUP(seed_barriers) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hard_barrier_reflects_by_the_seeds_formula),
        cmocka_unit_test(test_lying_particle_slides_along_the_barrier),
        cmocka_unit_test(test_soft_barrier_pushes_back_by_the_seeds_formula),
        cmocka_unit_test(test_bounce_under_force),
        cmocka_unit_test(test_barrier_needs_a_finite_normal),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
