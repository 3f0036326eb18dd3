// random_model.h: random systems for the tests that compare lib/physics with the reference.
#pragma once

#include "reference.h"

typedef struct ModelShape {
    size_t dimensions;
    uint32_t groups, particles, forces;
    uint32_t hostile; // one in `hostile` numbers is extreme; 0: none
} ModelShape;

// Returns a number between the bounds. In hostile models, it is sometimes an extreme number instead.
static inline double model_number(Dice *dice, const ModelShape *shape, double low, double high) {
    static const double extremes[] = {NAN,    INFINITY, -INFINITY, 1e308, -1e308, 1e200, -1e155, 1e-308,
                                      5e-324, -5e-324,  -0.0,      0,     1e-160, 1e16,  -1};
    if (shape->hostile && dice_below(dice, shape->hostile) == 0)
        return extremes[dice_below(dice, COUNT_OF(extremes))];
    return dice_between(dice, low, high);
}

static inline void model_vector(Dice *dice, const ModelShape *shape, double *vector, double size) {
    for (size_t k = 0; k < shape->dimensions; k++)
        vector[k] = model_number(dice, shape, -size, size);
}

// Returns a radius or mass, which is often 0. It is never negative or NaN, because lib/scene clamps these values.
static inline double model_size(Dice *dice, const ModelShape *shape, double high) {
    if (dice_below(dice, 5) == 0)
        return 0;
    double size = model_number(dice, shape, 0, high);
    return size > 0 ? size : 0;
}

static inline double model_ease(Dice *dice, const ModelShape *shape) {
    return dice_below(dice, 3) ? 0 : model_number(dice, shape, -0.2, 0.6);
}

static inline void model_random_particle(Dice *dice, const ModelShape *shape, Model *model, ModelParticle *p) {
    *p = (ModelParticle){.group = dice_below(dice, shape->groups), .anchor = dice_below(dice, 6) == 0};
    // Some positions are on a coarse grid, so some particles coincide and others just touch.
    bool grid = dice_below(dice, 4) == 0;
    model_vector(dice, shape, p->position, 1);
    for (size_t k = 0; grid && k < model->n; k++)
        p->position[k] = floor(p->position[k] * 2) / 2;
    model_vector(dice, shape, p->velocity, 1);
    if (!p->anchor)
        model_vector(dice, shape, p->own_force, 0.5);
    p->ease = model_ease(dice, shape);
    p->radius = model_size(dice, shape, 0.3);
    p->mass = model_size(dice, shape, 2);
    p->charge = dice_below(dice, 5) ? model_number(dice, shape, -1, 1) : 0;
}

static inline void model_random_barrier(Dice *dice, const Model *model, ModelForce *f) {
    double sum = 0;
    for (size_t k = 0; k < model->n; k++) {
        f->vector[k] *= 0.3;
        f->vector2[k] = dice_between(dice, -1, 1); // the normal must not be zero, because lib/scene disables a barrier
                                                   // without one
        sum += f->vector2[k] * f->vector2[k];
    }
    for (size_t k = 0; k < model->n; k++)
        f->vector2[k] = f->vector2[k] / sqrt(sum);
    f->force.strength *= 10;
}

static inline void model_random_force(Dice *dice, const ModelShape *shape, const Model *model, ModelForce *f) {
    static const double powers[] = {0, 0.5, 1, 1, 2, 2, 3, -1};
    *f = (ModelForce){.group = dice_below(dice, shape->groups)};
    model_vector(dice, shape, f->vector, 1);
    model_vector(dice, shape, f->vector2, 1);
    PhysForceKind kind = (PhysForceKind)dice_below(dice, PHYS_FORCE_KINDS);
    f->force = (PhysForce){.kind = kind, .vector = f->vector, .vector2 = f->vector2};
    PhysForce *force = &f->force;
    force->strength = model_number(dice, shape, -0.5, 2);
    force->ease = model_ease(dice, shape);
    force->power = powers[dice_below(dice, COUNT_OF(powers))];
    force->max_distance = dice_below(dice, 2) ? model_number(dice, shape, -0.2, 1.5) : 0;
    force->overlap = dice_between(dice, 0, 1);
    force->density = model_number(dice, shape, -1, 9);
    force->restitution = dice_below(dice, 3) ? dice_between(dice, 0, 1) : dice_below(dice, 2);
    force->has_minimum = dice_below(dice, 2);
    force->has_maximum = dice_below(dice, 2);
    force->minimum = model_number(dice, shape, -0.2, 1);
    force->maximum = model_number(dice, shape, -0.2, 1.5);
    force->key = dice_next(dice);
    force->from = dice_below(dice, model->particle_count + 1); // the largest number is not a valid handle
    force->to = dice_below(dice, model->particle_count + 1);
    if (stage_of(f) == STAGE_BARRIER)
        model_random_barrier(dice, model, f);
}

// Adds groups in pre-order: the parent of each group is its predecessor or an ancestor of the predecessor.
static inline void model_random_groups(Dice *dice, const ModelShape *shape, Model *model) {
    model->group_count = shape->groups;
    model->parent[0] = 0;
    for (uint32_t g = 1; g < shape->groups; g++) {
        uint32_t parent = g - 1;
        while (parent && dice_below(dice, 3) == 0)
            parent = model->parent[parent];
        model->parent[g] = parent;
    }
}

static inline void model_random(Dice *dice, const ModelShape *shape, Model *model) {
    model->n = shape->dimensions;
    model->particle_count = shape->particles;
    model->force_count = shape->forces;
    model_random_groups(dice, shape, model);
    for (uint32_t i = 0; i < model->particle_count; i++)
        model_random_particle(dice, shape, model, &model->particles[i]);
    for (uint32_t i = 0; i < model->force_count; i++)
        model_random_force(dice, shape, model, &model->forces[i]);
}

// Simulates some frames of a random system with lib/physics and the reference. `options` may be NULL.
static inline void compare_random_with(uint64_t seed, const ModelShape *shape, int frames, const PhysOptions *options) {
    Dice dice = {seed * UINT64_C(0x9e3779b97f4a7c15) + 1};
    Model *model = calloc(1, sizeof *model);
    PhysSystem *system = phys_new();
    assert_non_null(model);
    assert_non_null(system);
    if (options)
        phys_set_options(system, options);
    model_random(&dice, shape, model);
    PhysTime time = {.resolution = 0.04, .performance = dice_between(&dice, 1, 2), .lockstep = dice_below(&dice, 2)};
    time.speed_of_light = dice_below(&dice, 2) ? 1.5 : 0;
    for (int frame = 0; frame < frames; frame++) {
        time.last = time.now;
        time.now += dice_between(&dice, 0.01, 0.15);
        double clock = time.clock;
        compare_frame(model, system, &time);
        time.clock = clock + (time.now - time.last);
    }
    phys_free(system);
    free(model);
}

static inline void compare_random(uint64_t seed, const ModelShape *shape, int frames) {
    compare_random_with(seed, shape, frames, NULL);
}
