// integrate.h: the second half of a step: single-particle forces, barriers and motion, in one pass over a group.
#ifndef PETRI_PHYSICS_INTEGRATE_H
#define PETRI_PHYSICS_INTEGRATE_H

#include "physics/internal.h"
#include "physics/kernels.h"

// Parameters of the pass over one group, for the kernels.
typedef struct IntegratePass {
    const Columns *columns; // with a separate `scratch` for each thread
    double delta;
    double speed_of_light;
    const Force *const *forces; // single-particle forces, then barriers; both from the group outwards to the top
    uint32_t force_count;
    uint32_t barrier_count;  // the last elements of `forces` that are barriers
    bool keep_force;         // true: store the sums for PhysColumns.force; false: leave zeros for the next step
    const atomic_bool *stop; // set when the frame is aborted, so that the remaining rows are skipped; NULL: never
    uint64_t draw_count;     // random numbers that each random force has drawn for the group so far
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
    bool wide;   // processes `lanes` particles at a time; chunks may run on any thread
    bool random; // one of the forces is random
} Integrator;

// integrate.c: runs phys_integrate_begin, phys_integrate_rows for all particles of the group, and phys_integrate_end.
// phys_integrate_begin returns false if the budget is exceeded or the frame is interrupted.
void phys_integrate(PhysSystem *system, uint32_t group, double delta, double speed_of_light);
bool phys_integrate_begin(PhysSystem *system, uint32_t group, double delta, double speed_of_light,
                          Integrator *integrator);
// Integrates particles first to end - 1, on any thread if `wide`. `first` minus the group's first column must be a
// multiple of `lanes`.
void phys_integrate_rows(const Integrator *integrator, size_t first, size_t end);
void phys_integrate_end(const Integrator *integrator);
// Reflects particle i, which has just moved, at all barriers. `before` is its velocity before the move.
void phys_integrate_reflect(const IntegratePass *pass, size_t i, const double *before);

#endif
