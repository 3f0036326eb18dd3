// integrate.h: the second half of a step: single-particle forces, barriers and motion, in one pass over a group.
#pragma once

#include "physics/internal.h"
#include "physics/kernels.h"

// Numbers of a random stream that are drawn ahead for a range of particles, because long arrays are faster.
typedef struct Draws {
    const Force *force; // the only force that uses them; NULL: none so far
    uint64_t first;     // item of the stream
    size_t count;
    double numbers[128];
} Draws;

// Parameters of the pass over one group, for the kernels.
typedef struct IntegratePass {
    const Columns *columns; // with a separate `scratch` for each thread
    double delta;
    double speed_of_light;
    const Force *const *forces; // single-particle forces, then barriers; each from the group outwards to the top
    uint32_t force_count;       // length of `forces`, with barriers
    uint32_t barrier_count;     // number of barriers, which are the last elements of `forces`
    bool old_barriers;          // SPEC_OLD_BARRIERS
    bool keep_force; // true: store the sums of forces for PhysColumns.force; false: set them to 0 for the next step
    const atomic_bool *stop; // set when the frame is aborted, so that the remaining particles are skipped; NULL: never
    uint64_t draw_count; // number of random numbers that each random force has drawn for the group so far in this step
    Draws *draws;        // of the present range of columns
    size_t end;          // end of this range
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
    bool wide;   // processes `lanes` particles at a time; chunks can run on any thread
    bool random; // one of the forces is random
} Integrator;

// integrate.c: takes the second half of a step for one group, by calling the three functions below.
void phys_integrate(PhysSystem *system, uint32_t group, double delta, double speed_of_light);
// Prepares `integrator`. Returns false if the budget is exceeded or the frame is interrupted.
bool phys_integrate_begin(PhysSystem *system, uint32_t group, double delta, double speed_of_light,
                          Integrator *integrator);
// Integrates particles first to end - 1. If `wide` is set, any thread may call this. `first` minus the group's first
// column must be a multiple of `lanes`.
void phys_integrate_rows(const Integrator *integrator, size_t first, size_t end);
// Advances the random streams by the items that the group has used.
void phys_integrate_end(const Integrator *integrator);
// barrier.c: reflects particle i, which has just moved, at all barriers. `before` is its velocity before the move.
void phys_integrate_reflect(const IntegratePass *pass, size_t i, const double *before);
