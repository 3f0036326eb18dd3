// integrate.h: everything that happens to a particle alone, in one go: single-particle forces, barriers, motion.
#ifndef PETRI_PHYSICS_INTEGRATE_H
#define PETRI_PHYSICS_INTEGRATE_H

#include "physics/internal.h"
#include "physics/kernels.h"

// What is done to the particles of one group.
typedef struct IntegratePass {
    const Columns *columns; // with a scratch of its own
    double delta;
    double speed_of_light;
    const Force *const *forces; // on single particles, then barriers; own ones first, then those of the parent, …
    uint32_t force_count;
    uint32_t barrier_count;  // so many of them, the last ones, are barriers
    bool keep_force;         // store the sums, which somebody may want to see; else leave 0 for the next step
    const atomic_bool *stop; // true: the rest is left out, for nobody wants the result any more; NULL: never
    uint64_t draw_count;     // random numbers that each random force has given to particles of the group so far
} IntegratePass;

static inline bool phys_integrate_stopped(const IntegratePass *pass) {
    return pass->stop && atomic_load_explicit(pass->stop, memory_order_relaxed);
}

static inline const Force *const *phys_barriers(const IntegratePass *pass) {
    return pass->forces + (pass->force_count - pass->barrier_count);
}

// The second half of a step for one group.
typedef struct Integrator {
    IntegrateKernel *kernel;
    size_t lanes;
    IntegratePass pass;
    const Group *group;
    bool wide;   // many particles at a time
    bool random; // one of the forces is
} Integrator;

// integrate.c: phys_integrate_begin, phys_integrate_rows for all particles of the group, phys_integrate_end. False if
// it is not to be, for the meter says so.
void phys_integrate(PhysSystem *system, uint32_t group, double delta, double speed_of_light);
bool phys_integrate_begin(PhysSystem *system, uint32_t group, double delta, double speed_of_light,
                          Integrator *integrator);
// Some of them, by any thread if `wide`. `first` is the group's first or a multiple of the lanes behind it.
void phys_integrate_rows(const Integrator *integrator, size_t first, size_t end);
void phys_integrate_end(const Integrator *integrator);
// Lets particle i, which had the velocity `before` and has just moved, bounce off all barriers.
void phys_integrate_reflect(const IntegratePass *pass, size_t i, const double *before);

#endif
