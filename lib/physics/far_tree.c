// far_tree.c: builds the trees of a forest (far_field.h): cube, keys, sorted members and cells.
#include "physics/far_field.h"
#include "physics/threads.h"

#include <assert.h>
#include <string.h>

enum { HALF_LEVELS = FAR_LEVELS / 2, MIN_EXPONENT = -400, MIN_TREE_FOR_THREADS = 20000 };

// --- members

static const double *source_column(const PhysSystem *system, const FarForest *forest) {
    return forest->charges ? system->columns.charge : system->columns.mass;
}

static bool is_member(const PhysSystem *system, const FarForest *forest, size_t column) {
    const Columns *columns = &system->columns;
    bool member = source_column(system, forest)[column] != 0;
    for (size_t k = 0; k < forest->dimensions; k++)
        member &= (bool)isfinite(columns->position[k * columns->stride + column]);
    return member;
}

static bool reserve_members(PhysSystem *system, FarForest *forest) {
    enum { NUMBERS = 2 }; // source and radius
    uint64_t count = system->columns.count, n = forest->dimensions;
    uint64_t bytes = (2 * n + NUMBERS) * sizeof(double) + sizeof(uint32_t);
    if (!phys_buffer_reserve(system, &forest->members, 0, count, bytes) ||
        !phys_buffer_reserve(system, &forest->keys, 0, 2 * count, sizeof(FarKey)) ||
        !phys_buffer_reserve(system, &forest->trees, 0, system->group_count, sizeof(FarTree)))
        return false;
    double *next = forest->members.bytes;
    for (size_t k = 0; k < n; k++, next += 2 * count) {
        forest->position[k] = next;
        forest->scaled[k] = next + count;
    }
    forest->source = next;
    forest->radius = next + count;
    forest->column = (uint32_t *)(next + 2 * count);
    return true;
}

// Sets the column of each member of a group in the order of the script. Returns the number of members.
static uint32_t collect_members(const PhysSystem *system, const FarForest *forest, const Group *group) {
    FarKey *keys = (FarKey *)forest->keys.bytes + group->first;
    uint32_t count = 0;
    if (system->column_order == ORDER_BY_CELL) { // all particles are in this group
        for (uint32_t handle = 0; handle < system->handle_count; handle++) {
            uint32_t column = system->column_of[handle];
            if (column != NO_COLUMN && is_member(system, forest, column))
                keys[count++].column = column;
        }
        return count;
    }
    for (uint32_t column = group->first; column < group->first + group->count; column++)
        if (is_member(system, forest, column))
            keys[count++].column = column;
    return count;
}

// --- cube and keys

