// test_barriers.c: reflections at barriers (4.4).
#include "support.h"

static const double UP[] = {0, 1}, DOWN[] = {0, -10};

// A floor at height 0 in the last dimension.
static PhysForce floor_of(double restitution) {
    PhysForce force = force_of(PHYS_BARRIER);
    force.vector2 = UP;
    force.restitution = restitution;
    return force;
}

static PhysForce gravity(void) {
    PhysForce force = force_of(PHYS_CONSTANT);
    force.vector2 = DOWN;
    return force;
}

static PhysSystem *ball_and_floor(PhysVector position, PhysVector velocity, double radius, double restitution) {
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    PhysParticle p = {.position = position, .velocity = velocity, .radius = radius, .mass = 1};
    phys_add_particle(system, 0, &p);
    PhysForce barrier = floor_of(restitution);
    phys_add_force(system, 0, &barrier);
    return system;
}

static void check_ball(const PhysSystem *system, double x, double y, double vx, double vy) {
    assert_same(phys_position(system, 0)[0], x);
    assert_same(phys_position(system, 0)[1], y);
    assert_same(phys_velocity(system, 0)[0], vx);
    assert_same(phys_velocity(system, 0)[1], vy);
}

// After the reflection, the particle moves back for the rest of the step.
static void test_rest_of_the_step_follows_the_reflected_velocity(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(0, 1), VEC(2, -4), 0, 1);
    one_step(system); // contact after a quarter of the step
    check_ball(system, 2, 3, 2, 4);
    phys_free(system);
    system = ball_and_floor(VEC(0, 1.5), VEC(2, -4), 0.5, 1); // the ball touches the floor at its radius
    one_step(system);
    check_ball(system, 2, 3.5, 2, 4);
    phys_free(system);
}

static void test_restitution_scales_the_whole_velocity(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(0, 1), VEC(2, -4), 0, 0.5);
    one_step(system); // the contact halves the whole velocity, not only the normal component
    check_ball(system, 0.5 + 0.75 * 1, 0.75 * 2, 1, 2);
    phys_free(system);
    system = ball_and_floor(VEC(0, 1), VEC(2, -4), 0, 0);
    one_step(system);
    check_ball(system, 0.5, 0, 0, 0);
    phys_free(system);
}

static void test_not_crossed(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(0, 5), VEC(2, -4), 1, 0.5);
    one_step(system); // the ball only touches the floor
    check_ball(system, 2, 1, 2, -4);
    phys_free(system);
}

// A particle that starts behind the barrier and moves out is placed on the surface. It keeps its velocity.
static void test_leaving_particle_is_placed_on_the_surface(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(0, -5), VEC(2, 1), 0.5, 0.5);
    one_step(system);
    check_ball(system, 2, 0.5, 2, 1);
    phys_free(system);
    system = ball_and_floor(VEC(0, -5), VEC(2, 0), 0.5, 0.5);
    one_step(system);
    check_ball(system, 2, 0.5, 2, 0);
    phys_free(system);
}

// If a particle starts behind the barrier and moves deeper, its step is undone and repeated with the reflected
// velocity. Then it is placed on the surface.
static void test_sinking_particle_is_reflected_onto_the_surface(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(0, -5), VEC(2, -1), 0, 1);
    one_step(system);
    check_ball(system, 2, 0, 2, 1);
    phys_free(system);
}

static void test_anchor_and_massless(void **state) {
    (void)state;
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    PhysParticle anchor = {.position = VEC(0, -1), .anchor = true}, light = {.position = VEC(0, 1)};
    light.velocity = VEC(0, -4);
    phys_add_particle(system, 0, &light);
    phys_add_particle(system, 0, &anchor);
    PhysForce barrier = floor_of(1);
    phys_add_force(system, 0, &barrier);
    one_step(system);
    check_ball(system, 0, 3, 0, 4);
    assert_same(phys_position(system, 1)[1], -1);
    phys_free(system);
}

// In the corner of two barriers, a particle is reflected twice in one step.
static void test_corner_reflects_twice_in_one_step(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(1, 1), VEC(-4, -2), 0, 1);
    PhysForce wall = force_of(PHYS_BARRIER);
    wall.vector2 = VEC(1, 0);
    phys_add_force(system, 0, &wall);
    one_step(system);
    check_ball(system, 3, 1, 4, 2);
    phys_free(system);
}

// After a fall from a height h, a ball bounces to e² h if the restitution of the floor is e.
static double bounce_height(double restitution, double resolution) {
    PhysSystem *system = ball_and_floor(VEC(0, 1.25), NULL, 0.25, restitution);
    PhysForce fall = gravity();
    phys_add_force(system, 0, &fall);
    double highest = 0, now = 0;
    bool bounced = false;
    while (now < 1.2) {
        PhysTime time = time_until(now + resolution, resolution);
        time.last = now;
        phys_simulate(system, &time);
        now += resolution;
        bounced |= phys_velocity(system, 0)[1] > 0;
        if (bounced && phys_velocity(system, 0)[1] <= 0)
            break;
        if (bounced && phys_position(system, 0)[1] > highest)
            highest = phys_position(system, 0)[1];
    }
    phys_free(system);
    return highest - 0.25;
}

