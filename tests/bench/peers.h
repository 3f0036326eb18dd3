// peers.h: comparison with LAMMPS. petri and LAMMPS simulate the same systems in turn (tests/bench/peers).
#pragma once

#include "measure.h"
#include "table.h"

// For the table of targets: particle-steps per second of petri, divided by those of LAMMPS. NaN: not measured.
typedef struct PeerRatios {
    double discs_1e5[2]; // [0]: frames of one step, [1]: frames of ten steps
    double discs_1e6[2];
} PeerRatios;

// Returns true and the version if LAMMPS can be run. Otherwise prints a message and returns false.
bool peers_available(const char *folder, char *version, size_t size);
// Returns a table with one row per workload, steps per frame and force style.
Table peers_measure(const Plan *plan, const char *folder, PeerRatios *ratios);
