// test_energy.c: each force is the negative gradient of its potential energy, and total energy is conserved.
#include "physics/energy.h"
#include "support.h"

enum { BODIES = 8, N = 3 };

typedef enum Variant { PLAIN, EXPONENT, EASED, BOUNDED, GROUPED, TOO_NEAR, TOO_FAR, VARIANTS } Variant;

typedef struct Setup {
    PhysForce force;
    uint32_t group; // that declares the force
} Setup;

static const double places[BODIES][N] = {{0, 0, 0},       {1.1, 0.3, -0.2},  {-0.7, 0.9, 0.4},  {0.2, -1.3, 0.8},
                                         {1.7, 1.2, 0.5}, {-1.1, -0.6, 1.4}, {0.9, -0.8, -1.2}, {2.6, 0.1, 0.3}};

// Group 2 is inside group 1, and group 3 is not.
static const uint32_t group_of[BODIES] = {0, 0, 0, 2, 1, 1, 3, 2};

// Returns a force with all attributes that any kind of force reads.
static Setup setup_of(PhysForceKind kind, Variant variant) {
    static const double vector[N] = {0.4, -0.7, 0.3}, normal[N] = {0.6, 0.8, 0};
    return (Setup){{.kind = kind,
                    .strength = 2,
                    .power = variant == EXPONENT ? 1.7 : 1,
                    .ease = variant == EASED,
                    .max_distance = variant == BOUNDED ? 1.6 : 0,
                    .overlap = 0.3,
                    .density = 0.8,
                    .has_minimum = variant != TOO_FAR,
                    .has_maximum = variant != TOO_NEAR,
                    .minimum = variant == TOO_NEAR ? 4 : 1,
                    .maximum = variant == TOO_FAR ? 0.1 : 1.5,
                    .from = 7,
                    .to = 1,
                    .vector = vector,
                    .vector2 = normal},
                   variant == GROUPED};
}

// Particle `moved` is displaced by `offset` in dimension k.
static PhysSystem *make_system(const Setup *setup, uint32_t moved, size_t k, double offset) {
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 1, .cpu = cpu_detected.level, .keep_forces = true});
    phys_begin(system, N);
    phys_add_group(system, 0);
    phys_add_group(system, 1);
    phys_add_group(system, 0);
    for (uint32_t i = 0; i < BODIES; i++) {
        double position[N];
        memcpy(position, places[i], sizeof position);
        position[k] += i == moved ? offset : 0;
        phys_add_particle(system, group_of[i],
                          &(PhysParticle){.position = position,
                                          .radius = i == 6 ? 0 : 0.5 + 0.1 * i,
                                          .mass = 1 + 0.3 * i,
                                          .charge = i % 2 ? 0.7 : -1.2,
                                          .anchor = i == 2 || i == 5});
    }
    phys_add_force(system, setup->group, &setup->force);
    return system;
}

static double energy_of(const Setup *setup, uint32_t moved, size_t k, double offset, double clock) {
    double energy;
    PhysSystem *system = make_system(setup, moved, k, offset);
    assert_int_equal(phys_potential_energy(system, 0, clock, &energy), PHYS_OK);
    phys_free(system);
    return energy;
}

static void check_gradient(PhysForceKind kind, Variant variant) {
    const double h = 1e-5, clock = 0.25;
    Setup setup = setup_of(kind, variant);
    PhysSystem *system = make_system(&setup, BODIES, 0, 0);
    PhysTime time = {.now = 1e-3, .clock = clock, .resolution = 1, .lockstep = true};
    assert_int_equal(phys_simulate(system, &time).status, PHYS_OK);
    double largest = 0;
    for (uint32_t i = 0; i < BODIES; i++)
        for (size_t k = 0; k < N; k++) {
            if (phys_is_anchor(system, i))
                continue;
            double force = phys_at_particle(phys_columns(system).force, i)[k];
            double slope = (energy_of(&setup, i, k, h, clock) - energy_of(&setup, i, k, -h, clock)) / (2 * h);
            if (fabs(force + slope) > 1e-6 * (1 + fabs(force)))
                print_error("force %d, variant %d, particle %u, component %d: force %g, slope %g\n", kind, variant, i,
                            (int)k, force, slope);
            assert_true(fabs(force + slope) <= 1e-6 * (1 + fabs(force)));
            largest = fmax(largest, fabs(force));
        }
    if (largest <= 0.01)
        print_error("force %d, variant %d has no effect\n", kind, variant);
    assert_true(largest > 0.01);
    phys_free(system);
}

