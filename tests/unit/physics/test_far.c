// test_far.c: forces with `theta` (spec far-field.md): accuracy, limits, hostile input and explanations.
// test_variants.c compares variants, and tests/physics/far_field.py checks all bits.
#include "physics/explain.h"
#include "physics/forces.h"
#include "support.h"

enum { COUNT = 3000 };

// DECADES: distances over 600 powers of ten; DISTANT: one particle is so far away that the keys of the others are
// equal.
typedef enum Layout { CUBE, CLUSTER, PLANE, ONE_POINT, DECADES, DISTANT } Layout;

typedef struct Setup {
    uint32_t dimensions, count;
    Layout layout;
    PhysForce force;
    double radius;
    bool neutral; // charges of both signs
    double scale; // factor of all positions; 0: 1
    Budget *budget;
    bool keep_forces;
} Setup;

static PhysForce far_force(PhysForceKind kind, double theta) {
    PhysForce force = force_of(kind);
    force.theta = theta;
    return force;
}

static void place(const Setup *setup, Dice *dice, double *position) {
    for (uint32_t k = 0; k < 4; k++) {
        double x = dice_between(dice, -1, 1);
        if (setup->layout == CLUSTER)
            x = x * x * x * x * x;
        if (setup->layout == ONE_POINT || (setup->layout == PLANE && k == 1))
            x = 0.25;
        if (setup->layout == DECADES)
            x = pow(10, 300 * x);
        position[k] = x * (setup->scale > 0 ? setup->scale : 1);
    }
}

static PhysSystem *make_system(const Setup *setup) {
    Dice dice = {setup->count * 31 + setup->dimensions};
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 2,
                                            .cpu = cpu_detected.level,
                                            .budget = setup->budget,
                                            .keep_forces = setup->keep_forces});
    phys_begin(system, setup->dimensions);
    for (uint32_t i = 0; i < setup->count; i++) {
        double position[4];
        place(setup, &dice, position);
        if (setup->layout == DISTANT && i == setup->count / 2)
            position[0] = 1e300;
        double charge = setup->neutral && i % 2 ? -1 : 1;
        phys_add_particle(system, 0,
                          &(PhysParticle){.position = position, .mass = 1, .charge = charge, .radius = setup->radius});
    }
    phys_add_force(system, 0, &setup->force);
    return system;
}

// Returns the velocities after one step, which equal the forces.
static double *forces_of(const Setup *setup) {
    PhysSystem *system = make_system(setup);
    one_step(system);
    double *forces = calloc(setup->count, setup->dimensions * sizeof *forces);
    for (uint32_t i = 0; i < setup->count; i++)
        memcpy(forces + (size_t)i * setup->dimensions, phys_velocity(system, i), setup->dimensions * sizeof *forces);
    phys_free(system);
    return forces;
}

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Returns the relative error of the force below which 99 % of the particles are.
static double error_of(Setup setup) {
    double *found = forces_of(&setup), errors[COUNT];
    setup.force.theta = 0;
    double *exact = forces_of(&setup);
    for (uint32_t i = 0; i < setup.count; i++) {
        double difference = 0, square = 0;
        for (size_t k = (size_t)i * setup.dimensions; k < (size_t)(i + 1) * setup.dimensions; k++) {
            difference += (found[k] - exact[k]) * (found[k] - exact[k]);
            square += exact[k] * exact[k];
        }
        errors[i] = sqrt(difference / square);
    }
    qsort(errors, setup.count, sizeof *errors, compare_numbers);
    free(found);
    free(exact);
    return errors[setup.count * 99 / 100];
}

// Masses all attract each other; charges are a neutral mixture.
static void check_errors(PhysForceKind kind, uint32_t n, Layout layout) {
    bool neutral = phys_force_row(kind).need == NEED_CHARGE;
    Setup setup = {.dimensions = n, .count = COUNT, .layout = layout, .neutral = neutral};
    setup.force = far_force(kind, 0.3);
    double precise = error_of(setup), limit = neutral ? 0.02 : 0.001;
    assert_true(precise > 1e-12);
    assert_true(precise < limit);
    setup.force.theta = 0.9;
    double coarse = error_of(setup);
    assert_true(coarse > precise);
    assert_true(coarse < 60 * limit);
}

static void test_errors_shrink_with_theta(void **state) {
    (void)state;
    for (int kind = 0; kind < PHYS_FORCE_KINDS; kind++)
        for (uint32_t n = 2; n <= 3 && phys_force_row((PhysForceKind)kind).reach == REACH_INVERSE_SQUARE; n++)
            for (int layout = CUBE; layout <= PLANE; layout++)
                check_errors((PhysForceKind)kind, n, (Layout)layout);
}

static void check_identical(Setup setup, Setup other) {
    double *a = forces_of(&setup), *b = forces_of(&other);
    assert_memory_equal(a, b, (size_t)setup.count * setup.dimensions * sizeof *a);
    free(a);
    free(b);
}

