// peers.h: comparison with LAMMPS, which runs the same systems in turn with petri (tests/bench/peers).
#ifndef TESTS_BENCH_PEERS_H
#define TESTS_BENCH_PEERS_H

#include "measure.h"
#include "table.h"

// Ratios of particle-steps per second, petri / LAMMPS, for the rows with targets. NaN: not measured.
typedef struct PeerRatios {
    double discs_1e5[2]; // frames of one step, frames of ten steps
    double discs_1e6[2];
} PeerRatios;

// Returns true if LAMMPS can be run, with its version. Else returns false after a message.
bool peers_available(const char *folder, char *version, size_t size);
// Returns a table with one row per workload, steps per frame and force style.
Table peers_measure(const Plan *plan, const char *folder, PeerRatios *ratios);

#endif
