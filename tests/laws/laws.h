// laws.h: random systems for tests of laws of mechanics, with petri.h only. A law is a property of every correct
// engine. It is not derived from the formulas of the specification, so it also finds flaws of the specification.
#pragma once

#include "groups.h"
#include "petri-inspect.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { DIMENSIONS = 4, MAX_BODIES = 24, MAX_FORCES = 8, MAX_GROUPS = 4, SYSTEMS = 150 };
#define DELTA (1.0 / 64) // the step; exact in binary, so that all steps have this length

typedef struct Body {
    double position[DIMENSIONS], velocity[DIMENSIONS], radius, mass, charge;
    bool anchor;
    int group;
} Body;

typedef enum Kind {
    COLLISION,
    GRAVITY,
    ELECTROSTATIC,
    ADHESION,
    DISTANCE,
    CONSTANT,
    FIELD,
    BUOYANCY,
    DRAG,
    BARRIER,
    KINDS,
} Kind;
#define KIND(kind) (1u << (kind))
#define PAIRS (KIND(COLLISION) | KIND(GRAVITY) | KIND(ELECTROSTATIC) | KIND(ADHESION) | KIND(DISTANCE))
#define FIELDS (KIND(CONSTANT) | KIND(FIELD) | KIND(BUOYANCY)) // single-particle forces that do not depend on motion

typedef struct Force {
    Kind kind;
    double strength, power, max_distance, low, high, density, restitution;
    double vector[DIMENSIONS], vector2[DIMENSIONS];
    int from, to, group;
} Force;

typedef struct Dish {
    int dimensions, body_count, force_count, group_count;
    int parent[MAX_GROUPS];
    double delta;
    Body bodies[MAX_BODIES];
    Force forces[MAX_FORCES];
} Dish;

// A deterministic generator.
static inline uint64_t roll(uint64_t *dice) {
    *dice = *dice * 6364136223846793005u + 1442695040888963407u;
    uint64_t x = *dice ^ *dice >> 29;
    x *= 0xbf58476d1ce4e5b9u;
    return x ^ x >> 32;
}

static inline int below(uint64_t *dice, int limit) {
    return (int)(roll(dice) % (uint64_t)limit);
}

// Returns a multiple of 1/64 between the bounds, so that sums and differences of positions are exact.
static inline double between(uint64_t *dice, int low, int high) {
    return low + below(dice, 64 * (high - low) + 1) / 64.0;
}

static inline void random_vector(uint64_t *dice, int dimensions, int size, double *vector) {
    memset(vector, 0, DIMENSIONS * sizeof *vector);
    for (int k = 0; k < dimensions; k++)
        vector[k] = between(dice, -size, size);
}

static inline Body random_body(uint64_t *dice, const Dish *dish) {
    Body body = {.radius = 0.25 + below(dice, 3) / 8.0, .mass = between(dice, 1, 4), .charge = between(dice, -1, 1)};
    random_vector(dice, dish->dimensions, 4, body.position);
    random_vector(dice, dish->dimensions, 1, body.velocity);
    body.group = below(dice, dish->group_count);
    return body;
}

static inline Force random_force(uint64_t *dice, const Dish *dish, unsigned kinds) {
    Force force = {.power = below(dice, 3), .restitution = below(dice, 5) / 4.0, .strength = between(dice, 1, 8)};
    do {
        force.kind = (Kind)below(dice, KINDS);
    } while (!(kinds & KIND(force.kind)));
    random_vector(dice, dish->dimensions, 2, force.vector);
    random_vector(dice, dish->dimensions, 2, force.vector2);
    force.vector2[0] += 3; // the normal of a barrier must not be 0
    if (force.kind == BARRIER)
        force.vector[0] = -3;
    force.max_distance = below(dice, 2) ? 0 : between(dice, 1, 4);
    force.low = between(dice, 0, 2);
    force.high = force.low + between(dice, 0, 2);
    force.density = between(dice, 0, 3);
    force.from = below(dice, dish->body_count);
    force.to = below(dice, dish->body_count);
    force.group = below(dice, dish->group_count);
    return force;
}

// Returns a random system with forces of some kinds, in 1 to 4 dimensions, with up to `groups` groups. It depends only
// on the seed.
static inline Dish random_dish(uint64_t seed, unsigned kinds, int groups) {
    uint64_t dice = seed * 0x9e3779b97f4a7c15u + kinds;
    Dish dish = {.dimensions = 1 + (int)(seed % DIMENSIONS), .delta = DELTA};
    dish.group_count = 1 + below(&dice, groups);
    for (int g = 1; g < dish.group_count; g++)
        dish.parent[g] = below(&dice, g);
    dish.body_count = 2 + below(&dice, MAX_BODIES - 1);
    for (int i = 0; i < dish.body_count; i++)
        dish.bodies[i] = random_body(&dice, &dish);
    dish.force_count = 1 + below(&dice, MAX_FORCES);
    for (int f = 0; f < dish.force_count; f++)
        dish.forces[f] = random_force(&dice, &dish, kinds);
    return dish;
}

typedef struct Text {
    char *bytes;
    size_t length;
} Text;

__attribute__((format(printf, 2, 3))) static inline void add(Text *text, const char *format, ...) {
    enum { MAX_LENGTH = 1000 };
    va_list list;
    text->bytes = realloc(text->bytes, text->length + MAX_LENGTH);
    assert_non_null(text->bytes);
    va_start(list, format);
    text->length += (size_t)vsnprintf(text->bytes + text->length, MAX_LENGTH, format, list);
    va_end(list);
}

static inline void add_vector(Text *text, const Dish *dish, const char *name, const double *vector) {
    add(text, " %s=", name);
    for (int k = 0; k < dish->dimensions; k++)
        add(text, "%s%.17g", k ? ";" : "", vector[k]);
}

