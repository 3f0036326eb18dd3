// test_laws_symmetry.c: a system that is mirrored, turned, scaled, shifted, moved, divided or reversed gives the result
// that is mirrored, turned, scaled, shifted, moved, divided or reversed.
//
// Exact are a reflection, a quarter turn in the plane of the first two axes and a scale that is a power of two, because
// they change no rounding, and bodies without interaction. The other laws hold up to rounding, which is amplified at
// each approach of two bodies.
#include "laws.h"

enum { STEPS = 24 };
#define ROUNDING 1e-7

static void mirror(Dish *dish, int axis) {
    for (int i = 0; i < dish->body_count; i++) {
        dish->bodies[i].position[axis] *= -1;
        dish->bodies[i].velocity[axis] *= -1;
    }
    for (int f = 0; f < dish->force_count; f++) {
        dish->forces[f].vector[axis] *= -1;
        dish->forces[f].vector2[axis] *= -1;
    }
}

static void test_mirror_is_exact(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS | KIND(DRAG) | KIND(BARRIER), MAX_GROUPS), wanted, other = dish;
        int axis = (int)(seed / DIMENSIONS % (uint64_t)dish.dimensions);
        wanted = run_dish(&dish, STEPS, seed);
        mirror(&other, axis);
        other = run_dish(&other, STEPS, seed);
        mirror(&wanted, axis);
        check_same("mirror", seed, &other, &wanted, 0);
    }
}

static void turn_vector(double *v) {
    double x = v[0];
    v[0] = -v[1];
    v[1] = x;
}

static void turn(Dish *dish) {
    for (int i = 0; i < dish->body_count; i++) {
        turn_vector(dish->bodies[i].position);
        turn_vector(dish->bodies[i].velocity);
    }
    for (int f = 0; f < dish->force_count; f++) {
        turn_vector(dish->forces[f].vector);
        turn_vector(dish->forces[f].vector2);
    }
}

static void test_quarter_turn_is_exact(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS | KIND(DRAG), MAX_GROUPS), wanted, other = dish;
        if (dish.dimensions < 2)
            continue;
        wanted = run_dish(&dish, STEPS, seed);
        turn(&other);
        other = run_dish(&other, STEPS, seed);
        turn(&wanted);
        check_same("turn", seed, &other, &wanted, 0);
    }
}

static void scale_vector(double *v, double by) {
    for (int k = 0; k < DIMENSIONS; k++)
        v[k] *= by;
}

static void scale_force(Force *force, int n, double length, double time, double mass) {
    double pull = mass * length / (time * time); // factor of a force
    force->max_distance *= length;
    force->low *= length;
    force->high *= length;
    force->density *= mass / pow(length, n);
    switch (force->kind) {
    case COLLISION:
    case DISTANCE:
        force->strength *= pull / pow(length, force->power);
        break;
    case GRAVITY:
        force->strength *= pull * length * length / (mass * mass);
        break;
    case ELECTROSTATIC:
        force->strength *= pull * length * length;
        break;
    case ADHESION:
        force->strength *= pull / (length * length);
        break;
    case CONSTANT:
        scale_vector(force->vector, pull);
        scale_vector(force->vector2, pull / mass);
        break;
    case FIELD:
        scale_vector(force->vector, pull);
        break;
    case BUOYANCY:
        scale_vector(force->vector, pull / mass);
        break;
    case DRAG:
        force->strength *= mass / pow(length, n);
        scale_vector(force->vector, length / time);
        break;
    case BARRIER:
        scale_vector(force->vector, length);
        break;
    case KINDS:
        break;
    }
}

static void scale(Dish *dish, double length, double time, double mass) {
    dish->delta *= time;
    for (int i = 0; i < dish->body_count; i++) {
        Body *body = &dish->bodies[i];
        scale_vector(body->position, length);
        scale_vector(body->velocity, length / time);
        body->radius *= length;
        body->mass *= mass;
    }
    for (int f = 0; f < dish->force_count; f++)
        scale_force(&dish->forces[f], dish->dimensions, length, time, mass);
}

static void test_power_of_two_is_exact(void **state) {
    (void)state;
    static const double factors[] = {0.125, 0.5, 2, 4, 1024};
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS | KIND(DRAG) | KIND(BARRIER), MAX_GROUPS), wanted, other = dish;
        double length = factors[seed % 5], time = factors[seed / 5 % 5], mass = factors[seed / 25 % 5];
        wanted = run_dish(&dish, STEPS, seed);
        scale(&other, length, time, mass);
        other = run_dish(&other, STEPS, seed);
        scale(&wanted, length, time, mass);
        check_same("scale", seed, &other, &wanted, 0);
    }
}

