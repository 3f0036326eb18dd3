// test_explain.c: the contributions of phys_explain add up, to the last bit, to the force that the steps have computed.
#include "physics/explain.h"
#include "random_model.h"

// Checks that the contributions to the force on a particle add up to `force`.
static void check_sum(const PhysSystem *system, size_t n, uint32_t particle, uint64_t step, const double *force) {
    PhysExplanation found;
    double sum[MODEL_DIMENSIONS] = {0};
    assert_int_equal(phys_explain(system, particle, step, &found), PHYS_OK);
    for (uint32_t c = 0; c < found.count; c++)
        for (size_t k = 0; k < n; k++) {
            double f = found.vectors[c * n + k];
            sum[k] = found.forces[c] == PHYS_OWN_FORCE ? f : sum[k] + f;
        }
    if (!same_bits(found.sum, force, n) || !same_bits(sum, force, n)) {
        print_error("particle %u, step %d: sum[0] %a, %a, not %a\n", particle, (int)step, found.sum[0], sum[0],
                    force[0]);
        fail();
    }
    phys_explanation_free(&found);
}

// Checks the last step of the last frame for every `stride`-th particle.
static void check_last_step(const PhysSystem *system, size_t n, uint32_t stride) {
    PhysColumn force = phys_columns(system).force;
    uint64_t steps = phys_explained_steps(system);
    assert_true(steps > 0);
    for (uint32_t i = 0; i < phys_particle_count(system); i += stride)
        check_sum(system, n, i, steps - 1, phys_at_particle(force, i));
}

static void check_model(uint64_t seed, const ModelShape *shape, const PhysOptions *options) {
    Dice dice = {seed * UINT64_C(0x9e3779b97f4a7c15) + 1};
    Model *model = calloc(1, sizeof *model);
    PhysSystem *system = phys_new();
    assert_non_null(model);
    phys_set_options(system, options);
    model_random(&dice, shape, model);
    PhysTime time = {.resolution = 0.04, .performance = dice_between(&dice, 1, 2), .lockstep = dice_below(&dice, 2)};
    time.speed_of_light = dice_below(&dice, 2) ? 1.5 : 0;
    for (int frame = 0; frame < 3; frame++) {
        time.last = time.now;
        time.now += dice_between(&dice, 0.01, 0.15);
        double clock = time.clock;
        compare_frame(model, system, &time);
        if (shape->particles)
            check_last_step(system, shape->dimensions, 1);
        time.clock = clock + (time.now - time.last);
    }
    phys_free(system);
    free(model);
}

// Random systems with all kinds of forces, nested groups, anchors, easing and, in some, extreme values.
static void test_random_systems(void **state) {
    (void)state;
    for (int cpu = 0; cpu <= (int)cpu_detected.level; cpu++)
        for (uint64_t seed = 1; seed <= 40; seed++) {
            PhysOptions options = {.threads = 1 + (int)(seed % 3), .cpu = (CpuLevel)cpu, .keep_forces = true};
            options.neighbours = (PhysNeighbours)(seed % 3);
            ModelShape shape = {.dimensions = 1 + seed % 4, .groups = 1 + (uint32_t)(seed % 5)};
            shape.particles = (uint32_t)(seed * 11 % 71);
            shape.forces = (uint32_t)(seed * 5 % 37);
            shape.hostile = seed % 3 ? 0 : seed % 2 ? 4 : 40;
            check_model(seed, &shape, &options);
        }
}

// --- each kind of force, in systems that are large enough for threads and neighbour lists

// Adds a force of a kind, with all the attributes that it needs to act on most particles.
static void add_force(PhysSystem *system, PhysForceKind kind, uint32_t count) {
    PhysForce force = force_of(kind);
    force.strength = 0.7;
    force.key = UINT64_C(0x9e3779b97f4a7c15);
    force.has_minimum = force.has_maximum = true;
    force.minimum = 4;
    force.maximum = 9;
    force.vector = kind == PHYS_BARRIER ? NULL : VEC(0.1, -0.3, 0.2);
    force.vector2 = kind == PHYS_BARRIER ? VEC(1, 0, 0) : NULL;
    if (kind != PHYS_DISTANCE) {
        phys_add_force(system, 0, &force);
        return;
    }
    for (uint32_t i = 0; i + 1 < count; i++) {
        force.from = i;
        force.to = i * 7 % count;
        phys_add_force(system, 0, &force);
    }
}