static void test_bounce_height(void **state) {
    (void)state;
    const double restitutions[] = {1, 0.8, 0.5, 0.25};
    for (size_t i = 0; i < COUNT_OF(restitutions); i++) {
        double wanted = restitutions[i] * restitutions[i];
        assert_near(bounce_height(restitutions[i], 1e-3), wanted, 0.01);
        assert_near(bounce_height(restitutions[i], 1e-4), wanted, 0.001);
    }
}

// A ball at rest stays on the floor and does not jitter.
static void test_ball_comes_to_rest(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(0, 1), NULL, 0.5, 0.5);
    PhysForce fall = gravity();
    phys_add_force(system, 0, &fall);
    run_until(system, 20, 1 / 60.0);
    assert_near(phys_position(system, 0)[1], 0.5, 1e-3);
    assert_near(phys_velocity(system, 0)[1], 0, 0.1);
    phys_free(system);
}

// A ball on a slope rolls: it moves along it as fast as without it, at any angle and with any restitution.
static void test_ball_rolls_down_a_slope(void **state) {
    (void)state;
    const double restitutions[] = {0, 0.5, 1};
    for (int degrees = 5; degrees < 90; degrees += 5)
        for (size_t r = 0; r < COUNT_OF(restitutions); r++) {
            double angle = degrees * 3.14159265358979 / 180, normal[] = {sin(angle), cos(angle)};
            double along[] = {cos(angle), -sin(angle)};
            PhysSystem *system = phys_new();
            phys_begin(system, 2);
            PhysParticle p = {.position = VEC(0.5 * normal[0], 0.5 * normal[1]), .radius = 0.5, .mass = 1};
            phys_add_particle(system, 0, &p);
            PhysForce slope = floor_of(restitutions[r]), fall = gravity();
            slope.vector2 = normal;
            phys_add_force(system, 0, &slope);
            phys_add_force(system, 0, &fall);
            assert_int_equal(run_until(system, 1, 0.01).steps, 100);
            const double *position = phys_position(system, 0), *velocity = phys_velocity(system, 0);
            double speed = 10 * sin(angle), way = speed * 1.01 / 2; // of the first-order integrator
            assert_near(velocity[0] * along[0] + velocity[1] * along[1], speed, 1e-9);
            assert_near(position[0] * along[0] + position[1] * along[1], way, 1e-9);
            assert_near(velocity[0] * normal[0] + velocity[1] * normal[1], 0, 1e-9);
            assert_near(position[0] * normal[0] + position[1] * normal[1], 0.5, 1e-9);
            phys_free(system);
        }
}

// Balls that overlap on a floor push each other apart, although they are also pressed to the floor.
static void test_balls_on_a_floor_part(void **state) {
    (void)state;
    enum { BALLS = 12 };
    PhysSystem *system = phys_new();
    phys_begin(system, 2);
    for (uint32_t i = 0; i < BALLS; i++)
        phys_add_particle(system, 0, &(PhysParticle){.position = VEC(0.6 * i, 0.5), .radius = 0.5, .mass = 1});
    PhysForce fall = gravity(), collision = force_of(PHYS_COLLISION), floor = floor_of(0.2);
    collision.strength = 100;
    phys_add_force(system, 0, &fall);
    phys_add_force(system, 0, &collision);
    phys_add_force(system, 0, &floor);
    run_until(system, 10, 1 / 120.0);
    for (uint32_t i = 1; i < BALLS; i++) {
        assert_true(phys_position(system, i)[0] - phys_position(system, i - 1)[0] > 0.99);
        assert_near(phys_position(system, i)[1], 0.5, 1e-9);
    }
    phys_free(system);
}

// The speed of light, here 4, also limits the motion after a reflection. A force of 2 acts for the remaining half of
// the step.
static void test_speed_of_light(void **state) {
    (void)state;
    PhysSystem *system = ball_and_floor(VEC(0, 1), VEC(0, -4), 0, 1);
    PhysForce push = force_of(PHYS_CONSTANT);
    push.vector = UP;
    push.strength = 2;
    phys_add_force(system, 0, &push);
    PhysTime time = time_until(1, 1);
    time.speed_of_light = 3;
    phys_simulate(system, &time);
    // The velocity is -4 + 2 = -2, so the position is -1. The contact was half a step ago, with velocity -2 - 0.5 · 2 =
    // -3. Its reflection is 3, and 3 + 0.5 · 2 = 4.
    check_ball(system, 0, 1.5, 0, 3);
    phys_free(system);
}

TEST_GROUP(barriers) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest_of_the_step_follows_the_reflected_velocity),
        cmocka_unit_test(test_restitution_scales_the_whole_velocity),
        cmocka_unit_test(test_not_crossed),
        cmocka_unit_test(test_leaving_particle_is_placed_on_the_surface),
        cmocka_unit_test(test_sinking_particle_is_reflected_onto_the_surface),
        cmocka_unit_test(test_anchor_and_massless),
        cmocka_unit_test(test_corner_reflects_twice_in_one_step),
        cmocka_unit_test(test_bounce_height),
        cmocka_unit_test(test_ball_comes_to_rest),
        cmocka_unit_test(test_ball_rolls_down_a_slope),
        cmocka_unit_test(test_balls_on_a_floor_part),
        cmocka_unit_test(test_speed_of_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
