// domain_balance.c: divides space into patches and assigns them to ranks along a Hilbert curve.
#include "ranks/domain.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

// There are many patches for each rank, because smaller patches leave fewer particles to be tested one by one.
enum { PATCHES_PER_RANK = 8192 };

static uint32_t rotate_right(uint32_t word, uint32_t by, uint32_t bits) {
    by %= bits;
    return (word >> by | word << (bits - by)) & ((1u << bits) - 1);
}

static uint32_t gray_encode(uint32_t word) {
    return word ^ word >> 1;
}

static uint32_t gray_decode(uint32_t word) {
    return word ^ word >> 1 ^ word >> 2; // valid for at most three bits
}

static uint32_t trailing_ones(uint32_t word) {
    return (uint32_t)__builtin_ctz(~word);
}

// At each level, the curve enters a cube at `corner` and leaves it along `axis`. It visits the parts of the cube in the
// order of a Gray code. The code is reflected according to the corner and rotated according to the axis.
uint64_t domain_hilbert_index(const uint32_t *cell, uint32_t n, uint32_t levels) {
    uint64_t index = 0;
    uint32_t corner = 0, axis = 0;
    for (uint32_t level = levels; level-- > 0;) {
        uint32_t bits = 0;
        for (uint32_t k = 0; k < n; k++)
            bits |= (cell[k] >> level & 1) << k;
        uint32_t number = gray_decode(rotate_right(bits ^ corner, axis + 1, n));
        uint32_t entry = number ? gray_encode((number - 1) & ~1u) : 0;
        uint32_t turn = !number ? 0 : trailing_ones(number % 2 ? number : number - 1);
        corner ^= rotate_right(entry, n - (axis + 1) % n, n);
        axis = (axis + turn % n + 1) % n;
        index = index << n | number;
    }
    return index;
}

typedef struct Patch {
    uint64_t hilbert_index;
    uint32_t cell;
    double load; // total cost of the particles in the patch
} Patch;

static int compare_patches(const void *left, const void *right) {
    const Patch *a = left, *b = right;
    return (a->hilbert_index > b->hilbert_index) - (a->hilbert_index < b->hilbert_index);
}

static void index_patches(const Grid *grid, Patch *patches, uint32_t count) {
    uint32_t max = 1, levels = 0;
    for (size_t k = 0; k < grid->dimensions; k++)
        max = grid->cells[k] > max ? grid->cells[k] : max;
    while (UINT64_C(1) << levels < max)
        levels++;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t cell[PHYS_VECTOR_DIMENSIONS] = {0}, rest = i;
        for (size_t k = 0; k < grid->dimensions; k++, rest /= grid->cells[k - 1])
            cell[k] = rest % grid->cells[k];
        patches[i] = (Patch){domain_hilbert_index(cell, (uint32_t)grid->dimensions, levels), i, 0};
    }
}

// Assigns contiguous ranges of patches with nearly equal loads to the ranks.
static void assign_patches(Patch *patches, uint32_t count, uint32_t ranks, uint32_t *owners) {
    double total = 0, so_far = 0;
    for (uint32_t i = 0; i < count; i++)
        total += patches[i].load;
    for (uint32_t i = 0; i < count; i++) {
        double middle = so_far + patches[i].load / 2;
        double rank = total > 0 ? floor(middle / total * ranks) : 0;
        owners[patches[i].cell] = rank < ranks ? (uint32_t)rank : ranks - 1;
        so_far += patches[i].load;
    }
}

// Sets prices[r] to the measured cost per particle on rank r, or to 1 if no cost has been measured on any rank.
static void price_particles(const PhysSystem *system, const Domain *domain, double *prices) {
    const uint32_t *counts = domain->counts.bytes;
    const double *rank_seconds = domain->rank_seconds.bytes;
    uint32_t ranks = ranks_count(system);
    double highest = 0;
    for (uint32_t r = 0; r < ranks; r++) {
        prices[r] = domain->steps && counts[r] && rank_seconds[r] > 0 ? rank_seconds[r] / counts[r] : 0;
        highest = prices[r] > highest ? prices[r] : highest;
    }
    for (uint32_t r = 0; r < ranks; r++) // a rank without particles has no measured cost and gets the highest one
        prices[r] = prices[r] > 0 ? prices[r] : highest > 0 ? highest : 1;
}

