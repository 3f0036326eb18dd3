// test_seed_bodies.c: attributes of particles and anchors in scripts.
#include "cases.h"

static void test_particle_moves_by_its_attributes(void **state) {
    (void)state;
    static const Case cases[] = {
        {"defaults: at 0, at rest", P2 " !particle id=:a\n", 1, "a=0;0 a'=0;0", 0},
        {"initial position and velocity", P2 " !particle id=:a position=1;2 velocity=3;-4\n", 2, "a=7;-6 a'=3;-4", 0},
        {"one number for all dimensions", P3 " !particle id=:a position=1 velocity=2 force=3\n", 1, "a=6;6;6 a'=5;5;5",
         0},
        {"the position counts at the first step only", P1 " !particle id=:a position=10*frame\n", 3, "a=10",
         "changing-start"},
        {"the velocity counts at the first step only", P1 " !particle id=:a velocity=frame\n", 3, "a'=1 a=3",
         "changing-start"},
        {"the force at any time", P1 " !particle id=:a force=(frame if frame < 3 else null)\n", 4, "a'=3 a=10", 0},
        {"ease ramps the force up", P1 " !particle id=:a force=8 ease=4\n", 3, "a'=6", 0},
        {"ease has ended", P1 " !particle id=:a force=8 ease=4\n", 6, "a'=28", 0},
        {"ease without force", P1 " !particle id=:a ease=4 velocity=1\n !constant force=1\n", 2, "a'=3", 0},
        {"ease 0 and below: none", P1 " !particle id=:a force=8 ease=-4\n", 1, "a'=8", 0},
        {"ease does not touch other forces", P1 " !particle id=:a force=8 ease=4\n !constant force=1\n", 1, "a'=1", 0},
        {"force over mass", P1 " !particle id=:a force=8 mass=4\n", 1, "a'=2", 0},
        {"mass 1 by default", P1 " !particle id=:a force=8\n", 1, "a'=8", 0},
        {"no mass: keeps its velocity", P1 " !particle id=:a force=8 mass=0 velocity=2\n !constant force=3\n", 3,
         "a'=2 a=6", 0},
        {"no mass: stays where it is", P1 " !particle id=:a position=5 mass=0\n !constant acceleration=3\n", 3,
         "a'=0 a=5", 0},
        {"no mass: cannot be moved later", P1 " !particle id=:a position=5+frame mass=0\n", 4, "a=6", "changing-start"},
        {"a mass below 0 is 0", P1 " !particle id=:a force=8 mass=-2 velocity=2\n", 1, "a'=2", 0},
        {"no mass: seen by others",
         P1 " !particle id=:a mass=0 radius=1\n !particle id=:b radius=1 position=1.5\n"
            " !collision\n",
         1, "a'=0 b'=0.5", 0},
        {"no mass: its charge repels others",
         P1 " !particle id=:a mass=0 charge=4\n !particle id=:b charge=1 position=2\n"
            " !electrostatic\n",
         1, "a'=0 b'=1", 0},
        {"a radius below 0 is 0",
         P1 " !particle id=:a radius=-3 velocity=1\n !drag\n"
            " !barrier position=0 normal=1\n",
         1, "a'=1 a=1", 0},
        {"the radius is a distance in all directions: axis",
         P2 " !particle id=:a radius=5 position=0;0\n !particle id=:b radius=3 position=0;-6\n !collision\n", 1,
         "b'=0;-2", 0},
        {"radius 0 by default", P1 " !particle id=:a velocity=1\n !drag\n", 1, "a'=1", "no-radius"},
        {"charge 0 by default", P1 " !particle id=:a\n !field direction=1\n", 1, "a'=0", "no-charge"},
        {"an infinite mass is not moved", P1 " !particle id=:a mass=inf force=5 velocity=2\n", 2, "a'=2 a=4", 0},
    };
    CHECK_CASES(cases);
}

