// divergence.h: detection of systems whose motion has become meaningless, mostly because a step is too long for a
// force.
//
// The rows are checked when at least ten steps were taken since the last check, so a step pays for a tenth of a look at
// each particle. The result depends only on positions, velocities and masses, and so not on threads, processor or
// processes. Potential energy is left out: it costs as much as a step, and its zero is arbitrary.
#pragma once

#include "physics/system.h"

// Magnitude above which a component of a position or velocity counts as divergent.
#define PHYS_DIVERGENT 1e100

typedef enum PhysDivergence {
    PHYS_CONVERGENT,
    PHYS_OVERFLOW, // a component has become infinite or NaN, or larger than PHYS_DIVERGENT; not in a run that started
                   // with components above PHYS_DIVERGENT
    PHYS_GROWTH, // in two successive checks, the kinetic energy had grown at least 4-fold per step (about a millionfold
                 // in ten steps), and some particle moves further in a step than half the largest distance of a
                 // particle from the origin
} PhysDivergence;

// Stores the start of a run, with which the next check compares. phys_simulate calls it when the clock is 0.
void phys_watch_start(PhysSystem *system);
// Checks the results of the last phys_simulate, which must have returned PHYS_OK. Sets *particle to the first particle
// that overflowed, or to the one with the most kinetic energy. Reports one divergence for each run of the system.
PhysDivergence phys_find_divergence(PhysSystem *system, uint32_t *particle);