static inline void add_force(Text *text, const Dish *dish, const Force *force) {
    static const char *const names[] = {"collision", "gravity", "electrostatic", "adhesion", "distance",
                                        "constant",  "field",   "buoyancy",      "drag",     "barrier"};
    add(text, "!%s strength=%.17g", names[force->kind], force->strength);
    switch (force->kind) {
    case COLLISION:
        add(text, " power=%.17g", force->power);
        break;
    case GRAVITY:
    case ELECTROSTATIC:
    case ADHESION:
        if (force->max_distance > 0)
            add(text, " max_distance=%.17g", force->max_distance);
        break;
    case DISTANCE:
        add(text, " from=%d to=%d min=%.17g max=%.17g power=%.17g", force->from, force->to, force->low, force->high,
            force->power);
        break;
    case CONSTANT:
        add_vector(text, dish, "force", force->vector);
        add_vector(text, dish, "acceleration", force->vector2);
        break;
    case FIELD:
        add_vector(text, dish, "direction", force->vector);
        break;
    case BUOYANCY:
        add_vector(text, dish, "gravity", force->vector);
        add(text, " density=%.17g", force->density);
        break;
    case DRAG:
        add_vector(text, dish, "flow", force->vector);
        break;
    case BARRIER:
        add_vector(text, dish, "position", force->vector);
        add_vector(text, dish, "normal", force->vector2);
        add(text, " restitution=%.17g", force->restitution);
        break;
    case KINDS:
        break;
    }
    add(text, "\n");
}

static inline void add_group(Text *text, const Dish *dish, int group, int depth) {
    for (int i = 0; i < dish->body_count; i++) {
        const Body *body = &dish->bodies[i];
        if (body->group != group)
            continue;
        add(text, "%*s!%s id=%d radius=%.17g mass=%.17g charge=%.17g", depth, "", body->anchor ? "anchor" : "particle",
            i, body->radius, body->mass, body->charge);
        add_vector(text, dish, "position", body->position);
        if (!body->anchor)
            add_vector(text, dish, "velocity", body->velocity);
        add(text, "\n");
    }
    for (int f = 0; f < dish->force_count; f++)
        if (dish->forces[f].group == group) {
            add(text, "%*s", depth, "");
            add_force(text, dish, &dish->forces[f]);
        }
    for (int g = group + 1; g < dish->group_count; g++)
        if (dish->parent[g] == group) {
            add(text, "%*s!group\n", depth, "");
            add_group(text, dish, g, depth + 1);
        }
}

// Opens a session that takes `steps` steps per frame, after frame 0.
static inline PetriSession *open_dish(const Dish *dish, int steps, uint64_t seed) {
    Text text = {0};
    add(&text, "!physics state=:s dimensions=%d resolution=%.17g time=frame*%.17g\n", dish->dimensions, dish->delta,
        steps * dish->delta);
    add_group(&text, dish, 0, 1);
    PetriOptions options = petri_default_options();
    options.threads = 1 + (int)(seed % 2);
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning),
                                    .neighbours = seed % 3 ? PETRI_NEIGHBOURS_ALWAYS : PETRI_NEIGHBOURS_NEVER};
    PetriSession *session = petri_open(&options);
    assert_non_null(session);
    if (petri_load_text(session, "dish.fl", text.bytes, PETRI_NUL_TERMINATED) != PETRI_OK)
        fail_msg("the script cannot be loaded: %s", text.bytes);
    free(text.bytes);
    assert_int_equal(petri_step(session), PETRI_OK);
    return session;
}

// Takes the steps of one frame, and reads positions and velocities.
static inline void step_dish(PetriSession *session, Dish *dish, int steps) {
    PetriSystem system;
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_true(petri_system(session, 0, &system, sizeof system));
    assert_int_equal(system.steps, steps);
    assert_int_equal(system.particle_count, dish->body_count);
    PetriColumn ids = petri_particle_ids(session, 0);
    for (size_t i = 0; i < system.particle_count; i++) {
        Body *body = &dish->bodies[(int)ids.data[i * ids.stride]];
        for (int k = 0; k < dish->dimensions; k++) {
            body->position[k] = system.position.data[i * system.position.stride + (size_t)k];
            body->velocity[k] = system.velocity.data[i * system.velocity.stride + (size_t)k];
        }
    }
}

// Returns the system after some steps.
static inline Dish run_dish(const Dish *dish, int steps, uint64_t seed) {
    Dish after = *dish;
    PetriSession *session = open_dish(dish, steps, seed);
    step_dish(session, &after, steps);
    petri_close(&session);
    return after;
}

// Checks that two systems have the same positions and velocities. `tolerance` is relative to the largest of these
// numbers, or to 1 if it is smaller. If it is 0, the numbers must be equal; zeros of either sign are.
static inline void check_same(const char *law, uint64_t seed, const Dish *found, const Dish *wanted, double tolerance) {
    for (int i = 0; i < wanted->body_count; i++)
        for (int k = 0; k < 2 * wanted->dimensions; k++) {
            bool moving = k >= wanted->dimensions;
            int m = k % wanted->dimensions;
            double x = (moving ? found->bodies[i].velocity : found->bodies[i].position)[m];
            double y = (moving ? wanted->bodies[i].velocity : wanted->bodies[i].position)[m];
            if (!(fabs(x - y) <= tolerance * fmax(1, fmax(fabs(x), fabs(y)))))
                fail_msg("%s, seed %llu, %d dimensions: component %d of the %s of body %d is %.17g instead of %.17g",
                         law, (unsigned long long)seed, wanted->dimensions, m, moving ? "velocity" : "position", i, x,
                         y);
        }
}
