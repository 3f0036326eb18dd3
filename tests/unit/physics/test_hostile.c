// test_hostile.c: hostile input must not cause crashes, and results must still match the specification.
#include "random_model.h"

// NaN, infinite, huge and tiny numbers in every field, compared with the reference.
static void test_extreme_numbers(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        ModelShape shape = {.dimensions = 1 + seed % 5, .groups = 1 + (uint32_t)(seed % 4), .particles = 24};
        shape.forces = 16;
        shape.hostile = seed % 3 ? 40 : 4;
        compare_random(seed, &shape, 3);
    }
}

// A particle that is not finite does not affect others.
static void test_stays_inside(void **state) {
    (void)state;
    const double lost[] = {NAN, INFINITY, -INFINITY, 1e200};
    for (size_t i = 0; i < COUNT_OF(lost); i++) {
        PhysSystem *system = phys_new();
        phys_begin(system, 2);
        for (int j = 0; j < 3; j++) {
            PhysParticle p = {.position = VEC(j, j == 2 ? lost[i] : 0), .radius = 2, .mass = 1, .charge = 1};
            phys_add_particle(system, 0, &p);
        }
        for (int kind = PHYS_COLLISION; kind <= PHYS_DISTANCE; kind++) {
            PhysForce force = force_of((PhysForceKind)kind);
            force.to = 2;
            force.has_maximum = true;
            phys_add_force(system, 0, &force);
        }
        one_step(system);
        assert_true(isfinite(phys_velocity(system, 0)[0]) && isfinite(phys_velocity(system, 1)[0]));
        assert_same(phys_velocity(system, 0)[0], -phys_velocity(system, 1)[0]);
        assert_same(phys_velocity(system, 0)[1], 0);
        phys_free(system);
    }
}

// A force with one non-finite component does not accelerate the particle at all. The particle keeps moving.
static void test_infinite_force(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    PhysParticle p = {.velocity = VEC(1, 2), .force = VEC(5, NAN), .mass = 1};
    phys_add_particle(system, 0, &p);
    one_step(system);
    assert_same(phys_velocity(system, 0)[0], 1);
    assert_same(phys_position(system, 0)[1], 2);
    phys_free(system);
}

static void test_all_at_one_point(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 3);
    for (int i = 0; i < 300; i++) {
        PhysParticle p = {.position = VEC(1, 2, 3), .radius = 1, .mass = 1, .charge = 1};
        phys_add_particle(system, 0, &p);
    }
    for (int kind = PHYS_COLLISION; kind <= PHYS_ADHESION; kind++) {
        PhysForce force = force_of((PhysForceKind)kind);
        phys_add_force(system, 0, &force);
    }
    run_until(system, 1, 0.25);
    for (uint32_t i = 0; i < 300; i++)
        for (uint32_t k = 0; k < 3; k++)
            assert_same(phys_position(system, i)[k], k + 1);
    phys_free(system);
}

// A system with 1e9 dimensions works as long as it has no vectors.
static void test_huge_dimensions_fail_only_with_vectors(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    const uint32_t sizes[] = {1000000000, UINT32_MAX};
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        phys_begin(system, sizes[i]);
        PhysForce force = force_of(PHYS_CONSTANT);
        phys_add_force(system, phys_add_group(system, 0), &force);
        assert_int_equal(run_until(system, 1, 1).status, PHYS_OK);
        PhysParticle p = particle_at(NULL);
        assert_int_equal(phys_add_particle(system, 0, &p), 0);
        assert_int_equal(phys_add_particle(system, 0, &p), 0);
        assert_int_equal(phys_add_group(system, 0), 0);
        phys_add_force(system, 0, &force);
        assert_int_equal(phys_particle_count(system), 0);
        assert_null(phys_position(system, 0));
        PhysTime time = time_until(2, 1);
        time.clock = 7;
        PhysResult result = phys_simulate(system, &time);
        assert_int_equal(result.status, PHYS_NO_MEMORY);
        assert_int_equal(result.steps, 0);
        assert_same(result.clock, 7);
    }
    phys_begin(system, 2); // after the failure, the system can be used again
    PhysParticle p = particle_at(VEC(1, 1));
    phys_add_particle(system, 0, &p);
    assert_int_equal(run_until(system, 1, 1).status, PHYS_OK);
    phys_free(system);
}

