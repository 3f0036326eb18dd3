// test_work.c: the units of work (lib/base/budget.h) that steps charge. They are counted and not timed, so a script
// exceeds its limit at the same step on every machine.
#include "support.h"

// Describes particles on a grid, two apart.
static PhysSystem *describe_particles(uint32_t dimensions, uint32_t count, Budget *budget, const PhysForce *forces,
                                      size_t force_count) {
    enum { SIDE = 40 };
    PhysSystem *system = phys_new();
    phys_set_options(
        system,
        &(PhysOptions){.threads = 1, .budget = budget, .cpu = cpu_detected.level, .neighbours = PHYS_NEIGHBOURS_NEVER});
    phys_begin(system, dimensions);
    for (uint32_t i = 0; i < count; i++) {
        PhysParticle p = {.position = VEC(i % SIDE * 2.0, i / SIDE * 2.0, 0, 0), .radius = 1, .mass = 1};
        phys_add_particle(system, 0, &p);
    }
    for (size_t i = 0; i < force_count; i++)
        phys_add_force(system, 0, &forces[i]);
    return system;
}

// Returns the work of one step.
static double work_of(uint32_t dimensions, uint32_t count, const PhysForce *forces, size_t force_count) {
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_C(1) << 40, NULL);
    PhysSystem *system = describe_particles(dimensions, count, &budget, forces, force_count);
    uint64_t before = budget.work;
    one_step(system);
    double work = (double)(budget.work - before);
    phys_free(system);
    return work;
}

// Checks that the forces add `wanted` units, within 5 %, to a step without forces.
static void check_added(uint32_t dimensions, uint32_t count, const PhysForce *forces, size_t force_count,
                        double wanted) {
    double added = work_of(dimensions, count, forces, force_count) - work_of(dimensions, count, forces, 0);
    assert_near(added, wanted, 0.05 * wanted);
}

static void test_work_is_proportional_to_the_numbers_moved(void **state) {
    (void)state;
    for (uint32_t n = 1; n <= 4; n++) {
        double one = work_of(n, 1, NULL, 0), numbers = 1600.0 * n, work = work_of(n, 1600, NULL, 0);
        assert_true(one > 0 && one < 20); // the fixed part of a step
        // A number is filled once and added twice.
        assert_near(work - one, numbers / 32 + numbers / 16, 0.05 * numbers / 16);
    }
}

static void test_single_forces(void **state) {
    (void)state;
    PhysForce forces[] = {force_of(PHYS_DRAG), force_of(PHYS_DRAG), force_of(PHYS_RANDOM)};
    forces[2].key = 5;
    for (uint32_t n = 1; n <= 4; n++) {
        double numbers = 1600.0 * n;
        check_added(n, 1600, forces, 1, numbers / 16);
        check_added(n, 1600, forces, 2, 2 * numbers / 16);
        check_added(n, 1600, &forces[2], 1,
                    2 * numbers / 2 - numbers / 16); // drawing a number takes eight times as long
    }
}

static void test_pair_forces(void **state) {
    (void)state;
    PhysForce forces[] = {force_of(PHYS_GRAVITY), force_of(PHYS_COLLISION)};
    double pairs = 1600 * 1600 / 2.0;
    for (uint32_t n = 1; n <= 3; n++) {
        check_added(n, 1600, forces, 1, pairs / 20);
        check_added(n, 1600, forces, 2, 2 * pairs / 8);
    }
    check_added(4, 1600, forces, 2, 2 * pairs * 4 / 4); // without vector kernels
}

// A frame that exceeds the limit is aborted and changes no particle.
static void test_step_beyond_the_limit_changes_no_particle(void **state) {
    (void)state;
    PhysForce drag = force_of(PHYS_DRAG);
    uint64_t enough = (uint64_t)work_of(3, 1600, &drag, 1) + 1;
    for (int missing = 0; missing <= 1; missing++) {
        Budget budget = {.memory_limit = SIZE_MAX};
        budget_begin(&budget, UINT64_MAX / 2, NULL);
        PhysSystem *system = describe_particles(3, 1600, &budget, &drag, 1);
        budget_begin(&budget, enough - (uint64_t)missing, NULL);
        PhysResult result = run_until(system, 1, 1);
        assert_int_equal(result.status, missing ? PHYS_STOPPED : PHYS_OK);
        assert_int_equal(result.steps, !missing);
        assert_same(phys_position(system, 41)[0], 2);
        phys_free(system);
    }
}

TEST_GROUP(work) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_work_is_proportional_to_the_numbers_moved),
                                       cmocka_unit_test(test_single_forces), cmocka_unit_test(test_pair_forces),
                                       cmocka_unit_test(test_step_beyond_the_limit_changes_no_particle)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
