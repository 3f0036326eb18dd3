// reference.h: a slow, literal implementation of section 4 of the specification.
//
// Particles are an array of structs in order of declaration, groups are found by linear search, and each sum is written
// as in the specification. Tests compare the results of lib/physics with this code bit for bit.
#pragma once

#include "maths/maths.h"
#include "maths/random.h"
#include "physics/forces.h"
#include "support.h"

enum { MODEL_MAX = 256, MODEL_DIMENSIONS = 8 };

typedef struct ModelParticle {
    uint32_t group;
    bool anchor;
    double position[MODEL_DIMENSIONS], velocity[MODEL_DIMENSIONS], own_force[MODEL_DIMENSIONS];
    double ease, radius, mass, charge;
    double force[MODEL_DIMENSIONS], acceleration[MODEL_DIMENSIONS];
} ModelParticle;

typedef struct ModelForce {
    uint32_t group;
    PhysForce force; // its vectors point to the arrays below
    double vector[MODEL_DIMENSIONS], vector2[MODEL_DIMENSIONS];
    double strength; // after easing in
    uint64_t item;
} ModelForce;

// A system for lib/physics and the reference. All arrays are in order of declaration.
typedef struct Model {
    size_t n;
    uint32_t group_count, particle_count, force_count;
    uint32_t parent[MODEL_MAX];
    ModelParticle particles[MODEL_MAX];
    ModelForce forces[MODEL_MAX];
} Model;

static inline void model_feed(const Model *model, PhysSystem *system) {
    phys_begin(system, (uint32_t)model->n);
    for (uint32_t g = 1; g < model->group_count; g++)
        assert_int_equal(phys_add_group(system, model->parent[g]), g);
    for (uint32_t i = 0; i < model->force_count; i++)
        phys_add_force(system, model->forces[i].group, &model->forces[i].force);
    for (uint32_t i = 0; i < model->particle_count; i++) {
        const ModelParticle *p = &model->particles[i];
        PhysParticle given = {.position = p->position, .velocity = p->velocity, .force = p->own_force};
        given.ease = p->ease;
        given.radius = p->radius;
        given.mass = p->mass;
        given.charge = p->charge;
        given.anchor = p->anchor;
        assert_int_equal(phys_add_particle(system, p->group, &given), i);
    }
}

static inline Stage stage_of(const ModelForce *f) {
    return phys_force_row(f->force.kind).stage;
}

static inline double to_the_power(double x, double power) {
    if (power < 0)
        power = 0;
    return power == 1 ? x : power == 2 ? x * x : maths_pow(x, power);
}

static inline void no_reference(PhysForceKind kind) {
    print_error("reference.h has no formula for force %d\n", kind);
    fail();
}

// Sets *K of a link, which attracts if it is positive. Returns false if no force acts.
static inline bool link_coefficient(const ModelForce *f, double l, double *K) {
    const PhysForce *given = &f->force;
    if (given->kind != PHYS_DISTANCE)
        no_reference(given->kind);
    if (given->has_minimum && l < given->minimum) {
        *K = -(to_the_power(given->minimum - l, given->power) * f->strength);
        return true;
    }
    *K = to_the_power(l - given->maximum, given->power) * f->strength;
    return given->has_maximum && l > given->maximum;
}

// 4.1: sets *K of a pair at distance l, which attracts if it is positive. Returns false if no force acts.
static inline bool coefficient(const ModelForce *f, const ModelParticle *from, const ModelParticle *to, double l,
                               double *K) {
    double S = f->strength, r1 = from->radius, r2 = to->radius;
    if (stage_of(f) == STAGE_LINK)
        return link_coefficient(f, l, K);
    if (f->force.max_distance > 0 && !(l < f->force.max_distance))
        return false;
    double D = r1 + r2 > l ? r1 + r2 : l, o = r1 + r2 - l;
    double a = fabs(r1 - r2) * f->force.overlap + (r1 + r2) * (1 - f->force.overlap);
    bool touch = r1 != 0 && r2 != 0 && l < r1 + r2;
    switch ((int)f->force.kind) {
    case PHYS_COLLISION:
        *K = -(to_the_power(o, f->force.power) * S);
        return touch;
    case PHYS_GRAVITY:
        *K = (S * (from->mass * to->mass)) / (D * D);
        return from->mass != 0 && to->mass != 0;
    case PHYS_ELECTROSTATIC:
        *K = -((S * (from->charge * to->charge)) / (D * D));
        return from->charge != 0 && to->charge != 0;
    case PHYS_ADHESION:
        *K = S * o * (l - a);
        return touch;
    default:
        no_reference(f->force.kind);
        return false;
    }
}

