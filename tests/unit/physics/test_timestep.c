// test_timestep.c: the number of steps in a frame (the loop of section 4).
#include "support.h"

// A particle in free fall, so that its velocity shows the number of steps.
static PhysSystem *falling(void) {
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    PhysParticle p = {.mass = 1, .force = VEC(1)};
    phys_add_particle(system, 0, &p);
    return system;
}

static void check_steps(PhysTime time, PhysStatus status, uint64_t steps, double clock) {
    PhysSystem *system = falling();
    PhysResult result = phys_simulate(system, &time);
    assert_int_equal(result.status, status);
    assert_int_equal(result.steps, steps);
    assert_near(result.clock, clock, 1e-9);
    assert_near(phys_velocity(system, 0)[0], clock - time.clock, 1e-9);
    phys_free(system);
}

static void test_steps_are_at_most_as_long_as_the_resolution(void **state) {
    (void)state;
    check_steps(time_until(1, 2), PHYS_OK, 1, 1);
    check_steps(time_until(1, 1), PHYS_OK, 1, 1);
    check_steps(time_until(1, 0.25), PHYS_OK, 4, 1);
    check_steps(time_until(1, 0.4), PHYS_OK, 3, 1);
    check_steps((PhysTime){.last = 5, .now = 6, .clock = 3, .resolution = 0.25, .lockstep = true}, PHYS_OK, 4, 4);
}

// If rounding leaves a tiny remainder of a frame's time, no further step is taken for it.
static void test_rounding_adds_no_further_step(void **state) {
    (void)state;
    check_steps(time_until(1, 0.1), PHYS_OK, 10, 1);
    check_steps(time_until(1, 1 / 60.0), PHYS_OK, 60, 1);
    check_steps(time_until(1 + 1e-12, 1), PHYS_OK, 1, 1);
    check_steps(time_until(1 + 1e-6, 1), PHYS_OK, 2, 1 + 1e-6);
}

static void test_real_time(void **state) {
    (void)state;
    PhysTime time = {.now = 1, .resolution = 0.25, .performance = 1.5};
    check_steps(time, PHYS_OK, 1, 0.25); // the rest of the frame is dropped without a report
    time.performance = 1.6;
    check_steps(time, PHYS_OK, 2, 0.5);
    time.performance = NAN;
    check_steps(time, PHYS_OK, 1, 0.25);
    time = (PhysTime){.now = 0.25, .resolution = 0.25, .performance = 2};
    check_steps(time, PHYS_OK, 1, 0.25);
}

static void test_no_progress(void **state) {
    (void)state;
    check_steps(time_until(0, 1), PHYS_OK, 0, 0);
    check_steps(time_until(-1, 1), PHYS_OK, 0, 0);
    check_steps(time_until(NAN, 1), PHYS_OK, 0, 0);
}

static void test_step_limit(void **state) {
    (void)state;
    check_steps(time_until(1, 1e-12), PHYS_DROPPED_TIME, PHYS_MAX_STEPS, 1e-6);
    check_steps(time_until(1, 1e-6), PHYS_OK, PHYS_MAX_STEPS, 1);
}

// No step is taken if adding it would not change the clock.
static void test_lost_precision(void **state) {
    (void)state;
    PhysTime time = {.last = 1e17, .now = 1e17 + 64, .resolution = 1, .lockstep = true};
    check_steps(time, PHYS_DROPPED_TIME, 0, 0);
    time = (PhysTime){.last = 0, .now = 1, .resolution = 5e-324, .lockstep = true};
    PhysSystem *system = falling();
    assert_int_equal(phys_simulate(system, &time).status, PHYS_DROPPED_TIME);
    phys_free(system);
    time = (PhysTime){.last = -1e308, .now = 1.7e308, .resolution = 1e308, .lockstep = true};
    system = falling();
    phys_simulate(system, &time);
    phys_free(system);
}

// The bits do not depend on how steps are distributed over frames.
static void test_grouping_of_steps(void **state) {
    (void)state;
    PhysSystem *whole = falling(), *parts = falling();
    PhysResult result = run_until(whole, 1, 0.125);
    double clock = 0;
    for (int i = 0; i < 4; i++) {
        PhysTime time = {
            .last = i * 0.25, .now = (i + 1) * 0.25, .clock = clock, .resolution = 0.125, .lockstep = true};
        clock = phys_simulate(parts, &time).clock;
    }
    assert_same(clock, result.clock);
    assert_same(phys_position(parts, 0)[0], phys_position(whole, 0)[0]);
    assert_same(phys_velocity(parts, 0)[0], phys_velocity(whole, 0)[0]);
    phys_free(whole);
    phys_free(parts);
}

static void test_empty_system(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    PhysResult result = run_until(system, 1, 0.25);
    assert_int_equal(result.status, PHYS_OK);
    assert_int_equal(result.steps, 4);
    assert_same(result.clock, 1);
    phys_free(system);
    phys_free(NULL);
}

TEST_GROUP(timestep) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_steps_are_at_most_as_long_as_the_resolution),
        cmocka_unit_test(test_rounding_adds_no_further_step),
        cmocka_unit_test(test_real_time),
        cmocka_unit_test(test_no_progress),
        cmocka_unit_test(test_step_limit),
        cmocka_unit_test(test_lost_precision),
        cmocka_unit_test(test_grouping_of_steps),
        cmocka_unit_test(test_empty_system),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
