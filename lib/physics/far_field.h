// far_field.h: approximate pair forces with `theta` (spec far-field.md): trees, multipole moments and their kernels.
//
// A forest holds one tree for each group with particles. It is built at most once per step for masses and once for
// charges. The particles of a tree that have a source (a mass or charge other than 0) and a finite position are its
// members. They are copied in the order of the tree, at the same indices as the columns of their group.
#pragma once

#include "physics/internal.h"
#include "physics/kernels.h"

enum {
    FAR_DIMENSIONS = 3, // maximum number of dimensions
    FAR_LEAF = 32,      // maximum number of members of a cell that is not divided, unless their keys are equal
    FAR_GROUP = 64,     // maximum number of targets of a walk
    FAR_SUMS = 8,       // number of partial sums; a multiple of the lanes of all kernels
    FAR_PAIRS = 512,    // number of sources in a block, a multiple of FAR_SUMS
    FAR_CELLS = 256,    // number of cells in a block, a multiple of FAR_SUMS
    FAR_LEVELS = 42,    // maximum depth of a tree
    FAR_QUADRUPOLE = 6, // components xx, xy, xz, yy, yz, zz
    FAR_PAIR = 2,       // cost of an exact pair, in evaluations of a cell
    FAR_VISIT = 4,      // cost of visiting a cell, in evaluations of a cell
};

// A cell of a tree. Cells are in depth-first order, and the children of a cell are in the order of their keys.
typedef struct FarCell {
    double centre[FAR_DIMENSIONS]; // scaled
    double size;                   // distance from the centre that no member exceeds; scaled
    double radius;                 // largest radius of a member; scaled
    double weight;                 // sum of the absolute values of the sources
    uint32_t first, end;           // members
    uint32_t skip;                 // first cell after the descendants of this cell
    bool point;                    // a leaf whose members all have the same position
} FarCell;

typedef struct FarMoments {
    double monopole;
    double dipole[FAR_DIMENSIONS]; // charges only
    double quadrupole[FAR_QUADRUPOLE];
} FarMoments;

// The tree of a group.
typedef struct FarTree {
    uint32_t root, end;    // cells
    uint32_t first, count; // members
} FarTree;

struct FarForest {
    bool charges; // sources are charges; false: masses
    bool built;   // for the current step
    size_t dimensions;
    size_t stride;              // distance between two components of a member
    double low[FAR_DIMENSIONS]; // lower corner of the cube
    double half_scale;          // scaled = (x / 2 - low / 2) · half_scale
    double scale;               // half_scale / 2: one divided by the side of the cube
    uint32_t cell_count;
    double *position[FAR_DIMENSIONS]; // by member
    double *scaled[FAR_DIMENSIONS];
    double *source;
    double *radius;
    uint32_t *column;
    Buffer members; // memory of the arrays above
    Buffer keys;    // FarKey
    Buffer cells;   // FarCell
    Buffer moments; // FarMoments
    Buffer trees;   // FarTree by group
    Buffer targets; // FarTargets: the groups of targets of the running pass
    Buffer scratch; // FarScratch
    Buffer results; // double: with several processes, forces in the order in which they are exchanged
    Buffer places;  // size_t: places in `results`
};

// A block of sources for exact pairs.
typedef struct FarPairs {
    double position[FAR_DIMENSIONS][FAR_PAIRS];
    double source[FAR_PAIRS];
    double radius[FAR_PAIRS];
    size_t count;
} FarPairs;

// A block of accepted cells.
typedef struct FarCells {
    double centre[FAR_DIMENSIONS][FAR_CELLS];
    double monopole[FAR_CELLS];
    double dipole[FAR_DIMENSIONS][FAR_CELLS];
    double quadrupole[FAR_QUADRUPOLE][FAR_CELLS];
    size_t count;
} FarCells;

typedef struct FarTarget {
    double position[FAR_DIMENSIONS];
    double scaled[FAR_DIMENSIONS];
    double source;
    double radius;
    double pair_sums[FAR_DIMENSIONS][FAR_SUMS];
    double cell_sums[FAR_DIMENSIONS][FAR_SUMS];
    uint32_t column;
} FarTarget;

// Working memory of a chunk.
typedef struct FarScratch {
    FarPairs pairs;
    FarCells cells;
    FarTarget targets[FAR_GROUP];
    size_t target_count;
    bool any_cell;        // a cell was accepted for the current targets
    uint64_t evaluations; // the cost of pairs and cells that were evaluated for a target, and of visited cells
} FarScratch;

// Adds the exact forces of a block of sources to the partial sums of the targets. The count of the block must be a
// multiple of FAR_SUMS. Sources whose position is NaN have no effect.
typedef void FarPairKernel(const FarPairs *pairs, const PairTerm *term, FarTarget *targets, size_t count);
// Adds the field of a block of cells to the partial sums of the targets.
typedef void FarCellKernel(const FarCells *cells, FarTarget *targets, size_t count);

struct FarKernels {
    FarPairKernel *pairs[PHYS_FORCE_KINDS][FAR_DIMENSIONS + 1]; // by PhysForceKind and dimensions
    FarCellKernel *cells[FAR_DIMENSIONS + 1][2];                // by dimensions; 1: charges
};

// far_tree.c: builds the trees of all groups for the current positions. Returns false if out of memory.
bool phys_far_build(PhysSystem *system, FarForest *forest);
// far_moments.c: computes centres, sizes and moments of all cells.
void phys_far_moments(FarForest *forest);

// far_sort.c
typedef struct FarKey {
    uint64_t high; // levels 0 to 20, one digit per level
    uint64_t low;  // levels 21 to 41
    uint32_t column;
} FarKey;
// Sorts by key; keys that are equal keep their order. `spare` is working memory for `count` keys.
void phys_far_sort(FarKey *keys, FarKey *spare, size_t count);

static inline const FarTree *phys_far_tree(const FarForest *forest, uint32_t group) {
    return (const FarTree *)forest->trees.bytes + group;
}
