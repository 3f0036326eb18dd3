// pair_wavefront.h: computes all pairs of a pass on several threads, or row by row.
#pragma once

#include "physics/internal.h"
#include "physics/kernels.h"

// The pairs within one range of particles (a triangle, whose columns are the same particles as its rows), or between
// two ranges (a rectangle).
typedef struct PairRegion {
    PairKernel *kernel;
    const PairPass *pass;
    bool triangle;
    size_t row, row_end;
    size_t column, column_end;
} PairRegion;

// A region divided into square blocks. The last blocks of a row or column may be smaller.
typedef struct PairBlocks {
    const PairRegion *pairs;
    size_t block;   // side of a block, in particles
    size_t rows;    // number of blocks in a column
    size_t columns; // number of blocks in a row
} PairBlocks;

// Returns the number of pairs in a region.
static inline uint64_t phys_region_pairs(const PairRegion *region) {
    return (region->row_end - region->row) * (region->column_end - region->column) / (region->triangle ? 2 : 1);
}

// Divides a region into about `blocks_per_column` blocks per column, each with at least `min_rows` rows.
PairBlocks phys_pair_blocks(const PairRegion *pairs, size_t blocks_per_column, size_t min_rows);
// Computes the pairs of one block.
void phys_pair_block(const PairBlocks *blocks, size_t row, size_t column);

// pair_rows.c: returns a pass that uses these columns and as yet has no forces.
PairPass phys_columns_pass(const Columns *columns);
// Fills one term per force.
void phys_fill_terms(PairTerm *terms, ForceRange forces);
// Computes the pairs of particle i with particles first to end - 1, in ascending order.
void phys_pair_row(const PairPass *pass, size_t i, size_t first, size_t end);

// A function that moves particles as soon as their forces are complete. Any thread may call it.
typedef struct PairMotion {
    void (*move)(const void *context, size_t first, size_t end);
    const void *context;
} PairMotion;

// Returns how many threads to use for `pairs` pairs; 0: do not use phys_pair_wavefront.
int phys_wavefront_threads(const PhysSystem *system, uint64_t pairs);
// Computes a region on several threads. `motion` moves the particles of a triangle; NULL: they do not move.
void phys_pair_wavefront(const PhysSystem *system, const PairRegion *pairs, int threads, const PairMotion *motion);
