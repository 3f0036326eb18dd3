// test_laws_barriers.c: barriers and anchors.
#include "laws.h"

static double along(const Dish *dish, const double *v, const double *direction) {
    double sum = 0;
    for (int k = 0; k < dish->dimensions; k++)
        sum += v[k] * direction[k];
    return sum;
}

static void set_length(const Dish *dish, double *v, double length) {
    double size = sqrt(along(dish, v, v));
    for (int k = 0; k < dish->dimensions; k++)
        v[k] *= length / size;
}

// Returns a system with one barrier through the origin, whose normal is a unit vector, and a force towards it. The
// bodies are inside, and lie on the barrier if `lie` is set.
static Dish with_barrier(uint64_t seed, unsigned kinds, bool lie) {
    Dish dish = random_dish(seed, kinds, 1);
    uint64_t dice = seed;
    Force *barrier = &dish.forces[dish.force_count - 1];
    *barrier = (Force){.kind = BARRIER, .restitution = below(&dice, 5) / 4.0};
    random_vector(&dice, dish.dimensions, 2, barrier->vector2);
    barrier->vector2[0] += 3;
    set_length(&dish, barrier->vector2, 1);
    if (dish.force_count == 1)
        dish.forces[dish.force_count++] = *barrier;
    const double *normal = dish.forces[dish.force_count - 1].vector2;
    dish.forces[0] = (Force){.kind = CONSTANT, .strength = 1};
    for (int k = 0; k < dish.dimensions; k++)
        dish.forces[0].vector2[k] = -10 * normal[k];
    for (int i = 0; i < dish.body_count; i++) {
        Body *body = &dish.bodies[i];
        double height = along(&dish, body->position, normal) - body->radius,
               speed = along(&dish, body->velocity, normal);
        for (int k = 0; k < dish.dimensions; k++) {
            body->position[k] -= (lie || height < 0 ? height : 0) * normal[k];
            body->velocity[k] -= (lie ? speed : 0) * normal[k];
        }
    }
    return dish;
}

// Checks positions and velocities along the barrier.
static void check_along(const char *law, uint64_t seed, const Dish *found, const Dish *wanted, const double *normal) {
    Dish a = *found, b = *wanted;
    for (int i = 0; i < a.body_count; i++) {
        double x = along(&a, b.bodies[i].position, normal) - along(&a, a.bodies[i].position, normal);
        double v = along(&a, b.bodies[i].velocity, normal) - along(&a, a.bodies[i].velocity, normal);
        for (int k = 0; k < a.dimensions; k++) {
            a.bodies[i].position[k] += x * normal[k];
            a.bodies[i].velocity[k] += v * normal[k];
        }
    }
    check_same(law, seed, &a, &b, 1e-9);
}

// A body moves along a barrier as it would without it: if it lies on it, with any restitution; if it bounces, with
// restitution 1.
static void test_motion_along_a_barrier_is_free(void **state) {
    (void)state;
    enum { STEPS = 100 };
    for (uint64_t seed = 1; seed <= 2 * SYSTEMS; seed++) {
        bool lie = seed % 2;
        Dish dish = with_barrier(seed, FIELDS, lie), without = dish;
        Force *barrier = &dish.forces[dish.force_count - 1];
        if (!lie)
            barrier->restitution = 1;
        without.force_count--;
        dish = run_dish(&dish, STEPS, seed);
        without = run_dish(&without, STEPS, seed);
        check_along("along a barrier", seed, &dish, &without, barrier->vector2);
    }
}

// No body is behind the only barrier after a step, whatever acts on it.
static void test_bodies_stay_inside(void **state) {
    (void)state;
    enum { FRAMES = 60 };
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = with_barrier(seed, PAIRS | FIELDS | KIND(DRAG), false);
        const double *normal = dish.forces[dish.force_count - 1].vector2;
        PetriSession *session = open_dish(&dish, 1, seed);
        for (int frame = 0; frame < FRAMES; frame++) {
            step_dish(session, &dish, 1);
            for (int i = 0; i < dish.body_count; i++) {
                const Body *body = &dish.bodies[i];
                double height = along(&dish, body->position, normal) - body->radius;
                if (!(height >= -1e-12 * fmax(1, sqrt(along(&dish, body->position, body->position)))))
                    fail_msg("inside, seed %llu: body %d is at %g behind the barrier", (unsigned long long)seed, i,
                             height);
            }
        }
        petri_close(&session);
    }
}

// Bodies that fall from rest on elastic barriers of any direction do not rise above the height of their start. The
// steps are short, because each bounce loses about a step of motion, which would hide small gains.
static void test_elastic_bounces_gain_no_height(void **state) {
    (void)state;
    enum { FRAMES = 200, STEPS = 32 };
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = with_barrier(seed, FIELDS, false);
        uint64_t dice = seed;
        Force *barrier = &dish.forces[dish.force_count - 1], *fall = &dish.forces[0];
        double up[DIMENSIONS];
        dish.forces[1] = *barrier;
        dish.forces[1].restitution = 1;
        dish.force_count = 2;
        dish.delta = DELTA / STEPS;
        random_vector(&dice, dish.dimensions, 2, up);
        for (int k = 0; k < dish.dimensions; k++)
            up[k] += 3 * dish.forces[1].vector2[k]; // gravity pulls towards the barrier
        set_length(&dish, up, 1);
        for (int k = 0; k < dish.dimensions; k++)
            fall->vector2[k] = -10 * up[k];
        Dish start = dish;
        for (int i = 0; i < dish.body_count; i++)
            memset(dish.bodies[i].velocity, 0, sizeof dish.bodies[i].velocity);
        PetriSession *session = open_dish(&dish, STEPS, seed);
        for (int frame = 0; frame < FRAMES; frame++) {
            step_dish(session, &dish, STEPS);
            for (int i = 0; i < dish.body_count; i++) {
                double first = along(&dish, start.bodies[i].position, up),
                       now = along(&dish, dish.bodies[i].position, up);
                if (!(now <= first + 1e-9))
                    fail_msg("height, seed %llu, %d dimensions: body %d rises from %.9g to %.9g",
                             (unsigned long long)seed, dish.dimensions, i, first, now);
            }
        }
        petri_close(&session);
    }
}

// Anchors that are so far away that their forces are 0, or at no point at all, do no harm.
static void test_far_anchors_do_no_harm(void **state) {
    (void)state;
    enum { STEPS = 24 };
    static const double places[] = {1e160, -1e180, 1e200, -1e300, INFINITY, NAN};
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish dish = random_dish(seed, (PAIRS & ~KIND(DISTANCE)) | FIELDS | KIND(DRAG), MAX_GROUPS), other = dish;
        for (int a = 0; a < 3 && other.body_count < MAX_BODIES; a++) {
            Body *anchor = &other.bodies[other.body_count++];
            *anchor = (Body){.radius = 1, .mass = 5, .charge = 1, .anchor = true, .group = a % dish.group_count};
            for (int k = 0; k < dish.dimensions; k++)
                anchor->position[k] = places[(seed + (uint64_t)(a + k)) % 6];
        }
        int count = dish.body_count;
        dish = run_dish(&dish, STEPS, seed);
        other = run_dish(&other, STEPS, seed);
        other.body_count = count;
        check_same("anchors", seed, &other, &dish, 0);
    }
}

TEST_GROUP(laws_barriers) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_motion_along_a_barrier_is_free),
        cmocka_unit_test(test_bodies_stay_inside),
        cmocka_unit_test(test_elastic_bounces_gain_no_height),
        cmocka_unit_test(test_far_anchors_do_no_harm),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
