// stats.h: the table that `petri run --stats` prints at the end.
#pragma once

#include "petri.h"

#include <stdint.h>

// Sums over the frames of a run.
typedef struct Stats {
    int64_t frames;
    uint64_t physics_steps;
    double particle_steps; // sum over all systems: steps times particles
    double evaluation_seconds;
    double physics_seconds;
    double output_seconds;
} Stats;

// Counts a computed frame. Does not change output_seconds, which the caller maintains. `session`: counts
// particle_steps; NULL: does not.
void stats_count(Stats *stats, const PetriFrame *frame, PetriSession *session);
// Writes the table to standard error: the sums, and for each system of the last frame its kinetic energy, momentum and
// fastest particle. If `ranks` is not NULL, all ranks must call this function, and the table has communication
// statistics.
void stats_print(const Stats *stats, PetriSession *session, double seconds, const PetriRanks *ranks);