// Rounds the number of patches along each axis down to a power of two. Then the two halves of the curve meet at a
// straight boundary.
static void round_patches(Grid *grid) {
    for (size_t k = 0; k < grid->dimensions; k++) {
        uint32_t cells = 1;
        while (2 * cells <= grid->cells[k])
            cells *= 2;
        grid->scale[k] = cells > 1 ? grid->scale[k] * cells / grid->cells[k] : 0;
        grid->cells[k] = cells;
    }
}

static bool layout_patches(PhysSystem *system, Domain *domain) {
    NeighbourList *survey = &domain->survey;
    PairPass pass = phys_columns_pass(&system->columns);
    survey->ranges = (PassRanges){.count = 1, .at = {{0, system->particle_count}}};
    survey->total = system->particle_count;
    survey->bound = domain->reach.bound;
    if (!phys_buffer_reserve(system, &survey->cells, 0, system->particle_count, sizeof(uint32_t)))
        return false;
    survey->cell = survey->cells.bytes;
    domain->patches = (Grid){.dimensions = system->dimensions, .cells = {1, 1, 1}};
    double max = (double)PATCHES_PER_RANK * ranks_count(system);
    if (!phys_grid_layout(&pass, survey, max, &domain->patches, &domain->max_radius))
        return false;
    round_patches(&domain->patches);
    domain->large_count = 0;
    for (uint32_t i = 0; i < system->particle_count; i++)
        if (survey->cell[i] == PHYS_CELL_LARGE) {
            assert(domain->large_count < PHYS_MAX_LARGE);
            domain->large[domain->large_count++] = i;
        }
    return true;
}

// Sets the owners of all particles, and lists the boundary particles of this rank.
static bool assign_owners(PhysSystem *system, Domain *domain) {
    const uint32_t *at = domain->survey.cell, *patch_owners = domain->patch_owners.bytes,
                   *interior = domain->interior.bytes;
    uint32_t *owners = domain_owners(domain), *counts = domain->counts.bytes;
    memset(counts, 0, ranks_count(system) * sizeof *counts);
    domain->boundary.count = domain->arrivals.count = 0;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        owners[i] = patch_owners[at[i]];
        counts[owners[i]]++;
        if (owners[i] == ranks_self(system) && !interior[at[i]] && !domain_list_column(system, &domain->boundary, i))
            return false;
    }
    return true;
}

bool domain_balance(PhysSystem *system, Domain *domain) {
    const Columns *columns = &system->columns;
    uint32_t count = system->particle_count, ranks = ranks_count(system);
    if (!layout_patches(system, domain))
        return false;
    uint32_t cells = domain->patches.cells[0] * domain->patches.cells[1] * domain->patches.cells[2],
             *at = domain->survey.cell;
    if (!phys_buffer_reserve(system, &domain->message, 0, cells * sizeof(Patch) + ranks * sizeof(double), 1) ||
        !phys_buffer_reserve(system, &domain->patch_owners, 0, cells, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->owners, domain->steps ? count * sizeof(uint32_t) : 0, count,
                             sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->counts, 0, ranks, sizeof(uint32_t)) ||
        !phys_buffer_reserve(system, &domain->rank_seconds, 0, ranks, sizeof(double)))
        return false;
    Patch *patches = domain->message.bytes;
    double *prices = (double *)(patches + cells);
    price_particles(system, domain, prices);
    index_patches(&domain->patches, patches, cells);
    for (uint32_t i = 0; i < count; i++) {
        at[i] = phys_cell_of(&domain->patches, columns->position + i, columns->stride);
        patches[at[i]].load += prices[domain->steps ? domain_owners(domain)[i] : 0];
    }
    qsort(patches, cells, sizeof *patches, compare_patches);
    assign_patches(patches, cells, ranks, domain->patch_owners.bytes);
    memset(domain->rank_seconds.bytes, 0, ranks * sizeof(double));
    domain->steps = 0;
    domain->seconds = 0;
    return domain_find_interior(system, domain) && assign_owners(system, domain);
}
