// test_seed_groups.c: groups in scripts: which particles a force acts on, and which pairs interact.
#include "cases.h"

static void test_force_acts_on_its_group_and_subgroups(void **state) {
    (void)state;
    static const Case cases[] = {
        {"a force at the top is for all",
         P1 " !constant force=1\n !particle id=:a\n !group\n  !particle id=:b\n  !group\n   !particle id=:c\n", 1,
         "a'=1 b'=1 c'=1", 0},
        {"wherever it stands", P1 " !particle id=:a\n !group\n  !particle id=:b\n !constant force=1\n", 1, "a'=1 b'=1",
         0},
        {"a force in a group is for the group and its sub-groups",
         P1 " !particle id=:a\n !group\n  !particle id=:b\n  !constant force=1\n  !group\n   !particle id=:c\n"
            " !group\n  !particle id=:d\n",
         1, "a'=0 b'=1 c'=1 d'=0", 0},
        {"each single force",
         P1 " !particle id=:a radius=1 charge=1 velocity=1\n !group\n"
            "  !particle id=:b radius=1 charge=1 velocity=1\n  !field direction=1\n  !drag strength=0.5\n"
            "  !buoyancy density=2\n",
         1, "a'=1 b'=2.5", 0},
        {"a barrier in a group",
         P1 " !particle id=:a position=2 velocity=-4\n !group\n  !particle id=:b position=2 velocity=-4\n"
            "  !barrier normal=1\n",
         1, "a'=-4 b'=4", 0},
        {"a soft barrier in a group",
         P1 " !particle id=:a position=2\n !group\n  !particle id=:b position=2\n"
            "  !group\n   !particle id=:c position=2\n  !barrier normal=1 min=3\n",
         1, "a'=0 b'=1 c'=1", 0},
        {"attributes of a group are ignored",
         P1 " !group strength=5 force=3 mass=2\n  !particle id=:a\n"
            "  !constant force=1\n",
         1, "a'=1", 0},
        {"a link may join particles of any groups",
         P1 " !group\n  !particle id=:a\n !group\n  !particle id=:b position=4\n"
            " !group\n  !distance from=:a to=:b fixed=2\n",
         1, "a'=2 b'=-2", 0},
        {"a link before its particles",
         P1 " !distance from=:a to=:b fixed=2\n !particle id=:a\n"
            " !group\n  !particle id=:b position=4\n",
         1, "a'=2 b'=-2", 0},
        {"an empty group", P1 " !group\n !particle id=:a\n !group\n  !constant force=1\n", 1, "a'=0", 0},
    };
    CHECK_CASES(cases);
}

// A tree of groups with one particle each, three of them at powers of two. Gravity of strength 1 between masses 1
// depends only on the distance, so the force on a particle shows which partners it has.
//
//   top a=0 | A: b=16 | A.B: c=64 | C: d=256
static const double places[] = {0, 16, 64, 256};

static double pull(int i, unsigned partners) {
    double sum = 0;
    for (int j = 0; j < 4; j++) {
        double d = places[j] - places[i];
        if (partners & (1U << j))
            sum += (d > 0 ? 1 : -1) / (d * d);
    }
    return sum;
}

static void check_sight(const char *script, const unsigned partners[4]) {
    World world;
    world_open(&world, 1, script);
    world_to(&world, 1);
    for (int i = 0; i < 4; i++) {
        char key[64];
        snprintf(key, sizeof key, ":s;:%c;:velocity", "abcd"[i]);
        EXPECT_NEAR(&world, key, 1e-18, pull(i, partners[i]));
    }
    EXPECT_REPORTED(&world, "");
    world_close(&world);
}

static void test_only_ancestors_and_descendants_interact(void **state) {
    (void)state;
    enum { A = 1, B = 2, C = 4, D = 8 };
#define TREE(top, a, b, c)                                                                                             \
    P1 " !particle id=:a position=0\n" top " !group\n  !particle id=:b position=16\n" a                                \
       "  !group\n   !particle id=:c position=64\n" b " !group\n  !particle id=:d position=256\n" c
    // In the top group, all particles interact with their ancestors and descendants. C is a sibling of A, so d does not
    // interact with the two particles of A.
    check_sight(TREE(" !gravity\n", "", "", ""), (const unsigned[]){B | C | D, A | C, A | B, A});
    // In A, pairs of A and its subgroups interact, without the particle of the top group.
    check_sight(TREE("", "  !gravity\n", "", ""), (const unsigned[]){0, C, B, 0});
    // In A.B and in C, there are no partners.
    check_sight(TREE("", "", "   !gravity\n", ""), (const unsigned[]){0, 0, 0, 0});
    check_sight(TREE("", "", "", "  !gravity\n"), (const unsigned[]){0, 0, 0, 0});
}

// Pair forces do not act between sibling groups. They do act between a group and the particles of its parent.
static void test_sibling_groups_do_not_interact(void **state) {
    (void)state;
    static const char *const forces[] = {"!collision", "!gravity", "!electrostatic", "!adhesion overlap=1"};
    for (size_t i = 0; i < COUNT_OF(forces); i++) {
        for (int shared = 0; shared < 2; shared++) {
            World world;
            char *script = text_of(P1 " !group\n  !particle id=:a radius=1 charge=1\n"
                                      " %s!particle id=:b radius=1 charge=1 position=1.5\n %s\n",
                                   shared ? "" : "!group\n  ", forces[i]);
            world_open(&world, 1, script);
            world_to(&world, 1);
            if ((world_number(&world, ":s;:a;:velocity") != 0) != (shared == 1))
                fail_msg("%s", script);
            assert_true(world_number(&world, ":s;:b;:velocity") == -world_number(&world, ":s;:a;:velocity"));
            world_close(&world);
            free(script);
        }
    }
}

// Ids are unique across all groups: the first node with an id in document order is used. Each kind of node is reported
// once.
static void test_ids_across_groups(void **state) {
    (void)state;
    static const Case cases[] = {
        {"the first one counts",
         P1 " !group\n  !particle id=:a position=1\n !particle id=:a position=2\n"
            " !group\n  !anchor id=:a position=3\n",
         3, "a=1", "duplicate-id duplicate-id"},
    };
    CHECK_CASES(cases);
}

TEST_GROUP(seed_groups) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_force_acts_on_its_group_and_subgroups),
        cmocka_unit_test(test_only_ancestors_and_descendants_interact),
        cmocka_unit_test(test_sibling_groups_do_not_interact),
        cmocka_unit_test(test_ids_across_groups),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
