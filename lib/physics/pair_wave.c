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
    BLOCK_ALIGN = 8,
    PATIENCE = 2000, // looks at a neighbour's progress before the processor is left to others
};

typedef struct Wave {
    const PairWave *pairs;
    size_t block;
    size_t rows;    // blocks in a column
    size_t columns; // blocks in a row
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

static void compute_block(const Wave *wave, size_t row, size_t column) {
    const PairWave *pairs = wave->pairs;
    size_t first = pairs->row + row * wave->block, end = least(first + wave->block, pairs->row_end);
    size_t other = pairs->column + column * wave->block, other_end = least(other + wave->block, pairs->column_end);
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
    while ((row = atomic_fetch_add(&wave->next, 1)) < wave->rows)
        for (size_t column = wave->pairs->triangle ? row : 0; column < wave->columns; column++) {
            if (row)
                wait_for(&wave->done[row - 1], column + 1);
            compute_block(wave, row, column);
            atomic_store_explicit(&wave->done[row], column + 1, memory_order_release);
        }
}

void phys_pair_wave(const PhysSystem *system, const PairWave *pairs) {
    Wave wave = {.pairs = pairs};
    size_t rows = pairs->row_end - pairs->row, columns = pairs->column_end - pairs->column;
    wave.block = (rows / BLOCK_PART + BLOCK_ALIGN - 1) / BLOCK_ALIGN * BLOCK_ALIGN;
    wave.block = wave.block < BLOCK_LEAST ? BLOCK_LEAST : wave.block;
    wave.rows = (rows + wave.block - 1) / wave.block;
    wave.columns = (columns + wave.block - 1) / wave.block;
    phys_parallel_in_order(system, (int)least((size_t)system->options.threads, wave.rows), follow, &wave);
}
