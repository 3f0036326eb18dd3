// ranks.h: division of particle systems among processes (ranks) that simulate the same systems together.
//
// All ranks make the same calls of lib/physics. It calls the hooks of PhysDivision, which divide a system in one of two
// ways: by region (domain.h), or by blocks of pairs (pair_ranks.c). Results are those of one process, bit for bit.
#pragma once

#include "petri-ranks.h"
#include "physics/division.h"

// A zeroed struct is one process.
typedef struct Ranks {
    PhysDivision division; // first, because the hooks find this struct by PhysOptions.division
    PetriRanks calls;
} Ranks;

// Returns false in a build without ranks.
bool ranks_available(void);
// Returns the value of PhysOptions.division for these ranks, which are copied to *ranks. `ranks` must outlive all
// systems with these options. Returns NULL for one process, or if `calls` is NULL.
const PhysDivision *ranks_init(Ranks *ranks, const PetriRanks *calls);
// Returns what this rank has communicated for a system.
PetriRankStats ranks_stats(const PhysSystem *system);

static inline const PetriRanks *ranks_of(const PhysSystem *system) {
    return &((const Ranks *)system->options.division)->calls;
}

static inline uint32_t ranks_count(const PhysSystem *system) {
    return (uint32_t)ranks_of(system)->rank_count;
}

static inline uint32_t ranks_self(const PhysSystem *system) {
    return (uint32_t)ranks_of(system)->rank;
}

// pair_ranks.c: implements PhysDivision.compute_pairs.
bool ranks_compute_pairs(PhysSystem *system, const PairRegion *region);
// pair_ranks.c: implement PhysDivision.processes and PhysDivision.gather, which passes with `theta` use.
PhysProcesses ranks_processes(const PhysSystem *system);
void ranks_gather(PhysSystem *system, double *numbers, const size_t *starts);
