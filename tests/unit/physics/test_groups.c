// test_groups.c: interactions between groups, handles, and descriptions that change between frames.
#include "support.h"

enum { BODIES = 6 };

// Describes six bodies: one in the top group (index 0), two in A, one in A.B and two in C. Their handles are in another
// order than the groups. A force between all pairs then shows which bodies act on which.
static PhysSystem *family(void) {
    static const uint32_t groups[BODIES] = {3, 1, 2, 0, 1, 3};
    PhysSystem *system = phys_new();
    phys_begin(system, BODIES);
    phys_add_group(system, 0);
    phys_add_group(system, 1);
    phys_add_group(system, 0);
    for (int i = 0; i < BODIES; i++) {
        double position[BODIES] = {0};
        position[i] = 1; // each body is on a separate axis, so a force from j on i has a component j
        PhysParticle p = {.position = position, .mass = 1};
        assert_int_equal(phys_add_particle(system, groups[i], &p), i);
    }
    return system;
}

// Checks which bodies act on each body i if `group` declares gravity: bit j of wanted[i] is set if body j does.
static void check_sight(uint32_t group, const unsigned char wanted[BODIES]) {
    PhysSystem *system = family();
    PhysForce gravity = force_of(PHYS_GRAVITY);
    phys_add_force(system, group, &gravity);
    one_step(system);
    for (int i = 0; i < BODIES; i++)
        for (int j = 0; j < BODIES; j++)
            if (i != j)
                assert_int_equal(phys_velocity(system, (uint32_t)i)[j] != 0, wanted[i] >> j & 1);
    phys_free(system);
}

static void test_only_ancestors_and_descendants_interact(void **state) {
    (void)state;
    // bodies by group: top 3; A 1, 4; B 2; C 0, 5
    enum { A = 1 << 1 | 1 << 4, B = 1 << 2, C = 1 << 0 | 1 << 5, TOP = 1 << 3 };
    check_sight(0, (unsigned char[]){TOP | (C & ~1), TOP | B | (A & ~2), TOP | A, A | B | C, TOP | B | (A & ~16),
                                     TOP | (C & ~32)});
    check_sight(1, (unsigned char[]){0, B | (A & ~2), A, 0, B | (A & ~16), 0});
    check_sight(2, (unsigned char[]){0, 0, 0, 0, 0, 0}); // the group has a single body
    check_sight(3, (unsigned char[]){C & ~1, 0, 0, 0, 0, C & ~32});
}

// A link may join any two particles, wherever it is declared.
static void test_link_across(void **state) {
    (void)state;
    for (uint32_t group = 0; group < 4; group++) {
        PhysSystem *system = family();
        PhysForce link = force_of(PHYS_DISTANCE);
        link.has_maximum = true;
        link.from = 0;
        link.to = 2;
        phys_add_force(system, group, &link);
        one_step(system);
        for (uint32_t i = 0; i < BODIES; i++)
            assert_int_equal(phys_velocity(system, i)[0] != 0, i == 0 || i == 2);
        phys_free(system);
    }
}

static void test_singles_reach_subgroups(void **state) {
    (void)state;
    PhysSystem *system = family();
    PhysForce force = force_of(PHYS_CONSTANT);
    force.vector = VEC(1, 0, 0, 0, 0, 0);
    phys_add_force(system, 1, &force);
    one_step(system);
    for (uint32_t i = 0; i < BODIES; i++)
        assert_same(phys_velocity(system, i)[0], i == 1 || i == 2 || i == 4);
    phys_free(system);
}

static void test_barriers_reach_subgroups(void **state) {
    (void)state;
    PhysSystem *system = family();
    PhysForce barrier = force_of(PHYS_BARRIER);
    barrier.vector = VEC(9, 0, 0, 0, 0, 0);
    barrier.vector2 = VEC(1, 0, 0, 0, 0, 0);
    phys_add_force(system, 1, &barrier);
    one_step(system);
    for (uint32_t i = 0; i < BODIES; i++)
        assert_same(phys_position(system, i)[0], i == 1 || i == 2 || i == 4 ? 9 : i == 0);
    phys_free(system);
}

// An anchor of an enclosing group pushes a particle of a group and does not move.
static void test_anchor_above(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    uint32_t inner = phys_add_group(system, phys_add_group(system, 0));
    PhysParticle p = {.position = VEC(1), .charge = 1, .mass = 1};
    PhysParticle anchor = {.position = VEC(3), .velocity = VEC(7), .force = VEC(7), .charge = 1, .anchor = true};
    anchor.mass = 1;
    uint32_t body = phys_add_particle(system, inner, &p), fixed = phys_add_particle(system, 0, &anchor);
    PhysForce force = force_of(PHYS_ELECTROSTATIC);
    phys_add_force(system, 0, &force);
    one_step(system);
    assert_same(phys_velocity(system, body)[0], -0.25);
    assert_same(phys_position(system, fixed)[0], 3);
    assert_same(phys_velocity(system, fixed)[0], 0);
    phys_free(system);
}

// The described values can be read before the first frame.
static void test_handles_are_valid_before_the_first_frame(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    assert_int_equal(phys_particle_count(system), 0);
    assert_null(phys_position(system, 0));
    PhysParticle p = {.position = VEC(1, 2), .velocity = VEC(3, 4)};
    assert_int_equal(phys_add_particle(system, 0, &p), 0);
    p.anchor = true;
    assert_int_equal(phys_add_particle(system, 0, &p), 1);
    p.position = NULL;
    assert_int_equal(phys_add_particle(system, 0, &p), 2);
    assert_int_equal(phys_particle_count(system), 3);
    assert_same(phys_position(system, 0)[1], 2);
    assert_same(phys_velocity(system, 0)[1], 4);
    assert_same(phys_position(system, 1)[0], 1);
    assert_same(phys_velocity(system, 1)[0], 0);
    assert_same(phys_position(system, 2)[1], 0);
    assert_null(phys_velocity(system, 3));
    phys_free(system);
}

// A new description starts from scratch, even with another number of dimensions.
static void test_new_description(void **state) {
    (void)state;
    PhysSystem *system = family();
    PhysForce gravity = force_of(PHYS_GRAVITY);
    phys_add_force(system, 0, &gravity);
    one_step(system);
    for (uint32_t n = 1; n < 9; n++) {
        phys_begin(system, n);
        PhysParticle p = {.mass = 1, .velocity = VEC(1, 1, 1, 1, 1, 1, 1, 1)};
        for (uint32_t i = 0; i < 20 / n; i++)
            assert_int_equal(phys_add_particle(system, 0, &p), i);
        one_step(system);
        for (uint32_t i = 0; i < 20 / n; i++)
            for (uint32_t k = 0; k < n; k++)
                assert_same(phys_position(system, i)[k], 1);
    }
    phys_free(system);
}

TEST_GROUP(groups) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_only_ancestors_and_descendants_interact),
        cmocka_unit_test(test_link_across),
        cmocka_unit_test(test_handles_are_valid_before_the_first_frame),
        cmocka_unit_test(test_singles_reach_subgroups),
        cmocka_unit_test(test_anchor_above),
        cmocka_unit_test(test_barriers_reach_subgroups),
        cmocka_unit_test(test_new_description),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
