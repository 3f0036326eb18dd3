// test_limit.c: the benchmark kernel for soft discs and spheres (tests/bench/limit.h) gives the same bits as
// lib/physics, also when lists are rebuilt.
#include "../../bench/limit.h"
#include "base/cpu.h"
#include "physics/system.h"
#include "support.h"

#include <stdlib.h>

enum { STEPS = 160 };
static const double step = 1.0 / 256; // a power of two, so that times are exact

static void simulate_particles(uint32_t dimensions, uint32_t n, double *position, double *velocity) {
    PhysSystem *system = phys_new();
    phys_begin(system, dimensions);
    for (size_t i = 0; i < n; i++) {
        PhysParticle p = {.position = position + i * dimensions, .velocity = velocity + i * dimensions, .radius = 0.5};
        p.mass = 1;
        phys_add_particle(system, 0, &p);
    }
    PhysForce force = {.kind = PHYS_COLLISION, .strength = 1000, .power = 1};
    phys_add_force(system, 0, &force);
    PhysTime time = {.now = STEPS * step, .resolution = step, .lockstep = true, .performance = 1};
    PhysResult result = phys_simulate(system, &time);
    assert_int_equal(result.status, PHYS_OK);
    assert_int_equal(result.steps, STEPS);
    for (uint32_t i = 0; i < n; i++) {
        memcpy(position + (size_t)i * dimensions, phys_position(system, i), dimensions * sizeof *position);
        memcpy(velocity + (size_t)i * dimensions, phys_velocity(system, i), dimensions * sizeof *velocity);
    }
    phys_free(system);
}

static void compare_with_limit(uint32_t dimensions, uint32_t side) {
    uint32_t n = dimensions == 2 ? side * side : side * side * side;
    size_t count = (size_t)n * dimensions;
    double *numbers[4]; // positions and velocities of the kernel and of lib/physics
    for (int k = 0; k < 4; k++)
        numbers[k] = calloc(count, sizeof *numbers[k]);
    uint32_t seed = 1;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t m = 0, rest = i; m < dimensions; m++, rest /= side) {
            size_t at = (size_t)i * dimensions + m;
            seed = seed * 1664525 + 1013904223;
            numbers[0][at] = numbers[2][at] = (rest % side + 0.5) * 0.95;
            numbers[1][at] = numbers[3][at] = 4 * (seed / 4294967296.0 - 0.5);
        }
    simulate_particles(dimensions, n, numbers[0], numbers[1]);
    int lists = limit_soft_run((int)dimensions, (int)side, step, STEPS, numbers[2], numbers[3]);
    assert_in_range(lists, 3, STEPS / 2);
    assert_memory_equal(numbers[0], numbers[2], count * sizeof *numbers[0]);
    assert_memory_equal(numbers[1], numbers[3], count * sizeof *numbers[1]);
    for (int k = 0; k < 4; k++)
        free(numbers[k]);
}

static void test_limit_kernel_equals_the_engine_for_discs(void **state) {
    (void)state;
    compare_with_limit(2, 35);
}

static void test_limit_kernel_equals_the_engine_for_spheres(void **state) {
    (void)state;
    compare_with_limit(3, 11);
}

TEST_GROUP(limit) {
    if (cpu_detected.level < CPU_AVX512)
        return GROUP_SKIPPED; // skipped, because the kernel needs AVX-512
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_limit_kernel_equals_the_engine_for_discs),
                                       cmocka_unit_test(test_limit_kernel_equals_the_engine_for_spheres)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
