// test_forces.c: compares each force with the formula of section 4, calculated by hand.
//
// After one step of length 1, the velocity of a resting particle of mass 1 equals the force on it.
#include "maths/random.h"
#include "support.h"

// Returns the force on the first of two particles at 0 and `distance` on an axis. Checks that the force on the second
// is exactly opposite.
static double pair_force(PhysParticle a, PhysParticle b, double distance, const PhysForce *force) {
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    a.position = VEC(0, 0);
    b.position = VEC(distance, 0);
    phys_add_particle(system, 0, &a);
    phys_add_particle(system, 0, &b);
    phys_add_force(system, 0, force);
    one_step(system);
    double first = phys_velocity(system, 0)[0] * a.mass, second = phys_velocity(system, 1)[0] * b.mass;
    if (a.mass == 1 && b.mass == 1)
        assert_same(first, -second);
    assert_same(phys_velocity(system, 0)[1], 0);
    phys_free(system);
    return first;
}

static PhysParticle ball(double radius) {
    return (PhysParticle){.mass = 1, .radius = radius};
}

static PhysParticle charged(double charge) {
    return (PhysParticle){.mass = 1, .charge = charge};
}

static PhysForce link_of(double minimum, double maximum) {
    PhysForce force = force_of(PHYS_DISTANCE);
    force.has_minimum = minimum >= 0;
    force.minimum = minimum;
    force.has_maximum = maximum >= 0;
    force.maximum = maximum;
    force.from = 0;
    force.to = 1;
    return force;
}

static void test_link_acts_below_min_and_above_max(void **state) {
    (void)state;
    PhysForce force = link_of(2, 3);
    force.strength = 5;
    assert_same(pair_force(ball(0), ball(0), 1.5, &force), -0.5 * 5);
    assert_same(pair_force(ball(0), ball(0), 2, &force), 0);
    assert_same(pair_force(ball(0), ball(0), 3, &force), 0);
    assert_same(pair_force(ball(0), ball(0), 3.25, &force), 0.25 * 5);
    assert_same(pair_force(ball(0), ball(0), 0, &force), 0); // coincident particles have no direction
    force = link_of(-1, 0);                                  // with max=0 the link always pulls
    assert_same(pair_force(ball(0), ball(0), 0.5, &force), 0.5);
    force = link_of(0, -1); // with min=0 the link never pushes
    assert_same(pair_force(ball(0), ball(0), 0.5, &force), 0);
    force = link_of(3, 1); // if min > max, min has precedence
    assert_same(pair_force(ball(0), ball(0), 2, &force), -1);
}

static void test_distance_powers(void **state) {
    (void)state;
    PhysForce force = link_of(-1, 1);
    force.strength = 3;
    const double powers[] = {0, 0.5, 1, 2, 3, -2};
    const double values[] = {1, sqrt(1.75), 1.75, 1.75 * 1.75, pow(1.75, 3), 1};
    for (size_t i = 0; i < COUNT_OF(powers); i++) {
        force.power = powers[i];
        assert_same(pair_force(ball(0), ball(0), 2.75, &force), values[i] * 3);
    }
    force = link_of(2, -1);
    force.power = 2; // even powers also give a restoring force
    assert_same(pair_force(ball(0), ball(0), 1.5, &force), -0.25);
}

static void test_distance_handles(void **state) {
    (void)state;
    const uint32_t handles[][2] = {{0, 0}, {0, 7}, {UINT32_MAX, 1}, {1, 0}};
    for (size_t i = 0; i < COUNT_OF(handles); i++) {
        PhysForce force = link_of(-1, 1);
        force.from = handles[i][0];
        force.to = handles[i][1];
        assert_same(pair_force(ball(0), ball(0), 2, &force), i == 3 ? 1 : 0);
    }
}

static void test_collision_grows_with_the_overlap(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_COLLISION);
    force.strength = 7;
    double reach = 0.75 + 0.5;
    assert_same(pair_force(ball(0.75), ball(0.5), 1, &force), -((reach - 1) * 7));
    assert_same(pair_force(ball(0.75), ball(0.5), 1.25, &force), 0);
    assert_same(pair_force(ball(0), ball(5), 1, &force), 0);
    assert_same(pair_force(ball(5), ball(0), 1, &force), 0);
    force.power = 2;
    assert_same(pair_force(ball(0.75), ball(0.5), 1, &force), -(0.25 * 0.25 * 7));
    force.max_distance = 1; // only distances strictly below max_distance count
    assert_same(pair_force(ball(0.75), ball(0.5), 1, &force), 0);
    force.max_distance = 1.125;
    assert_same(pair_force(ball(0.75), ball(0.5), 1, &force), -(0.25 * 0.25 * 7));
}

