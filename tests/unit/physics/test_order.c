// test_order.c: the order of summation. Random systems with nested groups and all kinds of forces give the same bits as
// the reference.
#include "random_model.h"

static void compare_many(size_t dimensions) {
    for (uint64_t seed = 1; seed <= 60; seed++) {
        ModelShape shape = {.dimensions = dimensions, .groups = 1 + (uint32_t)(seed % 9)};
        shape.particles = (uint32_t)(seed * 7 % 41);
        shape.forces = (uint32_t)(seed * 5 % 37);
        compare_random(seed, &shape, 4);
    }
}

static void test_one_dimension(void **state) {
    (void)state;
    compare_many(1);
}

static void test_two_dimensions(void **state) {
    (void)state;
    compare_many(2);
}

static void test_three_dimensions(void **state) {
    (void)state;
    compare_many(3);
}

static void test_four_dimensions(void **state) {
    (void)state;
    compare_many(4);
}

static void test_five_dimensions(void **state) {
    (void)state;
    compare_many(5);
}

// Many pair forces at every level of a deep tree of groups.
static void test_deep_groups(void **state) {
    (void)state;
    for (uint64_t seed = 100; seed < 110; seed++) {
        ModelShape shape = {.dimensions = 2, .groups = 40, .particles = 90, .forces = 120};
        compare_random(seed, &shape, 2);
    }
}

static void test_large_group(void **state) {
    (void)state;
    ModelShape shape = {.dimensions = 3, .groups = 2, .particles = 256, .forces = 16};
    compare_random(7, &shape, 3);
}

// The sum of three forces differs in the last bit if they are added in reverse order. The test checks that they are
// added in the order of the bodies.
static void test_order_is_visible(void **state) {
    (void)state;
    double forward = (0.1 + 0.2) + 0.3, backward = (0.3 + 0.2) + 0.1;
    assert_true(forward != backward);
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    const double charges[] = {1, 0.1, 0.2, 0.3};
    for (int i = 0; i < 4; i++) {
        PhysParticle p = particle_at(VEC(i ? -1 : 0));
        p.charge = charges[i];
        p.anchor = i > 0;
        phys_add_particle(system, 0, &p);
    }
    PhysForce force = force_of(PHYS_ELECTROSTATIC);
    phys_add_force(system, 0, &force);
    one_step(system);
    assert_true(phys_velocity(system, 0)[0] == forward);
    phys_free(system);
}

TEST_GROUP(order) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_dimension),    cmocka_unit_test(test_two_dimensions),
        cmocka_unit_test(test_three_dimensions), cmocka_unit_test(test_four_dimensions),
        cmocka_unit_test(test_five_dimensions),  cmocka_unit_test(test_deep_groups),
        cmocka_unit_test(test_large_group),      cmocka_unit_test(test_order_is_visible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
