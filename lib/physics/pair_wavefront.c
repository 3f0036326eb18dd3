// pair_wavefront.c: computes all pairs of a pass on several threads.
//
// The pairs form a triangle or a rectangle, which is divided into blocks. A block can be computed when the blocks to
// its left and above it are done. Only then have the sums of its rows and columns received all earlier terms in order.
// Threads claim rows of blocks in turn and follow each other through them, so all sums have the order of a single
// thread. When a row of a triangle is done, the positions of its particles are no longer needed. Waiting threads then
// move them.
//
// It takes about 300 ns until a thread sees the result of another thread. In this time it could compute six tiles of
// pairs. So blocks are small, and different threads write to different cache lines.
#include "physics/pair_wavefront.h"

#include "physics/threads.h"

#include <stdatomic.h>

enum {
    PAIRS_FOR_THREADS = 60000, // pairs in the smallest job for which sleeping threads are woken
    PAIRS_FOR_AWAKE = 10000,   // pairs in the smallest job for threads that are awake
    MIN_BLOCK = 24,            // minimum number of rows in a block
    BLOCKS_PER_COLUMN = 24,    // number of blocks in a column, unless limited by MIN_BLOCK
    MAX_BLOCKS = BLOCKS_PER_COLUMN + 1,
    BLOCK_ALIGN = 8, // the number of rows in a block is a multiple of this, which is a multiple of every LANES
    WAVEFRONT_LINE_BYTES = 64, // size of a cache line
};

// The state of a row of blocks.
typedef struct WavefrontRow {
    _Alignas(WAVEFRONT_LINE_BYTES) atomic_bool claimed; // some thread computes the row or has computed it
    atomic_size_t done;                                 // blocks 0 to done - 1 of the row are done
} WavefrontRow;

typedef struct Wavefront {
    // contiguous, because every thread reads these fields first
    _Alignas(WAVEFRONT_LINE_BYTES) PairBlocks blocks;
    PairRegion pairs;
    PairPass pass;
    PhysThreads *threads;
    const PairMotion *motion; // NULL: none
    _Alignas(WAVEFRONT_LINE_BYTES)
        atomic_size_t moved; // the particles of rows 0 to moved - 1 have moved or are being moved
    WavefrontRow rows[MAX_BLOCKS];
} Wavefront;

static size_t min_size(size_t a, size_t b) {
    return a < b ? a : b;
}

PairBlocks phys_pair_blocks(const PairRegion *pairs, size_t blocks_per_column, size_t min_rows) {
    size_t rows = pairs->row_end - pairs->row, columns = pairs->column_end - pairs->column;
    size_t block = (rows / blocks_per_column + BLOCK_ALIGN - 1) / BLOCK_ALIGN * BLOCK_ALIGN;
    block = block < min_rows ? min_rows : block;
    return (PairBlocks){pairs, block, (rows + block - 1) / block, (columns + block - 1) / block};
}

void phys_pair_block(const PairBlocks *blocks, size_t row, size_t column) {
    const PairRegion *pairs = blocks->pairs;
    size_t first = pairs->row + row * blocks->block, end = min_size(first + blocks->block, pairs->row_end);
    size_t other = pairs->column + column * blocks->block,
           other_end = min_size(other + blocks->block, pairs->column_end);
    pairs->kernel(pairs->pass, pairs->triangle && row == column, first, end, other, other_end);
}

static bool claim_row(WavefrontRow *row) {
    return !atomic_load_explicit(&row->claimed, memory_order_relaxed) &&
           !atomic_exchange_explicit(&row->claimed, true, memory_order_relaxed);
}

static bool is_done_to(const WavefrontRow *row, size_t column) {
    return atomic_load_explicit(&row->done, memory_order_acquire) >= column;
}

