// test_laws.c: laws of nature that a system must obey, whatever the order of its sums.
#include "support.h"

static const double TAU = 6.283185307179586;

// One particle in n dimensions at the origin, with given forces to come.
static PhysSystem *lone_particle(uint32_t n, const PhysParticle *particle) {
    PhysSystem *system = phys_new();
    phys_begin(system, n);
    phys_add_particle(system, 0, particle);
    return system;
}

// Total momentum stays, in 1 to 4 dimensions, under each pair force and a link.
static void check_momentum(uint32_t n, PhysForceKind kind) {
    Dice dice = {n * 100 + kind + 1};
    PhysSystem *system = phys_new();
    double mass[30], before[4] = {0}, size = 0;
    phys_begin(system, n);
    for (uint32_t i = 0; i < 30; i++) {
        double position[4], velocity[4];
        mass[i] = dice_between(&dice, 0.5, 2);
        for (uint32_t k = 0; k < n; k++) {
            position[k] = dice_between(&dice, -1, 1);
            velocity[k] = dice_between(&dice, -1, 1);
            before[k] += mass[i] * velocity[k];
        }
        PhysParticle p = {.position = position, .velocity = velocity, .mass = mass[i]};
        p.radius = dice_between(&dice, 0.1, 0.3);
        p.charge = dice_between(&dice, -1, 1);
        phys_add_particle(system, 0, &p);
    }
    PhysForce force = force_of(kind);
    force.has_minimum = true;
    force.minimum = 3;
    force.to = 1;
    phys_add_force(system, 0, &force);
    run_until(system, 1, 0.01);
    for (uint32_t k = 0; k < n; k++) {
        double after = 0;
        for (uint32_t i = 0; i < 30; i++) {
            after += mass[i] * phys_velocity(system, i)[k];
            size += fabs(mass[i] * phys_velocity(system, i)[k]);
        }
        assert_near(after, before[k], 1e-13 * (1 + size) * 100);
    }
    phys_free(system);
}

static void test_momentum(void **state) {
    (void)state;
    for (uint32_t n = 1; n <= 4; n++)
        for (int kind = PHYS_COLLISION; kind <= PHYS_DISTANCE; kind++)
            check_momentum(n, (PhysForceKind)kind);
}

// The scheme updates the velocity first: after m steps of d the particle has fallen g d² m (m + 1) / 2.
static void test_free_fall(void **state) {
    (void)state;
    PhysParticle p = {.position = VEC(3, 0), .velocity = VEC(1, 0), .mass = 7};
    PhysSystem *system = lone_particle(2, &p);
    PhysForce fall = force_of(PHYS_CONSTANT);
    fall.vector2 = VEC(0, -9.81);
    phys_add_force(system, 0, &fall);
    assert_int_equal(run_until(system, 2, 1.0 / 128).steps, 256);
    assert_near(phys_position(system, 0)[0], 5, 1e-12);
    assert_near(phys_position(system, 0)[1], -9.81 / 128 / 128 * 256 * 257 / 2, 1e-10);
    assert_near(phys_velocity(system, 0)[1], -9.81 * 2, 1e-10);
    phys_free(system);
}

// A mass on a spring swings with the period 2π sqrt(m / strength).
static void test_spring_period(void **state) {
    (void)state;
    PhysParticle p = {.position = VEC(1.25, 0), .mass = 4};
    PhysSystem *system = lone_particle(2, &p);
    PhysParticle anchor = {.anchor = true};
    phys_add_particle(system, 0, &anchor);
    PhysForce spring = force_of(PHYS_DISTANCE);
    spring.has_minimum = spring.has_maximum = true;
    spring.minimum = spring.maximum = 1;
    spring.strength = 25;
    spring.to = 1;
    phys_add_force(system, 0, &spring);
    double period = TAU * sqrt(4.0 / 25);
    run_until(system, period / 2, 1e-4);
    assert_near(phys_position(system, 0)[0], 0.75, 1e-4);
    run_until(system, period / 2, 1e-4);
    assert_near(phys_position(system, 0)[0], 1.25, 1e-4);
    run_until(system, period * 10, 1e-4);
    assert_near(phys_position(system, 0)[0], 1.25, 1e-3);
    phys_free(system);
}

// Falling through air ends at the speed at which drag equals weight: S v² r^(n-1) = m g.
static void test_terminal_velocity(void **state) {
    (void)state;
    for (uint32_t n = 1; n <= 4; n++) {
        PhysParticle p = {.mass = 2, .radius = 0.5};
        PhysSystem *system = lone_particle(n, &p);
        PhysForce fall = force_of(PHYS_CONSTANT), drag = force_of(PHYS_DRAG);
        fall.vector2 = VEC(-10, 0, 0, 0);
        drag.strength = 0.3;
        phys_add_force(system, 0, &fall);
        phys_add_force(system, 0, &drag);
        run_until(system, 60, 0.01);
        assert_near(phys_velocity(system, 0)[0], -sqrt(2 * 10 / (0.3 * pow(0.5, n - 1.0))), 1e-6);
        phys_free(system);
    }
}

// Drag never turns a particle round, however strong; a flow takes it along at most at its own speed.
static void test_drag_never_reverses(void **state) {
    (void)state;
    const double strengths[] = {1e-3, 1, 1e3, 1e9, 1e300};
    for (size_t i = 0; i < COUNT_OF(strengths); i++) {
        PhysParticle p = {.velocity = VEC(5, -3), .mass = 0.1, .radius = 2};
        PhysSystem *system = lone_particle(2, &p);
        PhysForce drag = force_of(PHYS_DRAG);
        drag.strength = strengths[i];
        phys_add_force(system, 0, &drag);
        for (int step = 0; step < 50; step++) {
            run_until(system, 0.1, 0.1);
            assert_true(phys_velocity(system, 0)[0] >= -1e-15 && phys_velocity(system, 0)[0] <= 5);
            assert_true(phys_velocity(system, 0)[1] <= 1e-15 && phys_velocity(system, 0)[1] >= -3);
        }
        phys_free(system);
    }
}

