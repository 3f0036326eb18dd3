// stats.h: the table that `petri run --stats` closes with.
#ifndef PETRI_SRC_STATS_H
#define PETRI_SRC_STATS_H

#include "petri.h"

#include <stdint.h>

// Sums over the frames of a run.
typedef struct Stats {
    int64_t frames;
    uint64_t physics_steps;
    double particle_steps; // steps of each system times its particles
    double evaluation_seconds;
    double physics_seconds;
    double output_seconds;
} Stats;

// Counts a frame that was made. Its output is counted by whoever writes it.
void stats_count(Stats *stats, PetriSession *session);
// Writes the table to standard error: the sums, and for each system of the last frame its energy, momentum and fastest
// particle; with `ranks`, which must all come here, also what they sent each other.
void stats_print(const Stats *stats, PetriSession *session, double seconds, const PetriRanks *ranks);

#endif
