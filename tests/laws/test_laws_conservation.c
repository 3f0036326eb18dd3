// test_laws_conservation.c: momentum, angular momentum and energy.
#include "laws.h"

static double size_of(const double *v, int n) {
    double square = 0;
    for (int k = 0; k < n; k++)
        square += v[k] * v[k];
    return sqrt(square);
}

// Adds up momentum, and angular momentum in the plane of axes a and b about the origin. Returns the sum of the sizes of
// their terms, which bounds rounding errors.
static double momenta(const Dish *dish, int a, int b, double *momentum, double *angular) {
    double largest = 0;
    memset(momentum, 0, DIMENSIONS * sizeof *momentum);
    *angular = 0;
    for (int i = 0; i < dish->body_count; i++) {
        const Body *body = &dish->bodies[i];
        const double *x = body->position, *v = body->velocity;
        for (int k = 0; k < dish->dimensions; k++)
            momentum[k] += body->mass * v[k];
        *angular += body->mass * (x[a] * v[b] - x[b] * v[a]);
        largest += body->mass * size_of(v, dish->dimensions) * (1 + size_of(x, dish->dimensions));
    }
    return largest;
}

// Pair forces act along the line between two bodies with opposite directions.
static void test_pair_forces_keep_momenta(void **state) {
    (void)state;
    enum { STEPS = 200 };
    for (uint64_t seed = 1; seed <= SYSTEMS; seed++) {
        Dish before = random_dish(seed, PAIRS, MAX_GROUPS), after = run_dish(&before, STEPS, seed);
        int last = before.dimensions - 1, other = last ? last - 1 : 0;
        double p[DIMENSIONS], q[DIMENSIONS], l, m;
        double largest = momenta(&before, other, last, p, &l) + momenta(&after, other, last, q, &m);
        for (int k = 0; k <= last; k++)
            if (!(fabs(q[k] - p[k]) <= 1e-10 * largest))
                fail_msg("momentum, seed %llu: %.17g became %.17g", (unsigned long long)seed, p[k], q[k]);
        if (!(fabs(m - l) <= 1e-10 * largest))
            fail_msg("angular momentum, seed %llu: %.17g became %.17g", (unsigned long long)seed, l, m);
    }
}

// Checks that the energy of two bodies stays within `bound` of its first value at ten times in 10^5 steps, so that it
// does not drift. `potential` returns their potential energy at a distance.
static void check_energy(const char *law, uint64_t seed, const Dish *dish, double (*potential)(const Dish *, double),
                         double bound) {
    enum { STEPS = 10000 };
    Dish now = *dish;
    PetriSession *session = open_dish(dish, STEPS, seed);
    double first = 0;
    for (int frame = 0; frame <= 10; frame++) {
        double kinetic = 0, between[DIMENSIONS] = {0};
        if (frame)
            step_dish(session, &now, STEPS);
        for (int i = 0; i < 2; i++) {
            double speed = size_of(now.bodies[i].velocity, now.dimensions);
            kinetic += now.bodies[i].mass * speed * speed / 2;
        }
        for (int k = 0; k < now.dimensions; k++)
            between[k] = now.bodies[1].position[k] - now.bodies[0].position[k];
        double energy = kinetic + potential(&now, size_of(between, now.dimensions));
        first = frame ? first : energy;
        if (!(fabs(energy - first) <= bound * fabs(first)))
            fail_msg("%s, seed %llu, %d dimensions: energy %.9g became %.9g", law, (unsigned long long)seed,
                     dish->dimensions, first, energy);
    }
    petri_close(&session);
}

static double spring_energy(const Dish *dish, double length) {
    double stretch = length - dish->forces[0].low;
    return dish->forces[0].strength * stretch * stretch / 2;
}

// The energy of a spring of frequency w oscillates by about w * delta / 2 of itself.
static void test_springs_keep_energy(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 24; seed++) {
        uint64_t dice = seed;
        Dish dish = {.dimensions = 1 + (int)(seed % DIMENSIONS), .body_count = 2, .force_count = 1, .group_count = 1};
        dish.delta = DELTA;
        for (int i = 0; i < 2; i++) {
            dish.bodies[i] = random_body(&dice, &dish);
            dish.bodies[i].position[0] = 5 * i;
            if (dish.dimensions == 1) // so that they do not pass through each other, where the force jumps
                dish.bodies[i].velocity[0] = 0;
        }
        dish.forces[0] = (Force){.kind = DISTANCE, .strength = between(&dice, 1, 8), .power = 1, .from = 0, .to = 1};
        dish.forces[0].low = dish.forces[0].high = between(&dice, 3, 6);
        double reduced = 1 / (1 / dish.bodies[0].mass + 1 / dish.bodies[1].mass);
        check_energy("spring", seed, &dish, spring_energy, 2 * sqrt(dish.forces[0].strength / reduced) * DELTA);
    }
}

static double gravity_energy(const Dish *dish, double length) {
    return -dish->forces[0].strength * dish->bodies[0].mass * dish->bodies[1].mass / length;
}

// Bound orbits in two or more dimensions.
static void test_orbits_keep_energy(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 24; seed++) {
        uint64_t dice = seed;
        Dish dish = {.dimensions = 2 + (int)(seed % (DIMENSIONS - 1)), .body_count = 2, .force_count = 1};
        dish.group_count = 1;
        dish.delta = DELTA;
        double distance = between(&dice, 4, 6), strength = between(&dice, 1, 3);
        dish.bodies[0] = (Body){.mass = 8};
        dish.bodies[1] = (Body){.mass = between(&dice, 1, 4), .position = {distance}};
        // A circular orbit, or an ellipse with an eccentricity of up to 0.36.
        double speed = sqrt(strength * (8 + dish.bodies[1].mass) / distance) * (0.8 + 0.3 * (double)below(&dice, 2));
        dish.bodies[1].velocity[dish.dimensions - 1] = speed;
        dish.forces[0] = (Force){.kind = GRAVITY, .strength = strength};
        check_energy("orbit", seed, &dish, gravity_energy, 0.05);
    }
}

TEST_GROUP(laws_conservation) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pair_forces_keep_momenta),
        cmocka_unit_test(test_springs_keep_energy),
        cmocka_unit_test(test_orbits_keep_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