static void describe_cloud(PhysSystem *system, PhysForceKind kind, uint32_t n, uint32_t count) {
    Dice dice = {count * 77 + n};
    double side = n == 2 ? sqrt(count) : cbrt(count);
    phys_begin(system, n);
    for (uint32_t i = 0; i < count; i++) {
        double position[3], velocity[3];
        for (uint32_t k = 0; k < 3; k++) {
            position[k] = dice_between(&dice, 0, side);
            velocity[k] = dice_between(&dice, -1, 1);
        }
        phys_add_particle(system, 0,
                          &(PhysParticle){.position = position,
                                          .velocity = velocity,
                                          .radius = dice_between(&dice, 0.3, 0.6),
                                          .mass = dice_between(&dice, 0.5, 1),
                                          .charge = dice_between(&dice, -1, 1),
                                          .anchor = dice_below(&dice, 9) == 0});
    }
    add_force(system, kind, count);
}

// Returns the number of contributions to the forces on some particles.
static uint32_t count_contributions(const PhysSystem *system) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < 6; i++) {
        PhysExplanation found;
        assert_int_equal(phys_explain(system, i, 0, &found), PHYS_OK);
        count += found.count;
        phys_explanation_free(&found);
    }
    return count;
}

static void check_cloud(PhysForceKind kind, uint32_t n, const PhysOptions *options) {
    PhysSystem *system = phys_new();
    phys_set_options(system, options);
    describe_cloud(system, kind, n, 1700);
    assert_int_equal(run_until(system, 0.25, 0.1).steps, 3);
    assert_true(count_contributions(system) > 0);
    check_last_step(system, n, 171);
    phys_free(system);
}

static void test_each_force(void **state) {
    (void)state;
    static const PhysOptions variants[] = {{.threads = 1, .neighbours = PHYS_NEIGHBOURS_NEVER},
                                           {.threads = 4, .neighbours = PHYS_NEIGHBOURS_AUTO},
                                           {.threads = 3, .neighbours = PHYS_NEIGHBOURS_ALWAYS}};
    for (int kind = 0; kind < PHYS_FORCE_KINDS; kind++)
        for (uint32_t n = 2; n <= 3; n++)
            for (size_t v = 0; v < COUNT_OF(variants); v++) {
                PhysOptions options = variants[v];
                options.cpu = cpu_detected.level;
                options.keep_forces = true;
                check_cloud((PhysForceKind)kind, n, &options);
            }
}

// --- order and attribution

// Describes a particle with an own force in a sub-group, and its partners in both groups. Forces have the numbers 0
// to 4.
static PhysSystem *describe_ordered(void) {
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 1, .keep_forces = true});
    phys_begin(system, 1);
    uint32_t group = phys_add_group(system, 0);
    PhysForce forces[] = {force_of(PHYS_BARRIER), force_of(PHYS_CONSTANT), force_of(PHYS_GRAVITY),
                          force_of(PHYS_COLLISION), force_of(PHYS_DISTANCE)};
    forces[0].vector2 = VEC(1);
    forces[0].has_maximum = true;
    forces[1].vector = VEC(0.125);
    forces[4].from = 2;
    forces[4].has_maximum = true;
    for (uint32_t f = 0; f < COUNT_OF(forces); f++)
        phys_add_force(system, f == 1 ? group : 0, &forces[f]);
    PhysParticle p = {.mass = 1, .radius = 1};
    p.position = VEC(5);
    phys_add_particle(system, 0, &p);
    p.position = VEC(3.5);
    phys_add_particle(system, group, &p);
    p.position = VEC(2);
    p.force = VEC(-0.5);
    phys_add_particle(system, group, &p);
    return system;
}

static void test_order_of_summation(void **state) {
    (void)state;
    static const struct {
        uint32_t force, partner;
    } order[] = {
        {PHYS_OWN_FORCE, PHYS_NO_PARTNER},
        {4, 0},
        {2, 1},
        {3, 1}, // the partner in the same group, with both pair forces
        {2, 0}, // then the one in the enclosing group
        {1, PHYS_NO_PARTNER},
        {0, PHYS_NO_PARTNER},
    };
    static const double values[] = {-0.5, 3, 0.25, -0.5, 1 / 9.0, 0.125, -2};
    PhysSystem *system = describe_ordered();
    PhysExplanation found;
    one_step(system);
    assert_int_equal(phys_explain(system, 2, 0, &found), PHYS_OK);
    assert_int_equal(found.count, COUNT_OF(order));
    for (uint32_t c = 0; c < COUNT_OF(order); c++) {
        assert_int_equal(found.forces[c], order[c].force);
        assert_int_equal(found.partners[c], order[c].partner);
        assert_same(found.vectors[c], values[c]);
    }
    assert_same(found.position[0], 2);
    assert_same(found.velocity[0], 0);
    assert_same(found.delta, 1);
    check_last_step(system, 1, 1);
    phys_explanation_free(&found);
    phys_free(system);
}