// Moves the particles of the next row that has not been moved. Returns false if there is no such row, or if its forces
// are not complete yet.
static bool move_next_row(Wavefront *wavefront) {
    size_t row = atomic_load_explicit(&wavefront->moved, memory_order_relaxed);
    if (!wavefront->motion || row >= wavefront->blocks.rows ||
        !is_done_to(&wavefront->rows[row], wavefront->blocks.columns) ||
        !atomic_compare_exchange_strong_explicit(&wavefront->moved, &row, row + 1, memory_order_relaxed,
                                                 memory_order_relaxed))
        return false;
    const PairRegion *pairs = wavefront->blocks.pairs;
    size_t first = pairs->row + row * wavefront->blocks.block;
    wavefront->motion->move(wavefront->motion->context, first,
                            min_size(first + wavefront->blocks.block, pairs->row_end));
    return true;
}

// Waits until blocks 0 to column - 1 of a row are done. During the wait, moves particles of complete rows.
static void wait_for_row(Wavefront *wavefront, const WavefrontRow *row, size_t column, bool caller) {
    PhysSpinWait wait = {0};
    while (!is_done_to(row, column))
        if (!move_next_row(wavefront))
            phys_spin_wait(&wait);
    if (caller)
        phys_spin_wait_end(wavefront->threads, &wait);
}

static void compute_row(Wavefront *wavefront, size_t row, bool caller) {
    for (size_t column = wavefront->blocks.pairs->triangle ? row : 0; column < wavefront->blocks.columns; column++) {
        if (row)
            wait_for_row(wavefront, &wavefront->rows[row - 1], column + 1, caller);
        phys_pair_block(&wavefront->blocks, row, column);
        atomic_store_explicit(&wavefront->rows[row].done, column + 1, memory_order_release);
    }
}

// Computes every `chunks`-th row of blocks, starting at `chunk`, and earlier rows that no thread has claimed.
static void run_rows(void *context, int chunk, int chunks) {
    Wavefront *wavefront = context;
    for (size_t byte = 0; byte < offsetof(Wavefront, moved); byte += WAVEFRONT_LINE_BYTES)
        __builtin_prefetch((const char *)wavefront + byte);
    size_t rows = wavefront->blocks.rows;
    for (size_t row = (size_t)chunk; row < rows + (size_t)chunks; row += (size_t)chunks) {
        size_t end = min_size(row + 1, rows), first = end;
        while (first > 0 && claim_row(&wavefront->rows[first - 1]))
            first--;
        for (; first < end; first++)
            compute_row(wavefront, first, chunk == 0);
    }
    if (!wavefront->motion)
        return;
    wait_for_row(wavefront, &wavefront->rows[rows - 1], wavefront->blocks.columns, chunk == 0);
    while (move_next_row(wavefront))
        continue;
}

int phys_wavefront_threads(const PhysSystem *system, uint64_t pairs) {
    if (system->options.threads < 2 || pairs < PAIRS_FOR_AWAKE)
        return 0;
    return pairs >= PAIRS_FOR_THREADS ? system->options.threads : phys_short_job_threads(system, pairs);
}

void phys_pair_wavefront(const PhysSystem *system, const PairRegion *pairs, int threads, const PairMotion *motion) {
    Wavefront wavefront;
    wavefront.pass = *pairs->pass;
    wavefront.pairs = *pairs;
    wavefront.pairs.pass = &wavefront.pass;
    wavefront.blocks = phys_pair_blocks(&wavefront.pairs, BLOCKS_PER_COLUMN, MIN_BLOCK);
    wavefront.threads = system->threads;
    wavefront.motion = motion;
    atomic_init(&wavefront.moved, 0);
    for (size_t row = 0; row < wavefront.blocks.rows; row++) {
        atomic_init(&wavefront.rows[row].claimed, false);
        atomic_init(&wavefront.rows[row].done, 0);
    }
    int chunks = (int)min_size((size_t)threads, wavefront.blocks.rows);
    uint64_t count = phys_region_pairs(pairs);
    if (count < PAIRS_FOR_THREADS)
        phys_parallel_short(system, chunks, count, run_rows, &wavefront);
    else
        phys_parallel(system, chunks, run_rows, &wavefront);
}