// A uniform velocity is added to all bodies, and a vector to all positions.
static void test_other_frame_of_reference(void **state) {
    (void)state;
    static const double shift[DIMENSIONS] = {5, -2, 0.75, 1}, speed[DIMENSIONS] = {-0.5, 3, 1.25, -2};
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS, MAX_GROUPS), wanted, other = dish;
        wanted = run_dish(&dish, STEPS, seed);
        for (int i = 0; i < dish.body_count; i++)
            for (int k = 0; k < dish.dimensions; k++) {
                other.bodies[i].position[k] += shift[k];
                other.bodies[i].velocity[k] += speed[k];
                wanted.bodies[i].position[k] += shift[k] + speed[k] * STEPS * DELTA;
                wanted.bodies[i].velocity[k] += speed[k];
            }
        other = run_dish(&other, STEPS, seed);
        check_same("frame of reference", seed, &other, &wanted, ROUNDING);
    }
}

// The place of barriers is shifted with the bodies.
static void test_other_place(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS | KIND(DRAG) | KIND(BARRIER), MAX_GROUPS), wanted, other = dish;
        wanted = run_dish(&dish, 8, seed);
        for (int i = 0; i < dish.body_count; i++)
            for (int k = 0; k < dish.dimensions; k++) {
                other.bodies[i].position[k] += k - 3;
                wanted.bodies[i].position[k] += k - 3;
            }
        for (int f = 0; f < dish.force_count; f++)
            for (int k = 0; k < dish.dimensions && dish.forces[f].kind == BARRIER; k++)
                other.forces[f].vector[k] += k - 3;
        other = run_dish(&other, 8, seed);
        check_same("place", seed, &other, &wanted, ROUNDING);
    }
}

static void test_bodies_without_interaction_are_alone(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SYSTEMS / 3; seed++) {
        Dish dish = random_dish(seed, FIELDS | KIND(DRAG) | KIND(BARRIER), MAX_GROUPS);
        Dish all = run_dish(&dish, STEPS, seed);
        for (int i = 0; i < dish.body_count; i++) {
            Dish one = dish, wanted = all;
            one.body_count = wanted.body_count = 1;
            one.bodies[0] = dish.bodies[i];
            wanted.bodies[0] = all.bodies[i];
            one = run_dish(&one, STEPS, seed);
            check_same("alone", seed, &one, &wanted, 0);
        }
    }
}

// Groups that are inside each other see each other, so forces of the outermost act as in one group.
static void test_nested_groups_are_one(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS | KIND(DRAG) | KIND(BARRIER), MAX_GROUPS), other;
        for (int g = 1; g < dish.group_count; g++)
            dish.parent[g] = g - 1;
        for (int f = 0; f < dish.force_count; f++)
            dish.forces[f].group = 0;
        other = dish;
        for (int i = 0; i < dish.body_count; i++)
            other.bodies[i].group = 0;
        dish = run_dish(&dish, STEPS, seed);
        other = run_dish(&other, STEPS, seed);
        check_same("groups", seed, &dish, &other, ROUNDING);
    }
}

// The order of the script only changes rounding. Bodies in other groups are not affected.
static void test_other_order(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS | KIND(DRAG), MAX_GROUPS), other = dish, wanted;
        wanted = run_dish(&dish, STEPS, seed);
        int last = dish.body_count - 1;
        for (int i = 0; i <= last; i++)
            other.bodies[i] = dish.bodies[last - i];
        for (int f = 0; f < dish.force_count; f++) {
            other.forces[f].from = last - dish.forces[f].from;
            other.forces[f].to = last - dish.forces[f].to;
        }
        dish = run_dish(&other, STEPS, seed);
        for (int i = 0; i <= last; i++)
            other.bodies[i] = dish.bodies[last - i];
        check_same("order", seed, &other, &wanted, ROUNDING);
    }
}

// A step changes velocities, then positions. So it is reversed by first moving the bodies with the opposite velocity,
// and then changing this velocity by the forces there. This begins with the motion of the last step.
static void test_time_is_reversible(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, PAIRS | FIELDS, MAX_GROUPS);
        for (int i = 0; i < dish.body_count; i++) // no two at one point, where pair forces have no direction
            dish.bodies[i].position[0] += i / 997.0;
        Dish other = run_dish(&dish, STEPS, seed), wanted = dish;
        for (int i = 0; i < dish.body_count; i++)
            for (int k = 0; k < dish.dimensions; k++) {
                Body *body = &other.bodies[i];
                body->velocity[k] *= -1;
                body->position[k] += body->velocity[k] * DELTA;
                wanted.bodies[i].velocity[k] *= -1;
                wanted.bodies[i].position[k] += wanted.bodies[i].velocity[k] * DELTA;
            }
        other = run_dish(&other, STEPS, seed);
        check_same("time reversal", seed, &other, &wanted, ROUNDING);
    }
}

TEST_GROUP(laws_symmetry) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mirror_is_exact),       cmocka_unit_test(test_quarter_turn_is_exact),
        cmocka_unit_test(test_power_of_two_is_exact), cmocka_unit_test(test_other_frame_of_reference),
        cmocka_unit_test(test_other_place),           cmocka_unit_test(test_bodies_without_interaction_are_alone),
        cmocka_unit_test(test_nested_groups_are_one), cmocka_unit_test(test_other_order),
        cmocka_unit_test(test_time_is_reversible),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