static void test_anchor_acts_on_others_and_is_not_moved(void **state) {
    (void)state;
    static const Case cases[] = {
        {"at 0 by default", P2 " !anchor id=:a\n !particle id=:b\n", 0, "a=0;0 a'=0;0", 0},
        {"stored in frame 0 already, particles are not", P1 " !anchor id=:a position=2\n !particle id=:b\n", 0,
         "a=2 a'=0 b=none b'=none", 0},
        {"no force, not its own either", P1 " !anchor id=:a position=3 force=5\n !constant force=1\n", 3, "a=3 a'=0",
         0},
        {"its velocity is zero", P1 " !anchor id=:a velocity=5\n", 3, "a=0 a'=0", 0},
        {"goes where its position is", P1 " !anchor id=:a position=frame*frame\n", 3, "a=9 a'=0", 0},
        {"pulls from where it is now",
         P1 " !anchor id=:a position=8*frame\n !particle id=:b mass=inf\n !particle id=:c;frame\n"
            " !distance from=:a to=:c;frame max=0\n",
         2, ":c;1=none :c;2'=16", 0},
        {"its mass attracts", P1 " !anchor id=:a mass=8\n !particle id=:b position=2\n !gravity\n", 1, "b'=-2 a=0", 0},
        {"its charge repels", P1 " !anchor id=:a charge=8\n !particle id=:b position=2 charge=1\n !electrostatic\n", 1,
         "b'=2 a=0", 0},
        {"its radius collides", P1 " !anchor id=:a radius=2\n !particle id=:b position=2 radius=1\n !collision\n", 1,
         "b'=1 a=0", 0},
        {"mass 1 by default", P1 " !anchor id=:a\n !particle id=:b position=2\n !gravity strength=4\n", 1, "b'=-1", 0},
        {"no mass: held by a link, no gravity",
         P1 " !anchor id=:a mass=0\n !particle id=:b position=2\n !gravity\n"
            " !distance from=:a to=:b max=1\n",
         1, "b'=-1", 0},
        {"a mass and a radius below 0 are 0",
         P1 " !anchor id=:a mass=-1 radius=-1\n !particle id=:b position=2 radius=1\n"
            " !gravity\n !collision\n",
         1, "b'=0", 0},
    };
    CHECK_CASES(cases);
}

// The initial position may change until the first step. A paused clock delays that step.
static void test_first_step(void **state) {
    (void)state;
    static const Case cases[] = {
        {"taken at the first step",
         "let N=(0 if frame < 3 else frame)\n!physics state=:s dimensions=1 time=N\n"
         " !particle id=:a position=10*frame\n",
         2, "a=none :clock=0 :iteration=2", 0},
        {"taken at the first step",
         "let N=(0 if frame < 3 else frame)\n!physics state=:s dimensions=1 time=N\n"
         " !particle id=:a position=10*frame\n",
         5, "a=30", 0},
        {"a particle that appears later", P1 " if frame >= 2\n  !particle id=:a position=10*frame velocity=1\n", 3,
         "a=22", 0},
    };
    CHECK_CASES(cases);
}

// Ids of all kinds, and the state keys of the particles with these ids.
static void test_id_of_any_kind_is_part_of_the_state_key(void **state) {
    (void)state;
    World world;
    world_open(&world, 1,
               "!physics state=:s;1;\"t\" dimensions=1\n"
               " !particle id=0 velocity=1\n"
               " !particle id=-0.5 velocity=2\n"
               " !particle id=\"a\" velocity=3\n"
               " !particle id=:a velocity=4\n"
               " !particle id=:a;:a velocity=5\n"
               " !particle id=1;\"b\";:c velocity=6\n"
               " !anchor id=inf position=7\n"
               " !group\n"
               "  !particle id=:in velocity=8\n");
    world_to(&world, 1);
    static const char *const ids[] = {"0", "-0.5", "'a'", ":a", ":a;:a", "1;'b';:c", "inf", ":in"};
    for (size_t i = 0; i < COUNT_OF(ids); i++) {
        char key[64];
        snprintf(key, sizeof key, ":s;1;'t';%s", ids[i]);
        EXPECT(&world, key, (double)(i + 1));
        snprintf(key, sizeof key, ":s;1;'t';%s;:velocity", ids[i]);
        EXPECT(&world, key, i == 6 ? 0 : (double)(i + 1));
    }
    EXPECT(&world, ":s;1;'t';:clock", 1);
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

TEST_GROUP(seed_bodies) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_particle_moves_by_its_attributes),
        cmocka_unit_test(test_anchor_acts_on_others_and_is_not_moved),
        cmocka_unit_test(test_first_step),
        cmocka_unit_test(test_id_of_any_kind_is_part_of_the_state_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