static inline void reference_pair(const Model *model, const ModelForce *f, ModelParticle *from, ModelParticle *to) {
    double d[MODEL_DIMENSIONS], sum = 0, K;
    for (size_t k = 0; k < model->n; k++) {
        d[k] = to->position[k] - from->position[k];
        sum = sum + d[k] * d[k];
    }
    double l = sqrt(sum);
    if (l == 0 || !isfinite(l) || !coefficient(f, from, to, l, &K))
        return;
    double inv = 1 / l;
    for (size_t k = 0; k < model->n; k++) {
        double u = d[k] * inv, fk = u * K;
        from->force[k] = from->force[k] + fk;
        to->force[k] = to->force[k] - fk;
    }
}

// One pass: applies the pair forces that group A declares between each particle i of group G and each later particle j
// of T. T contains the particles of G, followed by those of its enclosing groups up to A.
static inline void reference_pass(Model *model, uint32_t G, uint32_t A) {
    ModelParticle *T[MODEL_MAX];
    uint32_t size = 0, own = 0;
    for (uint32_t level = G;; level = model->parent[level]) {
        for (uint32_t i = 0; i < model->particle_count; i++)
            if (model->particles[i].group == level)
                T[size++] = &model->particles[i];
        if (level == G)
            own = size;
        if (level == A)
            break;
    }
    for (uint32_t i = 0; i < own; i++)
        for (uint32_t j = i + 1; j < size; j++)
            for (uint32_t f = 0; f < model->force_count; f++)
                if (model->forces[f].group == A && stage_of(&model->forces[f]) == STAGE_PAIR)
                    reference_pair(model, &model->forces[f], T[i], T[j]);
}

static inline void reference_stage_1(Model *model) {
    for (uint32_t G = 0; G < model->group_count; G++) {
        for (uint32_t f = 0; f < model->force_count; f++) {
            ModelForce *force = &model->forces[f];
            if (force->group == G && stage_of(force) == STAGE_LINK && force->force.from < model->particle_count &&
                force->force.to < model->particle_count)
                reference_pair(model, force, &model->particles[force->force.from], &model->particles[force->force.to]);
        }
        for (uint32_t A = G;; A = model->parent[A]) {
            reference_pass(model, G, A);
            if (A == 0)
                break;
        }
    }
}

static inline void reference_drag(const Model *model, const ModelForce *f, ModelParticle *p, double delta) {
    if (p->radius == 0)
        return;
    double sum = 0;
    for (size_t k = 0; k < model->n; k++)
        sum = sum + (p->velocity[k] - f->vector[k]) * (p->velocity[k] - f->vector[k]);
    double c = f->strength * sqrt(sum) * maths_pow(p->radius, (double)model->n - 1);
    if (c > p->mass / delta)
        c = p->mass / delta;
    for (size_t k = 0; k < model->n; k++)
        p->force[k] = p->force[k] - (p->velocity[k] - f->vector[k]) * c;
}

static inline void reference_single(const Model *model, ModelForce *f, ModelParticle *p, double delta) {
    double S = f->strength;
    bool sinks = f->force.kind == PHYS_BUOYANCY && p->radius != 0 && p->mass != 0;
    if (f->force.kind == PHYS_DRAG) {
        reference_drag(model, f, p, delta);
        return;
    }
    for (size_t k = 0; k < model->n; k++) {
        double contribution = 0;
        if (f->force.kind == PHYS_CONSTANT)
            contribution = (f->vector[k] + f->vector2[k] * p->mass) * S;
        else if (f->force.kind == PHYS_RANDOM)
            contribution = S * random_normal(f->force.key, f->item++);
        else if (f->force.kind == PHYS_FIELD)
            contribution = S * f->vector[k] * p->charge;
        else if (sinks)
            contribution = f->vector[k] * (S * (p->mass - maths_pow(p->radius, (double)model->n) * f->force.density));
        else if (f->force.kind == PHYS_BUOYANCY)
            continue;
        else
            no_reference(f->force.kind);
        p->force[k] = p->force[k] + contribution;
    }
}