static void test_gravity_is_constant_within_the_radii(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_GRAVITY);
    force.strength = 3;
    PhysParticle heavy = {.mass = 5};
    assert_same(pair_force(ball(0), heavy, 2, &force), 3 * (1 * 5.0) / 4);
    heavy.radius = 3; // within the sum of the radii the force is constant
    assert_same(pair_force(ball(1), heavy, 2, &force), 3 * (1 * 5.0) / 16);
    assert_same(pair_force(ball(1), heavy, 1, &force), 3 * (1 * 5.0) / 16);
    heavy.mass = 0;
    assert_same(pair_force(ball(1), heavy, 2, &force), 0);
    heavy.mass = 5;
    force.max_distance = 2;
    assert_same(pair_force(ball(1), heavy, 2, &force), 0);
}

static void test_equal_charges_repel_and_opposite_attract(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_ELECTROSTATIC);
    force.strength = 2;
    assert_same(pair_force(charged(3), charged(0.7), 2, &force), -(2 * (3 * 0.7) / 4));
    assert_same(pair_force(charged(-3), charged(0.7), 2, &force), 2 * (3 * 0.7) / 4);
    assert_same(pair_force(charged(-3), charged(-0.7), 2, &force), -(2 * (3 * 0.7) / 4));
    assert_same(pair_force(charged(0), charged(0.7), 2, &force), 0);
    force.strength = -2;
    assert_same(pair_force(charged(3), charged(0.7), 2, &force), 2 * (3 * 0.7) / 4);
}

static void test_adhesion_rests_at_the_overlap(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_ADHESION);
    force.strength = 4;
    force.overlap = 0.5;
    // Radii 1 and 2: contact below 3, at rest at 1 · 0.5 + 3 · 0.5 = 2.
    assert_same(pair_force(ball(1), ball(2), 2, &force), 0);
    assert_same(pair_force(ball(1), ball(2), 2.5, &force), 4 * 0.5 * 0.5);
    assert_same(pair_force(ball(1), ball(2), 1.5, &force), 4 * 1.5 * -0.5);
    assert_same(pair_force(ball(1), ball(2), 3, &force), 0);
    assert_same(pair_force(ball(1), ball(0), 0.5, &force), 0);
    force.overlap = 1; // with overlap 1 the smaller disc is attracted until it touches the larger one from within
    assert_same(pair_force(ball(1), ball(2), 1, &force), 0);
    assert_true(pair_force(ball(1), ball(2), 1.5, &force) > 0);
    force.overlap = 0; // equal to a collision with power 2
    PhysForce collision = force_of(PHYS_COLLISION);
    collision.strength = 4;
    collision.power = 2;
    assert_same(pair_force(ball(1), ball(2), 2.25, &force), pair_force(ball(1), ball(2), 2.25, &collision));
}

// Returns the change of a particle's velocity due to one force, in three dimensions and a step of length 1.
static void single_force(PhysParticle particle, const PhysForce *force, double change[3]) {
    PhysSystem *system = phys_new();
    phys_begin(system, 3);
    phys_add_particle(system, 0, &particle);
    phys_add_force(system, 0, force);
    one_step(system);
    for (int k = 0; k < 3; k++)
        change[k] = phys_velocity(system, 0)[k] - (particle.velocity ? particle.velocity[k] : 0);
    phys_free(system);
}

static void check_single(PhysParticle particle, const PhysForce *force, double x, double y, double z) {
    double change[3];
    single_force(particle, force, change);
    assert_same(change[0], x);
    assert_same(change[1], y);
    assert_same(change[2], z);
}

static void test_constant_adds_force_and_acceleration(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_CONSTANT);
    force.vector = VEC(1, 2, 3);
    check_single(ball(0), &force, 1, 2, 3);
    force.vector2 = VEC(0, -10, 0.5);
    force.strength = 2;
    PhysParticle heavy = {.mass = 4};
    check_single(heavy, &force, 2 * 1 / 4.0, 2 * (2 - 10 * 4) / 4.0, 2 * (3 + 0.5 * 4) / 4.0);
    force.vector = NULL;
    check_single(heavy, &force, 0, -20, 1);
    heavy.mass = 0;
    check_single(heavy, &force, 0, 0, 0);
    heavy = (PhysParticle){.mass = 1, .anchor = true};
    check_single(heavy, &force, 0, 0, 0);
}

