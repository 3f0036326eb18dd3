// pair_wave.c: all pairs of a pass on several threads.
//
// The pairs form a triangle or a rectangle, cut into blocks. A block may be computed when the one to its left and the
// one above it are done: then the sums of its rows and of its columns have received everything that comes before, in
// order. Threads claim rows of blocks from top to bottom and follow each other through them like the steps of a
// staircase, so the order of all sums is that of one thread.
#include "physics/pair_wave.h"
#include "physics/threads.h"

#include <sched.h>
#include <stdatomic.h>

enum {
    BLOCK_LEAST = 64, // rows of a block
    BLOCK_PART = 24,  // and so many blocks in a column, if they are not smaller than that
    BLOCKS_MOST = BLOCK_PART + 1,
    BLOCK_ALIGN = 8, // rows, a multiple of all lanes
    PATIENCE = 2000, // looks at a neighbour's progress before the processor is left to others
};

typedef struct Wave {
    PairBlocks blocks;
    atomic_size_t next;
    atomic_size_t done[BLOCKS_MOST]; // by row of blocks: the column up to which it is done
} Wave;

static void wait_for(const atomic_size_t *done, size_t column) {
    for (int looks = 0; atomic_load_explicit(done, memory_order_acquire) < column; looks++)
        if (looks >= PATIENCE)
            sched_yield();
}

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

PairBlocks phys_pair_blocks(const PairWave *pairs, size_t part, size_t smallest) {
    size_t rows = pairs->row_end - pairs->row, columns = pairs->column_end - pairs->column;
    size_t block = (rows / part + BLOCK_ALIGN - 1) / BLOCK_ALIGN * BLOCK_ALIGN;
    block = block < smallest ? smallest : block;
    return (PairBlocks){pairs, block, (rows + block - 1) / block, (columns + block - 1) / block};
}

void phys_pair_block(const PairBlocks *blocks, size_t row, size_t column) {
    const PairWave *pairs = blocks->pairs;
    size_t first = pairs->row + row * blocks->block, end = least(first + blocks->block, pairs->row_end);
    size_t other = pairs->column + column * blocks->block, other_end = least(other + blocks->block, pairs->column_end);
    if (pairs->triangle && row == column)
        pairs->kernel->triangle(pairs->pass, first, end);
    else
        pairs->kernel->tiles(pairs->pass, first, end, other, other_end);
}

static void follow(void *context, int worker, int workers) {
    Wave *wave = context;
    (void)worker;
    (void)workers;
    size_t row;
    while ((row = atomic_fetch_add(&wave->next, 1)) < wave->blocks.rows)
        for (size_t column = wave->blocks.pairs->triangle ? row : 0; column < wave->blocks.columns; column++) {
            if (row)
                wait_for(&wave->done[row - 1], column + 1);
            phys_pair_block(&wave->blocks, row, column);
            atomic_store_explicit(&wave->done[row], column + 1, memory_order_release);
        }
}

void phys_pair_wave(const PhysSystem *system, const PairWave *pairs) {
    Wave wave = {.blocks = phys_pair_blocks(pairs, BLOCK_PART, BLOCK_LEAST)};
    phys_parallel_in_order(system, (int)least((size_t)system->options.threads, wave.blocks.rows), follow, &wave);
}
