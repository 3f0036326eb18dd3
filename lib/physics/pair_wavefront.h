// pair_wavefront.h: all pairs of a pass on several threads, or one row at a time.
#ifndef PETRI_PHYSICS_PAIR_WAVEFRONT_H
#define PETRI_PHYSICS_PAIR_WAVEFRONT_H

#include "physics/internal.h"
#include "physics/kernels.h"

// The pairs of one range (a triangle; the columns are its rows), or of two.
typedef struct PairRegion {
    const PairKernel *kernel;
    const PairPass *pass;
    bool triangle;
    size_t row, row_end;
    size_t column, column_end;
} PairRegion;

// The same, cut into blocks of as many rows as columns; the last ones may be smaller.
typedef struct PairBlocks {
    const PairRegion *pairs;
    size_t block;
    size_t rows;    // blocks in a column
    size_t columns; // blocks in a row
} PairBlocks;

// `part` blocks in a column, if they do not have fewer than `smallest` rows then.
PairBlocks phys_pair_blocks(const PairRegion *pairs, size_t blocks_per_column, size_t min_rows);
void phys_pair_block(const PairBlocks *blocks, size_t row, size_t column);

// pair_rows.c: the pairs of particle i with the particles first … end - 1, in ascending order.
void phys_pair_row(const PairPass *pass, size_t i, size_t first, size_t end);

// What is done to particles whose forces are whole, as soon as they are. By any thread.
typedef struct PairMotion {
    void (*move)(const void *context, size_t first, size_t end);
    const void *context;
} PairMotion;

// With how many threads to go over so many pairs; 0: without a wave.
int phys_wavefront_threads(const PhysSystem *system, uint64_t pairs);
// `motion`: of the particles of a triangle, or NULL.
void phys_pair_wavefront(const PhysSystem *system, const PairRegion *pairs, int threads, const PairMotion *motion);

// pair_ranks.c: whether the processes that simulate the system share so many pairs, and how they do.
bool phys_ranks_should_split(const PhysSystem *system, uint64_t pairs);
void phys_pair_ranks(PhysSystem *system, const PairRegion *pairs);

#endif