// Each step of a frame can be explained: its forces lead to the velocities at the start of the next one.
static void test_every_step_of_a_frame(void **state) {
    (void)state;
    PhysSystem *system = describe_ordered();
    assert_int_equal(run_until(system, 0.5, 0.0625).steps, 8);
    assert_int_equal(phys_explained_steps(system), 8);
    PhysExplanation before, after;
    for (uint64_t step = 0; step + 1 < 8; step++) {
        assert_int_equal(phys_explain(system, 2, step, &before), PHYS_OK);
        assert_int_equal(phys_explain(system, 2, step + 1, &after), PHYS_OK);
        assert_same(before.clock, (double)step * 0.0625);
        assert_same(after.velocity[0], before.velocity[0] + before.sum[0] * (0.0625 / 1));
        assert_same(after.position[0], before.position[0] + after.velocity[0] * 0.0625);
        phys_explanation_free(&before);
        phys_explanation_free(&after);
    }
    phys_free(system);
}

static void test_nothing_to_explain(void **state) {
    (void)state;
    PhysSystem *system = describe_ordered();
    assert_int_equal(phys_explained_steps(system), 0);
    one_step(system);
    assert_int_equal(phys_explained_steps(system), 1);
    assert_true(phys_skip_frame(system));
    assert_int_equal(phys_explained_steps(system), 0);
    phys_free(system);
    system = phys_new();
    describe_cloud(system, PHYS_DRAG, 2, 10);
    one_step(system);
    assert_int_equal(phys_explained_steps(system), 0); // without keep_forces
    phys_free(system);
}

// Memory and work are charged to the budget, and memory is released.
static void test_explanation_charges_the_budget_and_frees_memory(void **state) {
    (void)state;
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_C(1) << 40, NULL);
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 1, .budget = &budget, .keep_forces = true});
    describe_cloud(system, PHYS_GRAVITY, 3, 1000);
    run_until(system, 0.3, 0.1);
    size_t memory = budget.memory;
    uint64_t work = budget.work;
    PhysExplanation found;
    assert_int_equal(phys_explain(system, 0, 2, &found), PHYS_OK);
    assert_true(budget.memory > memory + 1000 * 6 * sizeof(double));
    assert_true(budget.work > work + 2 * 1000 * 999 / 2 / 20);
    phys_explanation_free(&found);
    assert_int_equal(budget.memory, memory);
    budget_begin(&budget, 1000, NULL);
    assert_int_equal(phys_explain(system, 0, 2, &found), PHYS_STOPPED);
    phys_explanation_free(&found);
    budget.memory_limit = memory + 20000;
    budget_begin(&budget, UINT64_C(1) << 40, NULL);
    assert_int_equal(phys_explain(system, 0, 2, &found), PHYS_NO_MEMORY);
    phys_explanation_free(&found);
    assert_int_equal(budget.memory, memory);
    phys_free(system);
}

// Kernels stop as soon as the interrupt flag is set, before the next charge checks it. The explanation is then
// incomplete.
static void test_interrupt_between_charges(void **state) {
    (void)state;
    atomic_bool interrupt = false;
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_C(1) << 40, &interrupt);
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 1, .budget = &budget, .keep_forces = true});
    describe_cloud(system, PHYS_GRAVITY, 3, 10);
    one_step(system);
    budget.next_check = UINT64_C(1) << 39;
    PhysExplanation found;
    assert_int_equal(phys_explain(system, 0, 0, &found), PHYS_OK);
    assert_int_equal(found.count, 9);
    phys_explanation_free(&found);
    atomic_store(&interrupt, true);
    budget.next_check = UINT64_C(1) << 39;
    assert_int_equal(phys_explain(system, 0, 0, &found), PHYS_STOPPED);
    phys_explanation_free(&found);
    phys_free(system);
}

TEST_GROUP(explain) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_systems),
        cmocka_unit_test(test_each_force),
        cmocka_unit_test(test_order_of_summation),
        cmocka_unit_test(test_every_step_of_a_frame),
        cmocka_unit_test(test_nothing_to_explain),
        cmocka_unit_test(test_explanation_charges_the_budget_and_frees_memory),
        cmocka_unit_test(test_interrupt_between_charges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