static bool has_potential(PhysForceKind kind) {
    Setup setup = setup_of(kind, PLAIN);
    return !isnan(energy_of(&setup, BODIES, 0, 0, 0));
}

static void test_forces_are_gradients(void **state) {
    (void)state;
    for (int kind = 0; kind < PHYS_FORCE_KINDS; kind++)
        for (int variant = 0; variant < VARIANTS && has_potential((PhysForceKind)kind); variant++)
            check_gradient((PhysForceKind)kind, (Variant)variant);
}

// Anchors do not move, so a force between two of them does no work.
static void test_links_of_two_anchors_have_no_energy(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    for (uint32_t i = 0; i < 3; i++)
        phys_add_particle(system, 0, &(PhysParticle){.position = VEC(3.0 * i), .mass = 1, .anchor = i < 2});
    PhysForce link = force_of(PHYS_DISTANCE);
    link.has_maximum = true;
    link.maximum = 1;
    static const double wanted[][3] = {{0, 1, 0}, {1, 2, 2}, {2, 0, 12.5}, {2, 3, 0}};
    for (size_t i = 0; i < COUNT_OF(wanted); i++) {
        double energy;
        link.from = (uint32_t)wanted[i][0];
        link.to = (uint32_t)wanted[i][1];
        uint32_t number = phys_add_force(system, 0, &link);
        assert_int_equal(phys_potential_energy(system, number, 0, &energy), PHYS_OK);
        assert_same(energy, wanted[i][2]);
    }
    phys_free(system);
}

static void test_forces_without_potential(void **state) {
    (void)state;
    for (int kind = 0; kind < PHYS_FORCE_KINDS; kind++)
        assert_int_equal(has_potential((PhysForceKind)kind), kind != PHYS_DRAG && kind != PHYS_RANDOM);
}

// --- conservation

static double total_energy(const PhysSystem *system, double clock) {
    double total = 0, energy;
    for (uint32_t f = 0; f < phys_force_count(system); f++) {
        assert_int_equal(phys_potential_energy(system, f, clock, &energy), PHYS_OK);
        total += energy;
    }
    for (uint32_t i = 0; i < phys_particle_count(system); i++)
        for (size_t k = 0; k < N; k++) {
            double v = phys_velocity(system, i)[k];
            total += phys_is_anchor(system, i) ? 0 : *phys_at_particle(phys_columns(system).mass, i) * v * v / 2;
        }
    return total;
}

// The integrator is symplectic, so that the error of the energy stays within a band whose width is proportional to the
// step.
static void check_conserved(const char *row, const PhysForce *forces, uint32_t count) {
    enum { FRAMES = 400 };
    const double step = 1e-4;
    PhysSystem *system = phys_new();
    phys_set_options(system, &(PhysOptions){.threads = 1, .cpu = cpu_detected.level});
    phys_begin(system, N);
    for (uint32_t i = 0; i < BODIES; i++)
        phys_add_particle(system, 0,
                          &(PhysParticle){.position = places[i],
                                          .velocity = places[(i + 3) % BODIES],
                                          .radius = 0.5,
                                          .mass = 1 + 0.1 * i,
                                          .charge = 1,
                                          .anchor = i == 2});
    for (uint32_t f = 0; f < count; f++)
        phys_add_force(system, 0, &forces[f]);
    double start = total_energy(system, 0), largest = 0, potential = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        PhysTime time = {.last = 50 * step * frame, .now = 50 * step * (frame + 1), .clock = 50 * step * frame};
        time.resolution = step;
        time.lockstep = true;
        assert_int_equal(phys_simulate(system, &time).status, PHYS_OK);
        largest = fmax(largest, fabs(total_energy(system, time.now) - start));
        double energy;
        assert_int_equal(phys_potential_energy(system, 0, time.now, &energy), PHYS_OK);
        potential = fmax(potential, fabs(energy));
    }
    if (largest > 1e-3 * fmax(fabs(start), potential) || potential < 0.01 * fabs(start))
        print_error("%s: energy %g, largest error %g, potential energy up to %g\n", row, start, largest, potential);
    assert_true(largest <= 1e-3 * fmax(fabs(start), potential));
    assert_true(potential >= 0.01 * fabs(start));
    phys_free(system);
}

