// sweep.h: everything that happens to a particle alone, in one go: single-particle forces, barriers, motion.
#ifndef PETRI_PHYSICS_SWEEP_H
#define PETRI_PHYSICS_SWEEP_H

#include "physics/internal.h"

enum { PHYS_SWEEP_FORCES = 24 }; // most single forces, and most barriers, of a group and those around it

// What is done to the particles of one group.
typedef struct SweepPass {
    const Columns *columns; // with a scratch of its own
    double delta;
    double speed_of_light;
    uint32_t single_count;
    uint32_t barrier_count;
    bool keep_force; // store the sums: bounces move again with the same force, and somebody may want to see it
    const Force *singles[PHYS_SWEEP_FORCES];  // own ones first, then those of the parent, …
    const Force *barriers[PHYS_SWEEP_FORCES]; // likewise
    uint64_t items[PHYS_SWEEP_FORCES];        // random: item for the next particle, by single force
} SweepPass;

// sweep.c: the second half of a step for one group; false if it is one for the scalar code.
bool phys_sweep(PhysSystem *system, uint32_t group, double delta, double speed_of_light);
// Lets particle i, which had the velocity `before` and has just moved, bounce off all barriers.
void phys_sweep_bounce(const SweepPass *pass, size_t i, const double *before);

#endif
