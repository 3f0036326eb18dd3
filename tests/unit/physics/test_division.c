// test_division.c: the hooks through which lib/ranks divides a system (lib/physics/division.h).
#include "physics/division.h"
#include "support.h"

static struct Calls { int begins, steps, ends, regions, frees; } calls;

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

static void free_data(PhysSystem *system) {
    phys_buffer_free(&system->division);
    calls.frees++;
}

static PhysSystem *stars(const PhysDivision *division) {
    Dice dice = {9};
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 1, .cpu = cpu_detected.level, .division = division});
    phys_begin(system, 2);
    for (int i = 0; i < 50; i++) {
        double place[] = {dice_between(&dice, -9, 9), dice_between(&dice, -9, 9)};
        phys_add_particle(system, 0, &(PhysParticle){.position = place, .radius = 0.1, .mass = 1 + i % 3});
    }
    PhysForce gravity = force_of(PHYS_GRAVITY);
    phys_add_force(system, 0, &gravity);
    return system;
}

static void test_hooks_replace_parts_of_a_frame(void **state) {
    (void)state;
    enum { STEPS = 4, FRAMES = 3 };
    const PhysDivision division = {begin_frame, step, end_frame, compute_pairs, free_data};
    PhysSystem *divided = stars(&division), *plain = stars(NULL);
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_hooks_replace_parts_of_a_frame)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