static inline void reference_constraint(const Model *model, const ModelForce *f, ModelParticle *p) {
    double s = 0;
    for (size_t k = 0; k < model->n; k++)
        s = s + (p->position[k] - f->vector[k]) * f->vector2[k];
    const PhysForce *b = &f->force;
    for (size_t k = 0; k < model->n; k++)
        if (b->has_minimum && b->minimum > 0 && 0 <= s && s < b->minimum)
            p->force[k] = p->force[k] + f->vector2[k] * (to_the_power(b->minimum - s, b->power) * f->strength);
        else if (b->has_maximum && s > b->maximum)
            p->force[k] = p->force[k] - f->vector2[k] * (to_the_power(s - b->maximum, b->power) * f->strength);
}

static inline void reference_motion(const Model *model, ModelParticle *p, double delta, double speed_of_light) {
    double before[MODEL_DIMENSIONS], sum = 0;
    bool finite = true;
    memcpy(before, p->velocity, sizeof before);
    for (size_t k = 0; k < model->n; k++)
        finite = finite && isfinite(p->force[k]);
    if (p->mass != 0 && finite) {
        double c = delta / p->mass;
        for (size_t k = 0; k < model->n; k++)
            p->velocity[k] = p->velocity[k] + p->force[k] * c;
        for (size_t k = 0; k < model->n; k++)
            sum = sum + p->velocity[k] * p->velocity[k];
        if (speed_of_light > 0 && sum > speed_of_light * speed_of_light)
            for (size_t k = 0; k < model->n; k++)
                p->velocity[k] = p->velocity[k] * (speed_of_light / sqrt(sum));
    }
    for (size_t k = 0; k < model->n; k++) {
        p->acceleration[k] = (p->velocity[k] - before[k]) / delta;
        p->position[k] = p->position[k] + p->velocity[k] * delta;
    }
}

static inline double reference_along(const double *vector, const double *normal, size_t n) {
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum = sum + vector[k] * normal[k];
    return sum;
}

static inline void reference_bounce(const Model *model, const ModelForce *f, ModelParticle *p, double delta,
                                    double speed_of_light) {
    size_t n = model->n;
    double *pos = p->position, *v = p->velocity, *a = p->acceleration;
    const double *normal = f->vector2;
    double x = -p->radius, w = 0, b = 0;
    for (size_t k = 0; k < n; k++) {
        x = x + (pos[k] - f->vector[k]) * normal[k];
        w = w + v[k] * normal[k];
        b = b + a[k] * normal[k];
    }
    if (x >= 0)
        return;
    if (!(w < 0)) {
        for (size_t k = 0; k < n; k++)
            pos[k] = pos[k] - x * normal[k];
        return;
    }
    double tau = x / w;
    if (tau > delta)
        tau = delta;
    for (size_t k = 0; k < n; k++) {
        pos[k] = pos[k] - tau * v[k];
        v[k] = v[k] - tau * a[k];
    }
    double arrival = reference_along(v, normal, n), limit = 0;
    if (b < 0)
        limit = b * delta;
    if (arrival < limit) {
        for (size_t k = 0; k < n; k++)
            v[k] = v[k] * f->force.restitution;
        double rest = reference_along(v, normal, n);
        for (size_t k = 0; k < n && rest < 0; k++)
            v[k] = v[k] - (2 * rest) * normal[k];
    } else if (arrival < 0) {
        for (size_t k = 0; k < n; k++)
            v[k] = v[k] - (arrival * (1 + f->force.restitution)) * normal[k];
    }
    double contact[MODEL_DIMENSIONS];
    memcpy(contact, v, n * sizeof *v);
    if (tau > 0)
        reference_motion(model, p, tau, speed_of_light);
    w = reference_along(v, normal, n);
    for (size_t k = 0; k < n && w < 0; k++)
        v[k] = v[k] - w * normal[k];
    x = -p->radius;
    for (size_t k = 0; k < n; k++)
        x = x + (pos[k] - f->vector[k]) * normal[k];
    for (size_t k = 0; k < n && x < 0; k++)
        pos[k] = pos[k] - x * normal[k];
    for (size_t k = 0; k < n; k++)
        a[k] = tau > 0 ? (v[k] - contact[k]) / tau : 0;
}