static void test_field_is_proportional_to_the_charge(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_FIELD);
    force.vector = VEC(0.5, 0, -2);
    force.strength = 3;
    check_single(charged(0), &force, 0, 0, 0);
    check_single(charged(-2), &force, -3, 0, 12);
}

static void test_drag_never_overshoots_the_flow(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_DRAG);
    force.strength = 0.01;
    PhysParticle p = ball(2);
    p.velocity = VEC(3, 4, 0);
    double c = 0.01 * 5 * 4; // strength · speed · radius²
    check_single(p, &force, (3 - 3 * c) - 3, (4 - 4 * c) - 4, 0);
    force.vector = VEC(3, 4, -5); // velocity of the flow
    check_single(p, &force, 0, 0, -5 * c);
    force.strength = 1000; // drag changes the velocity at most to that of the flow
    check_single(p, &force, 0, 0, -5);
    p.radius = 0;
    check_single(p, &force, 0, 0, 0);
}

static void test_buoyancy_depends_on_the_displaced_mass(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_BUOYANCY);
    force.vector = VEC(0, 0, -1);
    force.density = 0.5;
    force.strength = 3;
    check_single(ball(2), &force, 0, 0, -(3 * (1 - 8 * 0.5)));
    check_single(ball(0), &force, 0, 0, 0);
    PhysParticle p = {.radius = 1};
    check_single(p, &force, 0, 0, 0);
}

static void test_soft_barrier(void **state) {
    (void)state;
    PhysForce force = force_of(PHYS_BARRIER);
    force.vector = VEC(0, 0, 1);
    force.vector2 = VEC(0, 0, 1);
    force.strength = 0.25;
    force.has_minimum = force.has_maximum = true;
    force.minimum = 1;
    force.maximum = 2;
    check_single(particle_at(VEC(9, 9, 1.25)), &force, 0, 0, 0.75 * 0.25);
    check_single(particle_at(VEC(9, 9, 2)), &force, 0, 0, 0);
    check_single(particle_at(VEC(9, 9, 3)), &force, 0, 0, 0);
    check_single(particle_at(VEC(9, 9, 5)), &force, 0, 0, -2 * 0.25);
    force.power = 2;
    check_single(particle_at(VEC(9, 9, 5)), &force, 0, 0, -4 * 0.25);
    force.has_minimum = false;
    force.maximum = 0; // a maximum of 0 also limits
    check_single(particle_at(VEC(9, 9, 1.5)), &force, 0, 0, -0.25 * 0.25);
}

static void test_own_force(void **state) {
    (void)state;
    PhysForce none = force_of(PHYS_CONSTANT);
    PhysParticle p = {.mass = 2, .force = VEC(1, 2, 4)};
    check_single(p, &none, 0.5, 1, 2);
    p.ease = 1; // at clock 0, `ease` makes the force 0
    check_single(p, &none, 0, 0, 0);
    p.ease = 0;
    p.anchor = true;
    check_single(p, &none, 0, 0, 0);
}

// A force that is eased in over 8 has 0, 1/8, 2/8, … of its strength in the steps that begin at clock 0, 1, 2, …
static void test_eased_force_grows_with_the_clock(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    PhysParticle p = {.mass = 1};
    phys_add_particle(system, 0, &p);
    PhysForce force = force_of(PHYS_CONSTANT);
    force.vector = VEC(8);
    force.ease = 8;
    phys_add_force(system, 0, &force);
    double velocity = 0;
    for (int frame = 0; frame < 12; frame++) {
        PhysTime time = time_until(frame + 1, 1);
        time.last = time.clock = frame;
        assert_int_equal(phys_simulate(system, &time).steps, 1);
        velocity += frame < 8 ? frame : 8;
        assert_same(phys_velocity(system, 0)[0], velocity);
    }
    phys_free(system);
}