static void test_energy_is_conserved(void **state) {
    (void)state;
    static const double down[N] = {0, 0, -1}, up[N] = {0, 0, 1};
    const PhysForce spring = {.kind = PHYS_DISTANCE,
                              .strength = 20,
                              .power = 1,
                              .has_minimum = true,
                              .has_maximum = true,
                              .minimum = 1,
                              .maximum = 1.2};
    PhysForce springs[BODIES];
    for (uint32_t i = 0; i < BODIES; i++) {
        springs[i] = spring;
        springs[i].from = i;
        springs[i].to = (i + 1) % BODIES;
    }
    check_conserved("gravity", &(PhysForce){.kind = PHYS_GRAVITY, .strength = 3}, 1);
    check_conserved("springs", springs, BODIES);
    check_conserved(
        "collisions",
        (PhysForce[]){{.kind = PHYS_COLLISION, .strength = 500, .power = 1}, {.kind = PHYS_GRAVITY, .strength = 3}}, 2);
    check_conserved("bouncing on a barrier",
                    (PhysForce[]){{.kind = PHYS_CONSTANT, .strength = 5, .vector2 = down},
                                  {.kind = PHYS_BARRIER,
                                   .strength = 300,
                                   .power = 1,
                                   .has_minimum = true,
                                   .minimum = 1,
                                   .vector = (const double[N]){0, 0, -4},
                                   .vector2 = up}},
                    2);
}

// The energy of a contact force is the sum over all pairs whose groups are the same or enclose each other. All numbers
// are multiples of 1/64, so sums in any order are exact.
static void test_energy_counts_each_pair_of_nested_groups(void **state) {
    enum { COUNT = 400 };
    static const uint32_t groups[] = {0, 0, 1, 0, 0, 2, 0, 3};
    static const bool interact[4][4] = {{1, 1, 1, 1}, {1, 1, 1, 0}, {1, 1, 1, 0}, {1, 0, 0, 1}};
    double wanted = 0, energy, places_1d[COUNT];
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    phys_add_group(system, 0);
    phys_add_group(system, 1);
    phys_add_group(system, 0);
    for (uint32_t i = 0; i < COUNT; i++) {
        places_1d[i] = i * 7919 % 1600 / 8.0;
        phys_add_particle(system, groups[i % COUNT_OF(groups)],
                          &(PhysParticle){.position = &places_1d[i], .radius = 1, .mass = 1});
        for (uint32_t j = 0; j < i; j++) {
            double length = fabs(places_1d[i] - places_1d[j]);
            if (length > 0 && length < 2 && interact[groups[i % COUNT_OF(groups)]][groups[j % COUNT_OF(groups)]])
                wanted += (2 - length) * (2 - length);
        }
    }
    PhysForce force = force_of(PHYS_COLLISION);
    force.strength = 2;
    uint32_t number = phys_add_force(system, 0, &force);
    assert_int_equal(phys_potential_energy(system, number, 0, &energy), PHYS_OK);
    assert_same(energy, wanted);
    phys_free(system);
}

TEST_GROUP(energy) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forces_are_gradients),
        cmocka_unit_test(test_links_of_two_anchors_have_no_energy),
        cmocka_unit_test(test_forces_without_potential),
        cmocka_unit_test(test_energy_is_conserved),
        cmocka_unit_test(test_energy_counts_each_pair_of_nested_groups),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
