// test_memory.c: no frame after the first allocates memory, and a system can be used after a failed allocation.
//
// Linked with --wrap=malloc, so all allocations of arenas call the function below.
#include "support.h"

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);

static int allocations;
static int fail_at = -1; // number of the first allocation that fails, as do all later ones; -1: none

void *__wrap_malloc(size_t size) {
    int number = allocations++;
    return fail_at >= 0 && number >= fail_at ? NULL : __real_malloc(size);
}

// Describes a system that uses every buffer, with sizes proportional to `scale`, and runs it.
static PhysResult describe_and_run(PhysSystem *system, uint32_t scale) {
    phys_begin(system, 3);
    uint32_t group = 0;
    for (uint32_t i = 0; i < scale; i++)
        group = phys_add_group(system, i % 3 ? group : 0);
    for (uint32_t i = 0; i < scale; i++) {
        PhysParticle p = {.position = VEC(i, i % 7, i % 5), .radius = 0.5, .mass = 1, .charge = 1};
        phys_add_particle(system, group ? i % group : 0, &p);
    }
    for (uint32_t i = 0; i < scale; i++) {
        PhysForce force = force_of((PhysForceKind)(PHYS_DISTANCE + i % (PHYS_BARRIER - PHYS_DISTANCE + 1)));
        force.vector = force.vector2 = VEC(0, 1, 0);
        force.from = i;
        phys_add_force(system, 0, &force);
    }
    return run_until(system, 1, 0.5);
}

static void test_warm_frame(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    describe_and_run(system, 300);
    describe_and_run(system, 300); // the row buffer grows, because it now holds two descriptions
    int before = allocations;
    for (int frame = 0; frame < 5; frame++)
        assert_int_equal(describe_and_run(system, 300).status, PHYS_OK);
    assert_int_equal(describe_and_run(system, 20).status, PHYS_OK); // a smaller system needs no new memory
    assert_int_equal(allocations, before);
    phys_free(system);
}

static void test_system_may_grow_in_each_frame(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    for (uint32_t scale = 0; scale < 2000; scale = scale * 2 + 1) {
        assert_int_equal(describe_and_run(system, scale).status, PHYS_OK);
        assert_int_equal(phys_particle_count(system), scale);
    }
    phys_free(system);
}

// Each allocation of a frame fails in turn.
static void test_failed_allocation_changes_nothing(void **state) {
    (void)state;
    allocations = 0;
    PhysSystem *system = phys_new();
    describe_and_run(system, 300);
    phys_free(system);
    int total = allocations;
    assert_true(total > 8);
    for (int i = 0; i < total; i++) {
        allocations = 0;
        fail_at = i;
        system = phys_new();
        assert_int_equal(system == NULL, i == 0);
        if (!system)
            continue;
        PhysResult result = describe_and_run(system, 300);
        assert_int_equal(result.status, PHYS_NO_MEMORY);
        assert_int_equal(result.steps, 0);
        for (uint32_t p = 0; p < phys_particle_count(system); p++)
            assert_same(phys_position(system, p)[0], p);
        fail_at = -1;
        assert_int_equal(describe_and_run(system, 300).status, PHYS_OK);
        phys_free(system);
    }
    fail_at = -1;
}

// An attribute that is equal for all particles is stored once until one particle changes. Each particle has the right
// value before and after.
static void test_equal_attributes_are_stored_once(void **state) {
    enum { COUNT = 1000 };
    (void)state;
    for (uint32_t odd = 0; odd <= COUNT; odd += COUNT / 4) {
        PhysSystem *system = phys_new();
        PhysParticle particle = {.radius = 2, .mass = 3, .charge = 4};
        for (uint32_t i = 0; i < COUNT; i++) {
            particle.radius = i == odd ? 7 : 2;
            assert_int_equal(phys_add_particle(system, 0, &particle), i);
        }
        PhysColumns columns = phys_columns(system);
        assert_int_equal(columns.radius.stride == 0 && columns.anchor_stride == 0, odd == COUNT);
        for (uint32_t i = 0; i < COUNT; i++)
            assert_true(*phys_at_particle(columns.radius, i) == (i == odd ? 7 : 2) &&
                        *phys_at_particle(columns.mass, i) == 3 && !columns.anchor[i * columns.anchor_stride]);
        particle.radius = 9;
        phys_update_particle(system, 5, &particle, (PhysPreserve){false, false});
        columns = phys_columns(system);
        for (uint32_t i = 0; i < COUNT; i++)
            assert_true(*phys_at_particle(columns.radius, i) == (i == 5 ? 9 : i == odd ? 7 : 2));
        phys_free(system);
    }
}

TEST_GROUP(memory) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_attributes_are_stored_once),
        cmocka_unit_test(test_warm_frame),
        cmocka_unit_test(test_system_may_grow_in_each_frame),
        cmocka_unit_test(test_failed_allocation_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
