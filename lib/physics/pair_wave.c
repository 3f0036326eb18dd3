// pair_wave.c: all pairs of a pass on several threads.
//
// The pairs form a triangle or a rectangle, cut into blocks. A block may be computed when the one to its left and the
// one above it are done: then the sums of its rows and of its columns have received everything that comes before, in
// order. Threads take rows of blocks in turns and follow each other through them like the steps of a staircase, so the
// order of all sums is that of one thread. When a row of a triangle is done, nobody asks any more where its particles
// are: they may be moved, which is what threads do that have to wait.
//
// A thread hears of another's work after some 300 nanoseconds, in which it would do six tiles of pairs: so blocks are
// small, and what two threads write to lies in different lines of the cache.
#include "physics/pair_wave.h"
#include "physics/threads.h"

#include <stdatomic.h>

enum {
    PAIRS_FOR_THREADS = 60000, // fewer are done before another thread is awake
    PAIRS_FOR_AWAKE = 10000,   // which helps with fewer if it is
    BLOCK_LEAST = 24,          // rows of a block
    BLOCK_PART = 24,           // and so many blocks in a column, if they are not smaller than that
    BLOCKS_MOST = BLOCK_PART + 1,
    BLOCK_ALIGN = 8, // rows, a multiple of all lanes
    LINE_BYTES = 64, // of the cache
};

// A row of blocks.
typedef struct Row {
    _Alignas(LINE_BYTES) atomic_bool claimed;
    atomic_size_t done; // the column up to which it is
} Row;

typedef struct Wave {
    // what a thread must fetch before it can begin, side by side
    _Alignas(LINE_BYTES) PairBlocks blocks;
    PairWave pairs;
    PairPass pass;
    PhysThreads *threads;
    const PairMotion *motion;                 // or NULL
    _Alignas(LINE_BYTES) atomic_size_t moved; // rows whose particles are, or somebody is about to
    Row rows[BLOCKS_MOST];
} Wave;

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

static bool claim(Row *row) {
    return !atomic_load_explicit(&row->claimed, memory_order_relaxed) &&
           !atomic_exchange_explicit(&row->claimed, true, memory_order_relaxed);
}

static bool done_to(const Row *row, size_t column) {
    return atomic_load_explicit(&row->done, memory_order_acquire) >= column;
}

// Moves the particles of the next row that is done; false if there is none.
static bool move_some(Wave *wave) {
    size_t row = atomic_load_explicit(&wave->moved, memory_order_relaxed);
    if (!wave->motion || row >= wave->blocks.rows || !done_to(&wave->rows[row], wave->blocks.columns) ||
        !atomic_compare_exchange_strong_explicit(&wave->moved, &row, row + 1, memory_order_relaxed,
                                                 memory_order_relaxed))
        return false;
    const PairWave *pairs = wave->blocks.pairs;
    size_t first = pairs->row + row * wave->blocks.block;
    wave->motion->move(wave->motion->context, first, least(first + wave->blocks.block, pairs->row_end));
    return true;
}

static void wait_for(Wave *wave, const Row *row, size_t column, bool caller) {
    PhysWait wait = {0};
    while (!done_to(row, column))
        if (!move_some(wave))
            phys_wait(&wait);
    if (caller)
        phys_wait_end(wave->threads, &wait);
}

static void compute_row(Wave *wave, size_t row, bool caller) {
    for (size_t column = wave->blocks.pairs->triangle ? row : 0; column < wave->blocks.columns; column++) {
        if (row)
            wait_for(wave, &wave->rows[row - 1], column + 1, caller);
        phys_pair_block(&wave->blocks, row, column);
        atomic_store_explicit(&wave->rows[row].done, column + 1, memory_order_release);
    }
}

// Every thread has rows of its own, and takes those before them that nobody has begun.
static void follow(void *context, int share, int shares) {
    Wave *wave = context;
    for (size_t byte = 0; byte < offsetof(Wave, moved); byte += LINE_BYTES)
        __builtin_prefetch((const char *)wave + byte);
    size_t rows = wave->blocks.rows;
    for (size_t row = (size_t)share; row < rows + (size_t)shares; row += (size_t)shares) {
        size_t end = least(row + 1, rows), first = end;
        while (first > 0 && claim(&wave->rows[first - 1]))
            first--;
        for (; first < end; first++)
            compute_row(wave, first, share == 0);
    }
    if (!wave->motion)
        return;
    wait_for(wave, &wave->rows[rows - 1], wave->blocks.columns, share == 0);
    while (move_some(wave))
        continue;
}

int phys_wave_threads(const PhysSystem *system, uint64_t pairs) {
    if (system->options.threads < 2 || pairs < PAIRS_FOR_AWAKE)
        return 0;
    return pairs >= PAIRS_FOR_THREADS ? system->options.threads : phys_brief_threads(system, pairs);
}

void phys_pair_wave(const PhysSystem *system, const PairWave *pairs, int threads, const PairMotion *motion) {
    Wave wave;
    wave.pass = *pairs->pass;
    wave.pairs = *pairs;
    wave.pairs.pass = &wave.pass;
    wave.blocks = phys_pair_blocks(&wave.pairs, BLOCK_PART, BLOCK_LEAST);
    wave.threads = system->threads;
    wave.motion = motion;
    atomic_init(&wave.moved, 0);
    for (size_t row = 0; row < wave.blocks.rows; row++) {
        atomic_init(&wave.rows[row].claimed, false);
        atomic_init(&wave.rows[row].done, 0);
    }
    int shares = (int)least((size_t)threads, wave.blocks.rows);
    uint64_t count = (pairs->row_end - pairs->row) * (pairs->column_end - pairs->column) / (pairs->triangle ? 2 : 1);
    if (count < PAIRS_FOR_THREADS)
        phys_parallel_brief(system, shares, count, follow, &wave);
    else
        phys_parallel(system, shares, follow, &wave);
}
