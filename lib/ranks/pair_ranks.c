// pair_ranks.c: force decomposition: computes all pairs of a pass on several ranks, each pair once.
//
// The pairs are divided into blocks as in pair_wavefront.c. Rows of blocks are assigned to ranks in turn. The partial
// sums of a block's columns are sent to the rank of the next row, one message per block. So all sums have the order of
// a single process. At the end every rank broadcasts the complete sums of its rows, so all ranks can move all
// particles.
#include "ranks/domain.h"

enum {
    MIN_PAIRS = 200000, // default of PetriRanks.min_pairs
    BLOCKS_PER_COLUMN = 32,
    MIN_BLOCK = 64, // minimum number of rows in a block
    TEST_BLOCK = 8, // used instead of MIN_BLOCK if PetriRanks.min_pairs is not 0, as in tests
};

typedef struct Shared {
    PetriRankStats *stats;
    const PetriRanks *ranks;
    PairBlocks blocks;
} Shared;

static int row_owner(const Shared *shared, size_t row) {
    return (int)(row % (size_t)shared->ranks->rank_count);
}

// Returns the force sums of the particles of block `number` in the range from `first` to `end` - 1. Sets *length to the
// number of particles.
static double *block_sums(const Shared *shared, size_t first, size_t end, size_t number, size_t *length) {
    size_t begin = first + number * shared->blocks.block, rest = end - begin;
    *length = shared->blocks.block < rest ? shared->blocks.block : rest;
    return shared->blocks.pairs->pass->force + begin;
}

static void compute_row(const Shared *shared, size_t row) {
    const PetriRanks *ranks = shared->ranks;
    const PairRegion *pairs = shared->blocks.pairs;
    const PairPass *pass = pairs->pass;
    for (size_t column = pairs->triangle ? row : 0; column < shared->blocks.columns; column++) {
        size_t length;
        double *numbers = block_sums(shared, pairs->column, pairs->column_end, column, &length);
        if (row > 0)
            ranks->receive(ranks->user_data, row_owner(shared, row - 1), numbers, pass->dimensions, length,
                           pass->stride);
        phys_pair_block(&shared->blocks, row, column);
        // In a block on the diagonal, the columns are the rows. Their sums are complete at the end of the row, so they
        // are not sent.
        if (row + 1 == shared->blocks.rows || (pairs->triangle && row == column))
            continue;
        ranks->send(ranks->user_data, row_owner(shared, row + 1), numbers, pass->dimensions, length, pass->stride);
        shared->stats->step_messages++;
        shared->stats->step_bytes += length * pass->dimensions * sizeof *numbers;
    }
}

static void broadcast_range(const Shared *shared, int from, double *numbers, size_t length) {
    const PetriRanks *ranks = shared->ranks;
    const PairPass *pass = shared->blocks.pairs->pass;
    ranks->broadcast(ranks->user_data, from, numbers, pass->dimensions, length, pass->stride);
    shared->stats->step_messages += ranks->rank == from;
    shared->stats->step_bytes += ranks->rank == from ? length * pass->dimensions * sizeof *numbers : 0;
}

// Broadcasts each sum from the rank on which it is complete. For the particles of a row of blocks, this is the rank
// that computed the row. For the columns of a rectangle, it is the rank that computed the last row.
static void broadcast_sums(const Shared *shared) {
    const PairRegion *pairs = shared->blocks.pairs;
    for (size_t row = 0; row < shared->blocks.rows; row++) {
        size_t length;
        double *numbers = block_sums(shared, pairs->row, pairs->row_end, row, &length);
        broadcast_range(shared, row_owner(shared, row), numbers, length);
    }
    if (!pairs->triangle)
        broadcast_range(shared, row_owner(shared, shared->blocks.rows - 1), pairs->pass->force + pairs->column,
                        pairs->column_end - pairs->column);
}

bool ranks_compute_pairs(PhysSystem *system, const PairRegion *region) {
    const PetriRanks *ranks = ranks_of(system);
    if (phys_region_pairs(region) < (ranks->min_pairs ? ranks->min_pairs : MIN_PAIRS))
        return false;
    PetriRankStats *stats = &((Domain *)system->division.bytes)->stats;
    Shared shared = {stats, ranks,
                     phys_pair_blocks(region, BLOCKS_PER_COLUMN, ranks->min_pairs ? TEST_BLOCK : MIN_BLOCK)};
    for (size_t row = (size_t)ranks->rank; row < shared.blocks.rows; row += (size_t)ranks->rank_count)
        compute_row(&shared, row);
    broadcast_sums(&shared);
    stats->decomposition = PETRI_FORCE_DECOMPOSED;
    return true;
}

PhysProcesses ranks_processes(const PhysSystem *system) {
    return (PhysProcesses){ranks_of(system)->rank, ranks_of(system)->rank_count};
}

void ranks_gather(PhysSystem *system, double *numbers, const size_t *starts) {
    const PetriRanks *ranks = ranks_of(system);
    PetriRankStats *stats = &((Domain *)system->division.bytes)->stats;
    ranks->allgatherv(ranks->user_data, numbers, starts);
    stats->step_messages++;
    stats->step_bytes += (starts[ranks->rank + 1] - starts[ranks->rank]) * sizeof *numbers;
    stats->decomposition = PETRI_FORCE_DECOMPOSED;
}