// Random items are numbered within the group of the `!random` force: by component, then by particle (without anchors),
// then by step.
static void test_random_items_are_numbered_within_the_forces_group(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    uint32_t inner = phys_add_group(system, 0), other = phys_add_group(system, 0);
    PhysParticle anchor = {.anchor = true, .mass = 1}, light = {.mass = 0}, body = {.mass = 1};
    uint32_t in_other = phys_add_particle(system, other, &body), in_inner = phys_add_particle(system, inner, &body);
    phys_add_particle(system, 0, &anchor);
    phys_add_particle(system, 0, &light);
    uint32_t in_top = phys_add_particle(system, 0, &body);
    PhysForce force = force_of(PHYS_RANDOM);
    force.key = 12345;
    phys_add_force(system, 0, &force);
    force.key = 777;
    phys_add_force(system, other, &force);
    run_until(system, 2, 1);
    // Items in pre-order: light (0, 1), top (2, 3), inner (4, 5), other (6, 7). The next step continues at 8.
    for (uint64_t k = 0; k < 2; k++) {
        assert_same(phys_velocity(system, in_top)[k], random_normal(12345, 2 + k) + random_normal(12345, 10 + k));
        assert_same(phys_velocity(system, in_inner)[k], random_normal(12345, 4 + k) + random_normal(12345, 12 + k));
        double first = random_normal(777, k) + random_normal(12345, 6 + k);
        double second = random_normal(777, 2 + k) + random_normal(12345, 14 + k);
        assert_same(phys_velocity(system, in_other)[k], first + second);
    }
    phys_free(system);
}

// Forces of a particle's group are applied first, then those of enclosing groups. The speed limit is applied after all
// of them.
static void test_speed_of_light(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    PhysParticle p = {.mass = 1, .velocity = VEC(3, 0), .force = VEC(0, 4)}, fast = {.velocity = VEC(9, 0)};
    phys_add_particle(system, 0, &p);
    phys_add_particle(system, 0, &fast);
    PhysTime time = time_until(1, 1);
    time.speed_of_light = 2;
    phys_simulate(system, &time);
    assert_same(phys_velocity(system, 0)[0], 3 * (2.0 / 5));
    assert_same(phys_velocity(system, 0)[1], 4 * (2.0 / 5));
    assert_same(phys_velocity(system, 1)[0], 9); // with mass 0 there is no limit
    phys_free(system);
}

// A particle's new force and ramp time apply from the next frame on.
static void test_changed_force(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 1);
    PhysParticle p = {.mass = 1, .force = VEC(8), .ease = 4};
    phys_add_particle(system, 0, &p);
    PhysTime time = {.last = 0, .now = 1, .clock = 1, .resolution = 1, .performance = 1};
    assert_int_equal(phys_simulate(system, &time).status, PHYS_OK);
    assert_same(phys_velocity(system, 0)[0], 8 / 4.0);
    p.force = VEC(16);
    p.ease = 8;
    phys_update_particle(system, 0, &p, (PhysPreserve){.position = true});
    assert_int_equal(phys_simulate(system, &time).status, PHYS_OK);
    assert_same(phys_velocity(system, 0)[0], 16 / 8.0);
    p.ease = 2;
    phys_update_particle(system, 0, &p, (PhysPreserve){.position = true});
    assert_int_equal(phys_simulate(system, &time).status, PHYS_OK);
    assert_same(phys_velocity(system, 0)[0], 16 / 2.0);
    phys_free(system);
}

TEST_GROUP(forces) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_link_acts_below_min_and_above_max),
        cmocka_unit_test(test_distance_powers),
        cmocka_unit_test(test_distance_handles),
        cmocka_unit_test(test_collision_grows_with_the_overlap),
        cmocka_unit_test(test_gravity_is_constant_within_the_radii),
        cmocka_unit_test(test_equal_charges_repel_and_opposite_attract),
        cmocka_unit_test(test_adhesion_rests_at_the_overlap),
        cmocka_unit_test(test_constant_adds_force_and_acceleration),
        cmocka_unit_test(test_field_is_proportional_to_the_charge),
        cmocka_unit_test(test_drag_never_overshoots_the_flow),
        cmocka_unit_test(test_buoyancy_depends_on_the_displaced_mass),
        cmocka_unit_test(test_soft_barrier),
        cmocka_unit_test(test_own_force),
        cmocka_unit_test(test_eased_force_grows_with_the_clock),
        cmocka_unit_test(test_random_items_are_numbered_within_the_forces_group),
        cmocka_unit_test(test_changed_force),
        cmocka_unit_test(test_speed_of_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
