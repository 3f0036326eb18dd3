// workloads.c: see workloads.h.
#include "workloads.h"

#include "maths/random.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define CELL 12.0
#define DISC 10.0
#define PITCH 0.966953 // distance of neighbouring grid points; discs of diameter 1 then have an area fraction of 0.84

static const char *const names[WORKLOAD_KINDS] = {"dish",       "packed box",   "gravity",
                                                  "soft discs", "soft spheres", "charges"};

const char *workload_name(WorkloadKind kind) {
    return names[kind];
}

static double uniform(uint64_t stream, uint32_t i) {
    return random_uniform(stream * UINT64_C(0x9e3779b97f4a7c15) + 1, i);
}

static double normal(uint64_t stream, uint32_t i) {
    return random_normal(stream * UINT64_C(0x9e3779b97f4a7c15) + 1, i);
}

static void start_dish(Workload *w) {
    w->width = CELL * 3 * sqrt(w->n);
    w->delta = 1.0 / 60;
    for (uint32_t i = 0; i < w->n; i++) {
        double reach = (w->width - CELL) * sqrt(uniform(1, i)), turn = uniform(2, i);
        w->bodies[i] = (Body){.radius = CELL, .mass = 1, .charge = normal(3, i)};
        w->bodies[i].position[0] = reach * turns_cos(turn);
        w->bodies[i].position[1] = reach * turns_sin(turn);
    }
}

static void start_box(Workload *w) {
    uint32_t side = (uint32_t)ceil(sqrt(w->n));
    double pitch = 2.02 * DISC;
    w->width = side * pitch;
    w->delta = 1.0 / 60;
    for (uint32_t i = 0; i < w->n; i++) {
        w->bodies[i] = (Body){.radius = DISC * (0.85 + 0.15 * uniform(1, i)), .mass = 1};
        w->bodies[i].position[0] = (i % side + 0.5 + (uniform(2, i) - 0.5) * 0.1) * pitch;
        w->bodies[i].position[1] = (i / side + 0.5 + (uniform(3, i) - 0.5) * 0.1) * pitch;
    }
}

static void start_gravity(Workload *w) {
    w->delta = 1.0 / 60;
    for (uint32_t i = 0; i < w->n; i++) {
        w->bodies[i] = (Body){.radius = 2, .mass = 0.5 + uniform(1, i)};
        for (uint32_t k = 0; k < 3; k++) {
            w->bodies[i].position[k] = 100 * cbrt(w->n) * normal(2, 3 * i + k);
            w->bodies[i].velocity[k] = normal(3, 3 * i + k);
        }
    }
}

// Thermal soft discs or spheres of diameter 1 on a grid: the workloads of the comparison with LAMMPS.
static void start_soft(Workload *w) {
    uint32_t side = (uint32_t)lround(w->dimensions == 2 ? sqrt(w->n) : cbrt(w->n));
    double pitch = w->dimensions == 2 ? PITCH : 0.95551; // gives spheres a volume fraction of 0.60
    w->width = side * pitch;
    w->delta = 0.005;
    for (uint32_t i = 0; i < w->n; i++) {
        uint32_t place = i;
        w->bodies[i] = (Body){.radius = 0.5, .mass = 1};
        for (uint32_t k = 0; k < w->dimensions; k++, place /= side) {
            w->bodies[i].position[k] = (place % side + 0.5) * pitch;
            w->bodies[i].velocity[k] = normal(1 + k, i);
        }
    }
}

Workload workload_open(WorkloadKind kind, uint32_t n, const PhysOptions *options) {
    Workload w = {.kind = kind, .n = n, .dimensions = kind == GRAVITY || kind == SPHERES ? 3 : 2};
    w.bodies = calloc(n, sizeof *w.bodies);
    w.system = phys_new();
    if (!w.bodies || !w.system) {
        fputs("bench: out of memory\n", stderr);
        exit(1);
    }
    phys_set_options(w.system, options);
    if (kind == DISH || kind == CHARGES)
        start_dish(&w);
    else if (kind == BOX)
        start_box(&w);
    else if (kind == GRAVITY)
        start_gravity(&w);
    else
        start_soft(&w);
    return w;
}