static void test_theta_without_effect(void **state) {
    (void)state;
    Setup setup = {.dimensions = 3, .count = PHYS_FAR_MIN_PARTICLES - 1, .force = far_force(PHYS_GRAVITY, 1)};
    Setup exact = setup;
    exact.force.theta = 0;
    check_identical(setup, exact);
    const double thetas[] = {0, -1, NAN, -INFINITY};
    for (size_t i = 0; i < COUNT_OF(thetas); i++) {
        setup.count = exact.count = 1100;
        setup.force.theta = thetas[i];
        check_identical(setup, exact);
    }
    setup.force.theta = 1;
    for (uint32_t n = 1; n <= 4; n += 3) {
        setup.dimensions = exact.dimensions = n;
        check_identical(setup, exact);
    }
}

// The overlapping particles are computed exactly, so the forces are as precise as without radii.
static void test_overlapping_particles_are_computed_exactly(void **state) {
    (void)state;
    Setup setup = {.dimensions = 3, .count = COUNT, .force = far_force(PHYS_GRAVITY, 0.5), .radius = 0.1};
    assert_true(error_of(setup) < 0.005);
    setup.radius = 9; // all particles overlap
    assert_true(error_of(setup) < 1e-12);
}

static void test_max_distance(void **state) {
    (void)state;
    Setup setup = {.dimensions = 3, .count = COUNT, .force = far_force(PHYS_GRAVITY, 0.5)};
    for (double distance = 0.5; distance < 4; distance *= 2) {
        setup.force.max_distance = distance;
        assert_true(error_of(setup) < 0.02);
    }
    setup.force.max_distance = 1e-9; // no pair is near enough
    double *forces = forces_of(&setup);
    for (size_t k = 0; k < (size_t)COUNT * 3; k++)
        assert_same(forces[k], 0);
    free(forces);
}

static void test_coincident_bodies(void **state) {
    (void)state;
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_C(200000000), NULL); // two seconds; all pairs would take an hour
    Setup setup = {.dimensions = 3, .count = 1000000, .layout = ONE_POINT, .force = far_force(PHYS_GRAVITY, 0.5)};
    setup.budget = &budget;
    double *forces = forces_of(&setup);
    for (size_t k = 0; k < (size_t)setup.count * 3; k++)
        assert_same(forces[k], 0);
    free(forces);
}

static void test_extreme_coordinates(void **state) {
    (void)state;
    const double scales[] = {1e300, 1.7e308, 1e150, 1e-150, 1e-300, 5e-324};
    for (size_t i = 0; i < COUNT_OF(scales); i++)
        for (uint32_t n = 2; n <= 3; n++) {
            Setup setup = {.dimensions = n, .count = 1100, .scale = scales[i], .force = far_force(PHYS_GRAVITY, 0.7)};
            double *forces = forces_of(&setup);
            for (size_t k = 0; k < (size_t)setup.count * n; k++)
                assert_false(isnan(forces[k]));
            free(forces);
        }
}

// A body far away does not make the others slow: they are still in different cells.
static void test_distant_body(void **state) {
    (void)state;
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_C(10000000), NULL); // all pairs take 9 times as long
    Setup setup = {.dimensions = 3, .count = 60000, .force = far_force(PHYS_GRAVITY, 0.7), .budget = &budget};
    PhysSystem *system = make_system(&setup);
    phys_add_particle(system, 0, &(PhysParticle){.position = VEC(1e9, 0, 0), .mass = 1});
    one_step(system);
    phys_free(system);
}

// Setups in which the tree saves nothing. Such forces are those of all pairs.
static Setup useless_setup(int number, uint32_t count) {
    Setup setup = {.dimensions = 2 + (uint32_t)number % 2, .count = count, .force = far_force(PHYS_GRAVITY, 0.7)};
    setup.layout = number < 2 ? DECADES : number < 4 ? DISTANT : CUBE;
    setup.radius = number < 4 ? 0 : number < 6 ? 1e300 : 20;
    return setup;
}

static void test_useless_tree(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++)
        for (uint32_t count = PHYS_FAR_MIN_PARTICLES; count <= COUNT; count += COUNT - PHYS_FAR_MIN_PARTICLES) {
            Setup setup = useless_setup(i, count), exact = setup;
            exact.force.theta = 0;
            check_identical(setup, exact);
        }
}

// Work is charged before it is done: all pairs of 300 000 particles exceed the default limit. They take a minute.
static void test_useless_tree_is_charged_first(void **state) {
    (void)state;
    for (int i = 0; i < 8; i++) {
        Budget budget = {.memory_limit = SIZE_MAX};
        Setup setup = useless_setup(i, 300000);
        setup.budget = &budget;
        budget_begin(&budget, UINT64_C(1) << 30, NULL);
        PhysSystem *system = make_system(&setup);
        PhysResult result = run_until(system, 1, 1);
        assert_int_equal(result.status, PHYS_STOPPED);
        assert_int_equal(result.steps, 0);
        phys_free(system);
    }
}