static void extend_cube(const PhysSystem *system, const FarForest *forest, const FarTree *tree, double *low,
                        double *high) {
    const Columns *columns = &system->columns;
    const FarKey *keys = (const FarKey *)forest->keys.bytes + tree->first;
    for (size_t k = 0; k < forest->dimensions; k++) {
        const double *position = columns->position + k * columns->stride;
        for (uint32_t i = 0; i < tree->count; i++) {
            double x = position[keys[i].column];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    }
}

// Sets the cube that contains the members of all groups.
static void set_cube(const PhysSystem *system, FarForest *forest) {
    double low[FAR_DIMENSIONS], high[FAR_DIMENSIONS], half = 0;
    for (size_t k = 0; k < FAR_DIMENSIONS; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    bool any = false;
    for (uint32_t g = 0; g < system->group_count; g++) {
        extend_cube(system, forest, phys_far_tree(forest, g), low, high);
        any |= phys_far_tree(forest, g)->count > 0;
    }
    for (size_t k = 0; k < forest->dimensions; k++) {
        forest->low[k] = any ? low[k] : 0;
        double extent = any ? high[k] * 0.5 - low[k] * 0.5 : 0;
        half = extent > half ? extent : half;
    }
    int exponent = MIN_EXPONENT - 1;
    if (half > 0)
        frexp(half, &exponent);
    exponent = exponent + 1 < MIN_EXPONENT ? MIN_EXPONENT : exponent + 1;
    forest->half_scale = ldexp(1, 1 - exponent);
    forest->scale = ldexp(1, -exponent);
}

static double scale_position(const FarForest *forest, size_t k, double x) {
    return (x * 0.5 - forest->low[k] * 0.5) * forest->half_scale;
}

// Spreads the low 21 bits of `bits` so that consecutive bits are `n` apart, where n is 2 or 3.
static uint64_t spread_bits(uint64_t bits, size_t n) {
    if (n == 2) {
        bits = (bits | bits << 16) & 0x0000ffff0000ffff;
        bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
        bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
        bits = (bits | bits << 2) & 0x3333333333333333;
        return (bits | bits << 1) & 0x5555555555555555;
    }
    bits = (bits | bits << 32) & 0x001f00000000ffff;
    bits = (bits | bits << 16) & 0x001f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    return (bits | bits << 2) & 0x1249249249249249;
}

// Context of the tasks that process a range of members.
typedef struct MemberTask {
    const PhysSystem *system;
    FarForest *forest;
    const FarTree *tree;
} MemberTask;

static void key_chunk(void *context, int chunk, int chunks) {
    const MemberTask *task = context;
    const Columns *columns = &task->system->columns;
    FarForest *forest = task->forest;
    FarKey *keys = (FarKey *)forest->keys.bytes + task->tree->first;
    size_t n = forest->dimensions, end = phys_chunk_begin(task->tree->count, chunk + 1, chunks);
    const uint64_t mask = (UINT64_C(1) << HALF_LEVELS) - 1;
    for (size_t i = phys_chunk_begin(task->tree->count, chunk, chunks); i < end; i++) {
        keys[i].high = keys[i].low = 0;
        for (size_t k = 0; k < n; k++) {
            double scaled = scale_position(forest, k, columns->position[k * columns->stride + keys[i].column]);
            uint64_t place = (uint64_t)(scaled * 0x1p42);
            keys[i].high |= spread_bits(place >> HALF_LEVELS, n) << k;
            keys[i].low |= spread_bits(place & mask, n) << k;
        }
    }
}

static void fill_chunk(void *context, int chunk, int chunks) {
    const MemberTask *task = context;
    const Columns *columns = &task->system->columns;
    FarForest *forest = task->forest;
    size_t first = task->tree->first + phys_chunk_begin(task->tree->count, chunk, chunks);
    size_t end = task->tree->first + phys_chunk_begin(task->tree->count, chunk + 1, chunks);
    const FarKey *keys = forest->keys.bytes;
    const double *sources = source_column(task->system, forest);
    for (size_t i = first; i < end; i++) {
        size_t column = keys[i].column;
        for (size_t k = 0; k < forest->dimensions; k++) {
            double x = columns->position[k * columns->stride + column];
            forest->position[k][i] = x;
            forest->scaled[k][i] = scale_position(forest, k, x);
        }
        forest->source[i] = sources[column];
        forest->radius[i] = columns->radius[column];
        forest->column[i] = (uint32_t)column;
    }
}

static void sort_members(const PhysSystem *system, FarForest *forest, const FarTree *tree) {
    MemberTask task = {system, forest, tree};
    FarKey *keys = (FarKey *)forest->keys.bytes + tree->first;
    int chunks = phys_chunk_count(system, tree->count, MIN_TREE_FOR_THREADS);
    phys_parallel(system, chunks, key_chunk, &task);
    phys_far_sort(keys, (FarKey *)forest->keys.bytes + system->columns.count, tree->count);
    phys_parallel(system, chunks, fill_chunk, &task);
}

// --- cells

static unsigned digit_at(const FarForest *forest, size_t member, int level) {
    const FarKey *key = (const FarKey *)forest->keys.bytes + member;
    size_t n = forest->dimensions;
    uint64_t part = level < HALF_LEVELS ? key->high : key->low;
    int below = HALF_LEVELS - 1 - level % HALF_LEVELS;
    return (unsigned)(part >> (size_t)below * n) & ((1u << n) - 1);
}

// Returns the first level at which the keys of two members differ, or FAR_LEVELS.
static int first_difference(const FarForest *forest, size_t a, size_t b, int level) {
    while (level < FAR_LEVELS && digit_at(forest, a, level) == digit_at(forest, b, level))
        level++;
    return level;
}

// Returns the first member from `first` on whose digit at `level` differs from that of `first`.
static uint32_t digit_end(const FarForest *forest, uint32_t first, uint32_t end, int level) {
    unsigned digit = digit_at(forest, first, level);
    uint32_t same = first, other = end;
    while (same + 1 < other) {
        uint32_t middle = same + (other - same) / 2;
        if (digit_at(forest, middle, level) == digit)
            same = middle;
        else
            other = middle;
    }
    return other;
}

static FarCell *cell_at(const FarForest *forest, uint32_t cell) {
    return (FarCell *)forest->cells.bytes + cell;
}

// Adds the cell of members first to end - 1 and its descendants. Their keys are equal before `level`. The recursion is
// at most FAR_LEVELS deep. Returns false if out of memory.
static bool add_cells(PhysSystem *system, FarForest *forest, uint32_t first, uint32_t end, int level) {
    uint32_t cell = forest->cell_count;
    if (!phys_buffer_grow(system, &forest->cells, cell, sizeof(FarCell)))
        return false;
    forest->cell_count++;
    *cell_at(forest, cell) = (FarCell){.first = first, .end = end};
    if (end - first > FAR_LEAF)
        level = first_difference(forest, first, end - 1, level);
    if (end - first > FAR_LEAF && level < FAR_LEVELS)
        for (uint32_t child = first; child < end;) {
            uint32_t next = digit_end(forest, child, end, level);
            if (!add_cells(system, forest, child, next, level + 1))
                return false;
            child = next;
        }
    cell_at(forest, cell)->skip = forest->cell_count;
    return true;
}

static bool add_tree(PhysSystem *system, FarForest *forest, FarTree *tree) {
    tree->root = forest->cell_count;
    if (tree->count) {
        sort_members(system, forest, tree);
        if (!add_cells(system, forest, tree->first, tree->first + tree->count, 0))
            return false;
    }
    tree->end = forest->cell_count;
    return true;
}

bool phys_far_build(PhysSystem *system, FarForest *forest) {
    const Group *groups = system->groups.bytes;
    assert(system->dimensions <= FAR_DIMENSIONS); // phys_is_far
    forest->dimensions = system->dimensions;
    forest->cell_count = 0;
    if (!reserve_members(system, forest))
        return false;
    FarTree *trees = forest->trees.bytes;
    for (uint32_t g = 0; g < system->group_count; g++)
        trees[g] = (FarTree){.first = groups[g].first, .count = collect_members(system, forest, &groups[g])};
    set_cube(system, forest);
    for (uint32_t g = 0; g < system->group_count; g++)
        if (!add_tree(system, forest, &trees[g]))
            return false;
    if (!phys_buffer_reserve(system, &forest->moments, 0, forest->cell_count, sizeof(FarMoments)))
        return false;
    phys_far_moments(forest);
    forest->built = true;
    return true;
}