static void test_flow(void **state) {
    (void)state;
    PhysParticle p = {.mass = 1, .radius = 1};
    PhysSystem *system = lone_particle(2, &p);
    PhysForce drag = force_of(PHYS_DRAG);
    drag.vector = VEC(2, -1);
    phys_add_force(system, 0, &drag);
    run_until(system, 1e4, 0.1);
    assert_near(phys_velocity(system, 0)[0], 2, 1e-3);
    assert_near(phys_velocity(system, 0)[1], -1, 1e-3);
    phys_free(system);
}

// A circular orbit stays one: radius and energy after 20 turns.
static void test_orbit(void **state) {
    (void)state;
    PhysParticle planet = {.position = VEC(1, 0), .velocity = VEC(0, 1), .mass = 1e-9};
    PhysSystem *system = lone_particle(2, &planet);
    PhysParticle sun = {.mass = 1, .anchor = true};
    phys_add_particle(system, 0, &sun);
    PhysForce gravity = force_of(PHYS_GRAVITY);
    phys_add_force(system, 0, &gravity);
    run_until(system, 20 * TAU, 1e-3);
    const double *p = phys_position(system, 0), *v = phys_velocity(system, 0);
    double radius = hypot(p[0], p[1]), energy = (v[0] * v[0] + v[1] * v[1]) / 2 - 1 / radius;
    assert_near(radius, 1, 2e-3);
    assert_near(energy, -0.5, 1e-5);
    assert_near(p[0] * v[1] - p[1] * v[0], 1, 1e-10); // area law, exact for this scheme but for rounding
    assert_near(p[0], 1, 1e-2);
    phys_free(system);
}

// In a field the acceleration is proportional to q / m.
static void test_field(void **state) {
    (void)state;
    const double charges[] = {2, -3, 0}, masses[] = {4, 0.5, 1};
    for (int i = 0; i < 3; i++) {
        PhysParticle p = {.mass = masses[i], .charge = charges[i]};
        PhysSystem *system = lone_particle(3, &p);
        PhysForce field = force_of(PHYS_FIELD);
        field.vector = VEC(0, 1, -2);
        field.strength = 0.25;
        phys_add_force(system, 0, &field);
        run_until(system, 4, 1.0 / 64);
        double acceleration = 0.25 * charges[i] / masses[i];
        assert_near(phys_velocity(system, 0)[1], 4 * acceleration, 1e-12);
        assert_near(phys_velocity(system, 0)[2], -8 * acceleration, 1e-12);
        phys_free(system);
    }
}

// Density of the particle against that of the fluid decides between rising, floating and sinking.
static void test_buoyancy(void **state) {
    (void)state;
    const double masses[] = {0.5, 1, 2};
    for (int i = 0; i < 3; i++) {
        PhysParticle p = {.mass = masses[i], .radius = 2};
        PhysSystem *system = lone_particle(3, &p);
        PhysForce buoyancy = force_of(PHYS_BUOYANCY);
        buoyancy.vector = VEC(0, 0, -1);
        buoyancy.density = 0.125;
        phys_add_force(system, 0, &buoyancy);
        run_until(system, 1, 0.125);
        assert_near(phys_velocity(system, 0)[2], -(masses[i] - 1) / masses[i], 1e-12);
        phys_free(system);
    }
}

// Eased in over E, a constant force of 1 gives after time t < E the velocity t² / 2E, then t − E / 2.
static void test_ease(void **state) {
    (void)state;
    PhysParticle p = {.mass = 1, .force = VEC(1), .ease = 2};
    PhysSystem *system = lone_particle(1, &p);
    run_until(system, 1, 1e-4);
    assert_near(phys_velocity(system, 0)[0], 1.0 / 4, 1e-4);
    PhysTime time = {.last = 1, .clock = 1, .now = 5, .resolution = 1e-4, .lockstep = true};
    phys_simulate(system, &time);
    assert_near(phys_velocity(system, 0)[0], 4, 1e-3);
    phys_free(system);
}

// Two balls that collide on a line exchange their velocities.
static void test_collision_exchanges(void **state) {
    (void)state;
    PhysParticle a = {.position = VEC(-2), .velocity = VEC(1), .radius = 0.5, .mass = 1}, b = a;
    b.position = VEC(2);
    b.velocity = VEC(-0.5);
    PhysSystem *system = lone_particle(1, &a);
    phys_add_particle(system, 0, &b);
    PhysForce collision = force_of(PHYS_COLLISION);
    collision.strength = 1000;
    phys_add_force(system, 0, &collision);
    run_until(system, 5, 1e-4);
    assert_near(phys_velocity(system, 0)[0], -0.5, 1e-3);
    assert_near(phys_velocity(system, 1)[0], 1, 1e-3);
    phys_free(system);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_momentum),
        cmocka_unit_test(test_free_fall),
        cmocka_unit_test(test_spring_period),
        cmocka_unit_test(test_terminal_velocity),
        cmocka_unit_test(test_drag_never_reverses),
        cmocka_unit_test(test_flow),
        cmocka_unit_test(test_orbit),
        cmocka_unit_test(test_field),
        cmocka_unit_test(test_buoyancy),
        cmocka_unit_test(test_ease),
        cmocka_unit_test(test_collision_exchanges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