// Applies the stages of one step to a particle. Each stage processes the forces of its group, then those of the parent,
// and so on.
static inline void reference_particle(Model *model, ModelParticle *p, double delta, double speed_of_light) {
    enum { SINGLE, CONSTRAINT, MOTION, BOUNCE, STAGES };
    for (int stage = 0; stage < STAGES; stage++) {
        if (stage == MOTION) {
            reference_motion(model, p, delta, speed_of_light);
            continue;
        }
        for (uint32_t level = p->group;; level = model->parent[level]) {
            for (uint32_t i = 0; i < model->force_count; i++) {
                ModelForce *f = &model->forces[i];
                if (f->group != level)
                    continue;
                if (stage == SINGLE && stage_of(f) == STAGE_SINGLE)
                    reference_single(model, f, p, delta);
                if (stage == CONSTRAINT && stage_of(f) == STAGE_BARRIER)
                    reference_constraint(model, f, p);
                if (stage == BOUNCE && stage_of(f) == STAGE_BARRIER)
                    reference_bounce(model, f, p, delta, speed_of_light);
            }
            if (level == 0)
                break;
        }
    }
}

static inline void reference_step(Model *model, double clock, double delta, double speed_of_light) {
    for (uint32_t i = 0; i < model->force_count; i++) {
        ModelForce *f = &model->forces[i];
        f->strength = f->force.strength;
        if (f->force.ease > 0 && clock < f->force.ease)
            f->strength = f->force.strength * (clock / f->force.ease);
    }
    for (uint32_t i = 0; i < model->particle_count; i++) {
        ModelParticle *p = &model->particles[i];
        for (size_t k = 0; k < model->n; k++) {
            p->force[k] = p->own_force[k];
            if (p->ease > 0 && clock < p->ease)
                p->force[k] = p->own_force[k] * (clock / p->ease);
        }
    }
    reference_stage_1(model);
    for (uint32_t G = 0; G < model->group_count; G++)
        for (uint32_t i = 0; i < model->particle_count; i++)
            if (model->particles[i].group == G && !model->particles[i].anchor)
                reference_particle(model, &model->particles[i], delta, speed_of_light);
}

static inline PhysResult reference_simulate(Model *model, const PhysTime *time) {
    double last = time->last, t = time->now, clock = time->clock, remaining = t - last;
    uint64_t steps = 0;
    bool more;
    for (uint32_t i = 0; i < model->particle_count; i++)
        if (model->particles[i].anchor)
            memset(model->particles[i].velocity, 0, sizeof model->particles[i].velocity);
    for (uint32_t i = 0; i < model->force_count; i++)
        model->forces[i].item = 0;
    do {
        double delta = fmin(time->resolution, remaining);
        if (last + delta == last)
            return (PhysResult){PHYS_DROPPED_TIME, clock, steps};
        reference_step(model, clock, delta, time->speed_of_light);
        steps = steps + 1;
        clock = clock + delta;
        last = last + delta;
        remaining = t - last;
        more = remaining > 1e-9 * time->resolution;
    } while (more && (time->lockstep || (steps == 1 && time->performance > 1.5)));
    return (PhysResult){PHYS_OK, clock, steps};
}

// Returns true if the bits are the same, or if both are NaN with any sign and payload.
static inline bool same_bits(const double *a, const double *b, size_t n) {
    for (size_t k = 0; k < n; k++)
        if (memcmp(&a[k], &b[k], sizeof *a) && !(isnan(a[k]) && isnan(b[k])))
            return false;
    return true;
}

// Simulates a frame with lib/physics and the reference and compares. Afterwards the model has the new positions and
// velocities.
static inline void compare_frame(Model *model, PhysSystem *system, const PhysTime *time) {
    model_feed(model, system);
    PhysResult found = phys_simulate(system, time), wanted = reference_simulate(model, time);
    assert_int_equal(found.status, wanted.status);
    assert_int_equal(found.steps, wanted.steps);
    assert_true(same_bits(&found.clock, &wanted.clock, 1));
    for (uint32_t i = 0; i < model->particle_count; i++) {
        const ModelParticle *p = &model->particles[i];
        const double *position = phys_position(system, i), *velocity = phys_velocity(system, i);
        if (same_bits(position, p->position, model->n) && same_bits(velocity, p->velocity, model->n))
            continue;
        print_error("particle %u of group %u, %zu dimensions: position[0] %a %a velocity[0] %a %a\n", i, p->group,
                    model->n, position[0], p->position[0], velocity[0], p->velocity[0]);
        fail();
    }
}
