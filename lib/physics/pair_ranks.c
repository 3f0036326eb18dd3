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
    BLOCK_ALIGN = 8,
    BLOCK_LEAST = 64,
};

bool phys_ranks_share(const PhysSystem *system, uint64_t pairs) {
    const PhysRanks *ranks = &system->options.ranks;
    return ranks->count > 1 && pairs >= (ranks->least ? ranks->least : WORTH_PAIRS);
}

typedef struct Shared {
    const PhysRanks *ranks;
    const PairWave *pairs;
    size_t block;
    size_t rows;    // blocks in a column
    size_t columns; // blocks in a row
} Shared;

static size_t least(size_t a, size_t b) {
    return a < b ? a : b;
}

static int owner(const Shared *shared, size_t row) {
    return (int)(row % (size_t)shared->ranks->count);
}

// The columns of a block, as they stand.
static double *sums(const Shared *shared, size_t first, size_t end, size_t number, size_t *length) {
    size_t begin = first + number * shared->block;
    *length = least(shared->block, end - begin);
    return shared->pairs->pass->force + begin;
}

static void compute_block(const Shared *shared, size_t row, size_t column) {
    const PairWave *pairs = shared->pairs;
    size_t first = pairs->row + row * shared->block, end = least(first + shared->block, pairs->row_end);
    size_t other = pairs->column + column * shared->block, other_end = least(other + shared->block, pairs->column_end);
    if (pairs->triangle && row == column)
        pairs->kernel->triangle(pairs->pass, first, end);
    else
        pairs->kernel->tiles(pairs->pass, first, end, other, other_end);
}

static void compute_row(const Shared *shared, size_t row) {
    const PhysRanks *ranks = shared->ranks;
    const PairPass *pass = shared->pairs->pass;
    for (size_t column = shared->pairs->triangle ? row : 0; column < shared->columns; column++) {
        size_t length;
        double *numbers = sums(shared, shared->pairs->column, shared->pairs->column_end, column, &length);
        if (row > 0)
            ranks->receive(ranks->host, owner(shared, row - 1), numbers, pass->dimensions, length, pass->stride);
        compute_block(shared, row, column);
        // On the diagonal the columns are the rows, which are whole at the end of the row.
        if (row + 1 < shared->rows && !(shared->pairs->triangle && row == column))
            ranks->send(ranks->host, owner(shared, row + 1), numbers, pass->dimensions, length, pass->stride);
    }
}

// Rows of blocks are whole where they were computed, the columns of a rectangle where the last row was.
static void spread(const Shared *shared) {
    const PhysRanks *ranks = shared->ranks;
    const PairPass *pass = shared->pairs->pass;
    for (size_t row = 0; row < shared->rows; row++) {
        size_t length;
        double *numbers = sums(shared, shared->pairs->row, shared->pairs->row_end, row, &length);
        ranks->spread(ranks->host, owner(shared, row), numbers, pass->dimensions, length, pass->stride);
    }
    if (!shared->pairs->triangle)
        ranks->spread(ranks->host, owner(shared, shared->rows - 1), pass->force + shared->pairs->column,
                      pass->dimensions, shared->pairs->column_end - shared->pairs->column, pass->stride);
}

void phys_pair_ranks(const PhysSystem *system, const PairWave *pairs) {
    Shared shared = {.ranks = &system->options.ranks, .pairs = pairs};
    size_t rows = pairs->row_end - pairs->row, columns = pairs->column_end - pairs->column;
    size_t smallest = shared.ranks->least ? BLOCK_ALIGN : BLOCK_LEAST;
    shared.block = (rows / BLOCK_PART + BLOCK_ALIGN - 1) / BLOCK_ALIGN * BLOCK_ALIGN;
    shared.block = shared.block < smallest ? smallest : shared.block;
    shared.rows = (rows + shared.block - 1) / shared.block;
    shared.columns = (columns + shared.block - 1) / shared.block;
    for (size_t row = (size_t)shared.ranks->rank; row < shared.rows; row += (size_t)shared.ranks->count)
        compute_row(&shared, row);
    spread(&shared);
}
