// pair_ranks.c: all pairs of a pass on several processes, each pair once.
//
// The blocks are those of pair_wave.c. A row of blocks is a process's own, the next row the next one's; what the
// columns of a block have received so far goes from row to row, so that all sums are made in the order of one process.
// A message is a block's columns. In the end each process gives to all what is whole at its place, and moves all
// particles itself.
#include "physics/pair_wave.h"

enum {
    WORTH_PAIRS = 200000,
    BLOCK_PART = 32, // blocks in a column
    BLOCK_LEAST = 64,
    BLOCK_TESTED = 8, // smaller ones, for systems that are shared only to be tested
};

bool phys_ranks_share(const PhysSystem *system, uint64_t pairs) {
    const PhysRanks *ranks = &system->options.ranks;
    return ranks->count > 1 && pairs >= (ranks->least ? ranks->least : WORTH_PAIRS);
}

typedef struct Shared {
    PhysTraffic *traffic;
    const PhysRanks *ranks;
    PairBlocks blocks;
} Shared;

static int owner(const Shared *shared, size_t row) {
    return (int)(row % (size_t)shared->ranks->count);
}

// The columns of a block, as they stand.
static double *sums(const Shared *shared, size_t first, size_t end, size_t number, size_t *length) {
    size_t begin = first + number * shared->blocks.block, rest = end - begin;
    *length = shared->blocks.block < rest ? shared->blocks.block : rest;
    return shared->blocks.pairs->pass->force + begin;
}

static void compute_row(const Shared *shared, size_t row) {
    const PhysRanks *ranks = shared->ranks;
    const PairWave *pairs = shared->blocks.pairs;
    const PairPass *pass = pairs->pass;
    for (size_t column = pairs->triangle ? row : 0; column < shared->blocks.columns; column++) {
        size_t length;
        double *numbers = sums(shared, pairs->column, pairs->column_end, column, &length);
        if (row > 0)
            ranks->receive(ranks->host, owner(shared, row - 1), numbers, pass->dimensions, length, pass->stride);
        phys_pair_block(&shared->blocks, row, column);
        // On the diagonal the columns are the rows, which are whole at the end of the row.
        if (row + 1 == shared->blocks.rows || (pairs->triangle && row == column))
            continue;
        ranks->send(ranks->host, owner(shared, row + 1), numbers, pass->dimensions, length, pass->stride);
        shared->traffic->step_messages++;
        shared->traffic->step_bytes += length * pass->dimensions * sizeof *numbers;
    }
}

static void spread_range(const Shared *shared, int from, double *numbers, size_t length) {
    const PhysRanks *ranks = shared->ranks;
    const PairPass *pass = shared->blocks.pairs->pass;
    ranks->spread(ranks->host, from, numbers, pass->dimensions, length, pass->stride);
    shared->traffic->step_messages += ranks->rank == from;
    shared->traffic->step_bytes += ranks->rank == from ? length * pass->dimensions * sizeof *numbers : 0;
}

// Rows of blocks are whole where they were computed, the columns of a rectangle where the last row was.
static void spread(const Shared *shared) {
    const PairWave *pairs = shared->blocks.pairs;
    for (size_t row = 0; row < shared->blocks.rows; row++) {
        size_t length;
        double *numbers = sums(shared, pairs->row, pairs->row_end, row, &length);
        spread_range(shared, owner(shared, row), numbers, length);
    }
    if (!pairs->triangle)
        spread_range(shared, owner(shared, shared->blocks.rows - 1), pairs->pass->force + pairs->column,
                     pairs->column_end - pairs->column);
}

void phys_pair_ranks(PhysSystem *system, const PairWave *pairs) {
    const PhysRanks *ranks = &system->options.ranks;
    Shared shared = {&system->traffic, ranks,
                     phys_pair_blocks(pairs, BLOCK_PART, ranks->least ? BLOCK_TESTED : BLOCK_LEAST)};
    for (size_t row = (size_t)ranks->rank; row < shared.blocks.rows; row += (size_t)ranks->count)
        compute_row(&shared, row);
    spread(&shared);
    system->traffic.sharing = PHYS_BY_PAIRS;
}