void workload_close(Workload *workload) {
    phys_free(workload->system);
    free(workload->bodies);
}

static PhysForce force_of(PhysForceKind kind, double strength) {
    return (PhysForce){.kind = kind, .strength = strength, .power = 1, .restitution = 1};
}

static void add_dish(const Workload *w) {
    PhysParticle hub = {.anchor = true};
    uint32_t to = phys_add_particle(w->system, 0, &hub);
    for (uint32_t i = 0; i < w->n; i++) {
        PhysForce leash = force_of(PHYS_DISTANCE, 500);
        leash.from = i;
        leash.to = to;
        leash.has_maximum = true;
        leash.maximum = w->width - CELL;
        phys_add_force(w->system, 0, &leash);
    }
    PhysForce forces[] = {force_of(PHYS_ELECTROSTATIC, 150), force_of(PHYS_COLLISION, 5), force_of(PHYS_DRAG, 0.002),
                          force_of(PHYS_RANDOM, 8)};
    forces[3].key = w->frame * 77 + 1;
    for (int i = 0; i < 4; i++)
        phys_add_force(w->system, 0, &forces[i]);
}

// Walls at coordinates `low` and `high` in each dimension.
static void add_walls(const Workload *w, double low, double high, double restitution) {
    for (uint32_t k = 0; k < w->dimensions; k++)
        for (int end = 0; end < 2; end++) {
            double place[3] = {0}, inward[3] = {0};
            place[k] = end ? high : low;
            inward[k] = end ? -1 : 1;
            PhysForce wall = force_of(PHYS_BARRIER, 1);
            wall.restitution = restitution;
            wall.vector = place;
            wall.vector2 = inward;
            phys_add_force(w->system, 0, &wall);
        }
}

static void add_box(const Workload *w) {
    add_walls(w, 0, w->width + 4 * DISC, 0.5);
    PhysForce forces[] = {force_of(PHYS_COLLISION, 2000), force_of(PHYS_DRAG, 0.002), force_of(PHYS_CONSTANT, 1)};
    const double down[2] = {0, -50};
    forces[2].vector2 = down;
    for (int i = 0; i < 3; i++)
        phys_add_force(w->system, 0, &forces[i]);
}

static void describe_system(const Workload *w) {
    phys_begin(w->system, w->dimensions);
    for (uint32_t i = 0; i < w->n; i++) {
        const Body *body = &w->bodies[i];
        PhysParticle p = {.position = body->position, .velocity = body->velocity, .radius = body->radius};
        p.mass = body->mass;
        p.charge = body->charge;
        phys_add_particle(w->system, 0, &p);
    }
    if (w->kind == DISH) {
        add_dish(w);
    } else if (w->kind == BOX) {
        add_box(w);
    } else if (w->kind == CHARGES) {
        PhysForce force = force_of(PHYS_ELECTROSTATIC, 150);
        phys_add_force(w->system, 0, &force);
    } else if (w->kind == GRAVITY) {
        PhysForce force = force_of(PHYS_GRAVITY, 5000);
        phys_add_force(w->system, 0, &force);
    } else {
        PhysForce force = force_of(PHYS_COLLISION, 1000);
        phys_add_force(w->system, 0, &force);
        add_walls(w, -0.05, w->width + 0.05, 1);
    }
}

void workload_frame(Workload *w, int steps) {
    describe_system(w);
    PhysTime time = {.last = w->clock, .clock = w->clock, .resolution = w->delta, .lockstep = true, .performance = 1};
    time.now = w->clock + steps * w->delta;
    PhysResult result = phys_simulate(w->system, &time);
    if (result.status != PHYS_OK) {
        fputs("bench: the system was rejected\n", stderr);
        exit(1);
    }
    w->clock = result.clock;
    w->frame++;
    for (uint32_t i = 0; i < w->n; i++) {
        const double *position = phys_position(w->system, i), *velocity = phys_velocity(w->system, i);
        for (uint32_t k = 0; k < w->dimensions; k++) {
            w->bodies[i].position[k] = position[k];
            w->bodies[i].velocity[k] = velocity[k];
        }
    }
}