static void test_many_dimensions(void **state) {
    (void)state;
    enum { N = 100000 };
    double *position = calloc(N, sizeof *position);
    assert_non_null(position);
    PhysSystem *system = phys_new();
    phys_begin(system, N);
    for (int i = 0; i < 3; i++) {
        position[i] = 1;
        PhysParticle p = {.position = position, .radius = 1, .mass = 1, .charge = 1};
        phys_add_particle(system, 0, &p);
    }
    for (int kind = PHYS_COLLISION; kind <= PHYS_BARRIER; kind++) {
        PhysForce force = force_of((PhysForceKind)kind);
        phys_add_force(system, 0, &force);
    }
    assert_int_equal(run_until(system, 0.1, 0.1).status, PHYS_OK);
    assert_true(isfinite(phys_position(system, 0)[N - 1]));
    phys_free(system);
    free(position);
}

// Many links in both directions between the same two particles.
static void test_many_links(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    PhysParticle a = particle_at(VEC(0, 0)), b = particle_at(VEC(2, 0));
    phys_add_particle(system, 0, &a);
    phys_add_particle(system, 0, &b);
    PhysForce link = force_of(PHYS_DISTANCE);
    link.has_maximum = true;
    link.maximum = 1;
    link.strength = 0x1p-17;
    for (uint32_t i = 0; i < 100000; i++) {
        link.from = i & 1;
        link.to = ~i & 1;
        phys_add_force(system, 0, &link);
    }
    one_step(system);
    assert_same(phys_velocity(system, 0)[0], 100000 * 0x1p-17);
    assert_same(phys_velocity(system, 1)[0], -100000 * 0x1p-17);
    phys_free(system);
}

// 10,000 nested groups. All forces are in the top group, and the particles are in the top and the innermost group.
static void test_deep_nesting(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    uint32_t bottom = 0;
    for (int i = 0; i < 10000; i++)
        bottom = phys_add_group(system, bottom);
    PhysParticle a = particle_at(VEC(0, 0)), b = particle_at(VEC(2, 0));
    phys_add_particle(system, bottom, &a);
    phys_add_particle(system, 0, &b);
    for (uint32_t i = 0; i < 500; i++) {
        PhysParticle between = {.position = VEC(1, i), .mass = 0};
        phys_add_particle(system, i * 20, &between);
    }
    PhysForce gravity = force_of(PHYS_GRAVITY);
    phys_add_force(system, 0, &gravity);
    one_step(system);
    assert_same(phys_velocity(system, 0)[0], 0.25);
    assert_same(phys_velocity(system, 1)[0], -0.25);
    phys_free(system);
}

static void test_a_million_groups(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    for (uint32_t i = 0; i < 1000000; i++)
        assert_int_equal(phys_add_group(system, i), i + 1);
    PhysParticle p = {.mass = 1};
    phys_add_particle(system, 1000000, &p);
    PhysForce force = force_of(PHYS_CONSTANT);
    force.vector = VEC(1);
    phys_add_force(system, 0, &force);
    one_step(system);
    assert_same(phys_velocity(system, 0)[0], 1);
    phys_free(system);
}

TEST_GROUP(hostile) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_extreme_numbers),
        cmocka_unit_test(test_stays_inside),
        cmocka_unit_test(test_infinite_force),
        cmocka_unit_test(test_all_at_one_point),
        cmocka_unit_test(test_huge_dimensions_fail_only_with_vectors),
        cmocka_unit_test(test_many_dimensions),
        cmocka_unit_test(test_many_links),
        cmocka_unit_test(test_deep_nesting),
        cmocka_unit_test(test_a_million_groups),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
