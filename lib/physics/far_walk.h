// far_walk.h: a walk through the cells of a tree for one group of targets (far_field.h).
#pragma once

#include "physics/far_field.h"

// The targets of a walk: members first to end - 1 of a tree.
typedef struct FarTargets {
    uint32_t first, end;
} FarTargets;

// The far field that the members of one tree exert on those of a tree of the same forest.
typedef struct FarPass {
    const PhysSystem *system;
    FarForest *forest;
    const FarTree *sources;
    const FarTree *targets;
    PairTerm term;
    double opening_squared;  // square of 2 theta / 3
    double bound;            // max_distance, scaled; infinite: none
    const atomic_bool *stop; // as in PairPass
} FarPass;

// The work of a walk for each of its targets, without evaluating anything.
typedef struct FarCount {
    uint64_t pairs;  // sources that are computed in pairs
    uint64_t visits; // visited cells
} FarCount;
FarCount phys_far_count(const FarPass *pass, FarTargets targets);

// Evaluates the forces on some targets of the pass. `forces` receives the forces of the targets that are not anchors,
// n doubles each; NULL: they are added to the columns. Uses and updates *scratch.
void phys_far_walk(const FarPass *pass, FarTargets targets, FarScratch *scratch, double *forces);
