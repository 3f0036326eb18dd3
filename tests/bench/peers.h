// peers.h: LAMMPS on the same systems, taking turns with petri (tests/bench/peers).
#ifndef TESTS_BENCH_PEERS_H
#define TESTS_BENCH_PEERS_H

#include "measure.h"
#include "table.h"

// Ratios of particle-steps per second, petri / LAMMPS, of the rows that the issue names; NaN if not measured.
typedef struct PeerRatios {
    double discs_1e5[2]; // whole frames of one step, and of ten
    double discs_1e6[2];
} PeerRatios;

// Tells on stderr why LAMMPS cannot be run, if so.
bool peers_available(const char *folder, char *version, size_t size);
// One row per workload, steps per frame and style of force.
Table peers_measure(const Plan *plan, const char *folder, PeerRatios *ratios);

#endif
