// test_division.c: the hooks through which lib/ranks divides a system (lib/physics/division.h).
#include "physics/division.h"
#include "support.h"

static struct Calls { int begins, steps, ends, regions, gathers, frees; } calls;

static void begin_frame(PhysSystem *system, const PhysTime *time) {
    assert_true(time->now > time->last);
    assert_int_equal(system->columns_change, calls.begins ? COLUMNS_SAME : COLUMNS_FILLED);
    system->columns_change = COLUMNS_SAME;
    calls.begins++;
}

static bool step(PhysSystem *system, double clock, double delta, double speed_of_light) {
    calls.steps++;
    return phys_step(system, clock, delta, speed_of_light);
}

static bool end_frame(PhysSystem *system, bool keep_last_finite) {
    calls.ends++;
    phys_write_rows(system, keep_last_finite);
    return calls.ends < 3;
}

// Computes the pairs of every second region.
static bool compute_pairs(PhysSystem *system, const PairRegion *region) {
    (void)system;
    PairBlocks blocks = phys_pair_blocks(region, 2, 8);
    for (size_t row = 0; row < blocks.rows && calls.regions % 2; row++)
        for (size_t column = region->triangle ? row : 0; column < blocks.columns; column++)
            phys_pair_block(&blocks, row, column);
    return calls.regions++ % 2;
}

static PhysProcesses processes(const PhysSystem *system) {
    (void)system;
    return (PhysProcesses){0, 1};
}

static void gather(PhysSystem *system, double *numbers, const size_t *starts) {
    (void)system;
    assert_true(isfinite(numbers[0]));
    assert_int_equal(starts[0], 0);
    assert_true(starts[1] > 1);
    calls.gathers++;
}

static void free_data(PhysSystem *system) {
    phys_buffer_free(&system->division);
    calls.frees++;
}

static PhysSystem *stars(const PhysDivision *division, int count, double theta) {
    Dice dice = {9};
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 1, .cpu = cpu_detected.level, .division = division});
    phys_begin(system, 2);
    for (int i = 0; i < count; i++) {
        double place[] = {dice_between(&dice, -9, 9), dice_between(&dice, -9, 9)};
        phys_add_particle(system, 0, &(PhysParticle){.position = place, .radius = 0.1, .mass = 1 + i % 3});
    }
    PhysForce gravity = force_of(PHYS_GRAVITY);
    gravity.theta = theta;
    phys_add_force(system, 0, &gravity);
    return system;
}

static const PhysDivision division = {begin_frame, step, end_frame, compute_pairs, processes, gather, free_data};

static void test_hooks_replace_parts_of_a_frame(void **state) {
    (void)state;
    enum { STEPS = 4, FRAMES = 3 };
    PhysSystem *divided = stars(&division, 50, 0), *plain = stars(NULL, 50, 0);
    assert_true(phys_buffer_reserve(divided, &divided->division, 0, 1, 8));
    for (int f = 0; f < FRAMES; f++) {
        PhysTime time = {.last = f, .now = f + 1, .clock = f, .resolution = 1.0 / STEPS, .lockstep = true};
        assert_int_equal(phys_simulate(plain, &time).status, PHYS_OK);
        PhysResult result = phys_simulate(divided, &time);
        assert_int_equal(result.status, f < FRAMES - 1 ? PHYS_OK : PHYS_STOPPED); // the last end_frame fails
        for (uint32_t i = 0; i < 50; i++)
            assert_memory_equal(phys_position(divided, i), phys_position(plain, i), 4 * sizeof(double));
    }
    assert_int_equal(calls.begins, FRAMES);
    assert_int_equal(calls.steps, FRAMES * STEPS);
    assert_int_equal(calls.regions, FRAMES * STEPS);
    assert_int_equal(calls.ends, FRAMES);
    phys_set_options(divided, &(PhysOptions){.threads = 1});
    assert_int_equal(calls.frees, 1);
    phys_free(divided);
    phys_free(plain);
    assert_int_equal(calls.frees, 1);
}

// The forces of a far field pass through the buffer that is gathered.
static void test_far_forces_are_gathered(void **state) {
    (void)state;
    enum { STARS = 1500 };
    calls = (struct Calls){0};
    PhysSystem *divided = stars(&division, STARS, 0.8), *plain = stars(NULL, STARS, 0.8);
    one_step(divided);
    one_step(plain);
    assert_int_equal(calls.gathers, 1);
    for (uint32_t i = 0; i < STARS; i++)
        assert_memory_equal(phys_position(divided, i), phys_position(plain, i), 4 * sizeof(double));
    phys_free(divided);
    phys_free(plain);
}

TEST_GROUP(division) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hooks_replace_parts_of_a_frame),
                                       cmocka_unit_test(test_far_forces_are_gathered)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