static void test_work_limit(void **state) {
    (void)state;
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_MAX / 2, NULL);
    Setup setup = {.dimensions = 3, .count = COUNT, .force = far_force(PHYS_GRAVITY, 0.3), .budget = &budget};
    PhysSystem *system = make_system(&setup);
    double start = phys_position(system, 5)[0];
    budget_begin(&budget, 60000, NULL);
    PhysResult result = run_until(system, 1, 1);
    assert_int_equal(result.status, PHYS_STOPPED);
    assert_int_equal(result.steps, 0);
    assert_same(phys_position(system, 5)[0], start);
    phys_free(system);
}

static void test_memory_limit(void **state) {
    (void)state;
    Budget budget = {.memory_limit = SIZE_MAX};
    budget_begin(&budget, UINT64_MAX / 2, NULL);
    Setup setup = {.dimensions = 3, .count = 20000, .force = far_force(PHYS_GRAVITY, 0.9), .budget = &budget};
    int failures = 0;
    for (size_t limit = 4 << 20; limit < 16 << 20; limit += 1 << 20) {
        budget.memory_limit = SIZE_MAX;
        PhysSystem *system = make_system(&setup);
        budget.memory_limit = limit;
        PhysStatus status = run_until(system, 1, 1).status;
        assert_true(status == PHYS_OK || status == PHYS_NO_MEMORY);
        failures += status == PHYS_NO_MEMORY;
        phys_free(system);
    }
    assert_true(failures > 0 && failures < 12);
}

// Adds the contributions of an explanation, and compares the sum with the force of the step.
static void check_explanation(const PhysSystem *system, uint32_t particle, uint32_t min_count) {
    PhysExplanation explanation;
    PhysColumns columns = phys_columns(system);
    const double *force = phys_at_particle(columns.force, particle);
    assert_int_equal(phys_explain(system, particle, 0, &explanation), PHYS_OK);
    assert_true(explanation.count >= min_count);
    double sum[3] = {0, 0, 0};
    for (uint32_t c = 0; c < explanation.count; c++)
        for (size_t k = 0; k < 3; k++)
            sum[k] += explanation.vectors[c * 3 + k];
    for (size_t k = 0; k < 3; k++) {
        assert_same(sum[k], force[k]);
        assert_same(explanation.sum[k], force[k]);
    }
    phys_explanation_free(&explanation);
}

// `radius`: of the inner particles
static void check_explanations(double radius) {
    Setup setup = {.dimensions = 3, .count = COUNT, .force = far_force(PHYS_GRAVITY, 0.8), .radius = 0.02};
    setup.keep_forces = true;
    PhysSystem *system = make_system(&setup);
    PhysForce charges = far_force(PHYS_ELECTROSTATIC, 1.1), collision = force_of(PHYS_COLLISION);
    Dice dice = {5};
    enum { INNER = 1100 };
    uint32_t inner = phys_add_group(system, 0), small = phys_add_group(system, inner);
    for (uint32_t i = 0; i < INNER + 10; i++)
        phys_add_particle(system, i < INNER ? inner : small,
                          &(PhysParticle){.position = VEC(dice_between(&dice, -1, 1), dice_between(&dice, -1, 1), 0),
                                          .mass = 2,
                                          .charge = 1,
                                          .radius = radius});
    phys_add_force(system, 0, &charges);
    phys_add_force(system, inner, &collision);
    phys_add_force(system, inner, &charges);
    one_step(system);
    for (uint32_t i = 0; i < COUNT; i += 397)
        check_explanation(system, i, 2);
    for (uint32_t i = COUNT; i < COUNT + INNER + 10; i += 203)
        check_explanation(system, i, 4);
    check_explanation(system, COUNT + INNER + 9, INNER); // in a small group, whose pairs are exact
    if (radius > 10)
        check_explanation(system, COUNT, INNER); // in a group whose pairs are exact because the tree does not pay
    phys_free(system);
}

static void test_contributions_of_far_fields_add_up(void **state) {
    (void)state;
    check_explanations(0.05);
    check_explanations(20);
}

TEST_GROUP(far) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_errors_shrink_with_theta),
        cmocka_unit_test(test_theta_without_effect),
        cmocka_unit_test(test_overlapping_particles_are_computed_exactly),
        cmocka_unit_test(test_max_distance),
        cmocka_unit_test(test_coincident_bodies),
        cmocka_unit_test(test_extreme_coordinates),
        cmocka_unit_test(test_distant_body),
        cmocka_unit_test(test_useless_tree),
        cmocka_unit_test(test_useless_tree_is_charged_first),
        cmocka_unit_test(test_work_limit),
        cmocka_unit_test(test_memory_limit),
        cmocka_unit_test(test_contributions_of_far_fields_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
