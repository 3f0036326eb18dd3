// kernel_search.c: builds neighbour lists from the cells of a grid, LANES candidates at a time.
//
// Particles with adjacent sorted indices share most of their candidates. So the candidates of a batch of particles are
// sorted into the order of the pass only once. Each list is filled from these candidates in that order. This does
// not apply if the batch spans two rows of cells, if it has very many candidates, or if the pass has enclosing groups.
// Then the neighbours of each particle are searched separately, and its list is sorted afterwards.
#include "physics/grid.h"
#include "physics/lanes.h"

enum {
    MAX_ROWS = 9 + 1,                  // rows of adjacent cells, and one row for the large particles
    WORDS = LANES < 4 ? 4 : 2 * LANES, // number of keys in a vector
    BATCH = 8,                         // number of particles in a batch
    MAX_BATCH = 128,                   // maximum number of candidates of a batch
    SPARE = 16, // number of dummies that are copied at once to the end of every list; more are appended one by one
};

typedef int32_t Words __attribute__((vector_size(4 * WORDS)));

// The candidates of a batch in the order of the pass, padded with positions that are NaN.
typedef struct Batch {
    uint32_t end;   // first sorted index after the batch
    bool ordered;   // false: the neighbours of each particle are searched separately
    uint32_t count; // number of candidates
    double built[PHYS_VECTOR_DIMENSIONS][MAX_BATCH + LANES], radius[MAX_BATCH + LANES];
    uint32_t entry[MAX_BATCH + LANES];
} Batch;

// Working memory of a search.
typedef struct Finder {
    uint32_t cell;                                // cell of the current particle
    uint32_t low, high;                           // range of cells in one row for which `first` and `end` were found
    uint32_t rows;                                // number of elements of `first` and `end`
    uint32_t candidates;                          // number of candidates in all rows
    uint32_t first[MAX_ROWS], end[MAX_ROWS];      // by row: range of sorted indices
    uint32_t near[PHYS_MAX_NEIGHBOURS + LANES];   // sorted indices of candidates or neighbours
    Words keys[PHYS_MAX_NEIGHBOURS / WORDS + 2];  // by element of `near`: position in the order of the pass
    Words ranks[PHYS_MAX_NEIGHBOURS / WORDS + 2]; // by element of `near`: number of smaller keys
    uint32_t dummies[SPARE];
    uint32_t lists[LANES][PHYS_MAX_NEIGHBOURS + LANES + SPARE]; // lists of the current block
    Batch batch;
} Finder;

static void add_row(Finder *finder, uint32_t first, uint32_t end) {
    finder->first[finder->rows] = first;
    finder->end[finder->rows] = end;
    finder->rows += first < end;
    finder->candidates += end - first;
}

// Finds the candidates for neighbours of the particles in cells low_cell to high_cell, which are in one row of cells.
// Candidates are the particles in these cells and in adjacent cells, and the large particles.
static void find_rows(const ListSearch *search, Finder *finder, uint32_t low_cell, uint32_t high_cell) {
    const Grid *grid = search->grid;
    uint32_t low[PHYS_VECTOR_DIMENSIONS], high[PHYS_VECTOR_DIMENSIONS], rest = low_cell;
    for (size_t k = 0; k < PHYS_VECTOR_DIMENSIONS; k++) {
        uint32_t at = rest % grid->cells[k], far = k ? at : at + (high_cell - low_cell);
        rest /= grid->cells[k];
        low[k] = at ? at - 1 : 0;
        high[k] = far + 1 < grid->cells[k] ? far + 1 : far;
    }
    finder->low = low_cell;
    finder->high = high_cell;
    finder->rows = finder->candidates = 0;
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++) {
            size_t row = ((size_t)z * grid->cells[1] + y) * grid->cells[0];
            add_row(finder, grid->start[row + low[0]], grid->start[row + high[0] + 1]);
        }
    add_row(finder, search->list->view.regular, search->list->view.listed);
}

// Returns the cell of the particle with this sorted index. It must be `cell` or a later cell.
static uint32_t cell_from(const Grid *grid, uint32_t cell, uint32_t index) {
    while (index >= grid->start[cell + 1])
        cell++;
    return cell;
}

// Compile-time constants on which the search is specialised.
typedef struct Measure {
    size_t dimensions;
    bool one_size; // all particles have the same radius, and all forces need contact
} Measure;

// A particle whose neighbours are searched for, copied to all lanes.
typedef struct SearchTarget {
    Real position[PHYS_VECTOR_DIMENSIONS], radius, bound, skin;
    Real square; // with one_size: square of the distance up to which neighbours are listed
} SearchTarget;

KERNEL Real square_of_reach(const SearchTarget *target, Real radius) {
    Real reach = real_max(radius + target->radius, target->bound) + target->skin;
    return reach * reach;
}

KERNEL SearchTarget search_target_of(const ListSearch *search, Measure shape, uint32_t index) {
    const ListView *view = &search->list->view;
    SearchTarget target = {.radius = real_set(view->radius[index]),
                           .bound = real_set(search->list->bound),
                           .skin = real_set(search->list->skin)};
    for (size_t k = 0; k < shape.dimensions; k++)
        target.position[k] = real_set(view->built[k][index]);
    target.square = square_of_reach(&target, target.radius);
    return target;
}

// Tests LANES candidates, starting at index `s`. Returns those in `mask` whose distance from the target is at most
// max(sum of the radii, bound) + skin.
KERNEL Mask is_near(const SearchTarget *target, Measure shape, const double *const *built, const double *radius,
                    size_t s, Mask mask) {
    Real square = real_zero();
    for (size_t k = 0; k < shape.dimensions; k++) {
        Real d = real_load(built[k] + s) - target->position[k];
        square += d * d;
    }
    // If both sides overflow, the pair is listed.
    return real_at_most_where(mask, square,
                              shape.one_size ? target->square : square_of_reach(target, real_load(radius + s)));
}

// Collects the particles near `index` in finder->near and returns their number. Stops if there are more than
// PHYS_MAX_NEIGHBOURS.
KERNEL size_t find_near(const ListSearch *search, Finder *finder, Measure shape, uint32_t index) {
    const ListView *view = &search->list->view;
    const double *built[] = {view->built[0], view->built[1], view->built[2]};
    SearchTarget target = search_target_of(search, shape, index);
    size_t count = 0;
    for (uint32_t row = 0; row < finder->rows; row++)
        for (uint32_t s = finder->first[row], end = finder->end[row]; s < end && count <= PHYS_MAX_NEIGHBOURS;
             s += LANES)
            count += mask_indices(is_near(&target, shape, built, view->radius, s, mask_first(end - s)), s,
                                  finder->near + count);
    return count;
}

// Removes particle `index` itself from finder->near. If it belongs to an enclosing group, also removes other particles
// of enclosing groups, because pairs of two such particles belong to other passes. Sets finder->keys. Returns the
// number of particles left.
KERNEL size_t exclude_self(const ListSearch *search, Finder *finder, uint32_t index, size_t found) {
    const uint32_t *key = search->list->key;
    uint32_t limit = key[index] < search->own ? UINT32_MAX : search->own;
    int32_t *keys = (int32_t *)finder->keys;
    size_t count = 0;
    for (size_t k = 0; k < found; k++) {
        uint32_t other = finder->near[k];
        finder->near[count] = other;
        keys[count] = (int32_t)key[other];
        count += other != index && key[other] < limit;
    }
    return count;
}

// Adds 1 to the elements of `rank` for which `key` is less than the element of `mine`.
KERNEL Words count_less(Words rank, int32_t key, Words mine) {
#if LANES == 8
    __m512i others = _mm512_set1_epi32(key), is = (__m512i)mine;
    return (Words)_mm512_mask_add_epi32((__m512i)rank, _mm512_cmplt_epi32_mask(others, is), (__m512i)rank,
                                        _mm512_set1_epi32(1));
#else
    return rank - (Words)((Words){0} + key < mine);
#endif
}

// Sets finder->ranks: for each of `count` keys, the number of smaller keys, which is its index in sorted order. This is
// faster than a sort, because there are few keys.
KERNEL void rank_keys(Finder *finder, size_t count) {
    const int32_t *keys = (const int32_t *)finder->keys;
    for (size_t v = 0; v * WORDS < count; v += 2) {
        Words first = {0}, second = {0};
        for (size_t k = 0; k < count; k++) {
            first = count_less(first, keys[k], finder->keys[v]);
            second = count_less(second, keys[k], finder->keys[v + 1]);
        }
        finder->ranks[v] = first;
        finder->ranks[v + 1] = second;
    }
}

// Collects the sorted indices of all candidates in finder->near, and their keys in finder->keys. Returns the number of
// candidates.
KERNEL uint32_t collect_candidates(const ListSearch *search, Finder *finder) {
    uint32_t count = 0;
    for (uint32_t row = 0; row < finder->rows; row++) {
        uint32_t *near = finder->near + count, first = finder->first[row], length = finder->end[row] - first;
        int32_t *keys = (int32_t *)finder->keys + count;
        const uint32_t *key = search->list->key + first;
        for (uint32_t c = 0; c < length; c += BATCH) // elements written beyond `length` are overwritten or ignored
            for (uint32_t m = c; m < c + BATCH; m++) {
                near[m] = first + m;
                keys[m] = (int32_t)key[m];
            }
        count += length;
    }
    return count;
}

// Fills finder->batch with the candidates, in the order of the pass.
KERNEL void order_batch(const ListSearch *search, Finder *finder, Measure shape) {
    const ListView *view = &search->list->view;
    Batch *batch = &finder->batch;
    uint32_t count = batch->count = collect_candidates(search, finder);
    rank_keys(finder, count);
    const uint32_t *ranks = (const uint32_t *)finder->ranks;
    for (uint32_t c = 0; c < count; c++) {
        uint32_t rank = ranks[c], index = finder->near[c];
        batch->entry[rank] = index * (uint32_t)view->width;
        for (size_t k = 0; k < shape.dimensions; k++)
            batch->built[k][rank] = view->built[k][index];
        if (!shape.one_size)
            batch->radius[rank] = view->radius[index];
    }
    for (uint32_t c = count; c < count + LANES; c++) {
        batch->entry[c] = 0;
        batch->radius[c] = 0;
        for (size_t k = 0; k < shape.dimensions; k++)
            batch->built[k][c] = NAN;
    }
}

// Prepares the batch that starts at sorted index `first`.
KERNEL void next_batch(const ListSearch *search, Finder *finder, Measure shape, uint32_t first) {
    const Grid *grid = search->grid;
    Batch *batch = &finder->batch;
    batch->end = (first / BATCH + 1) * BATCH;
    uint32_t last = batch->end < search->list->view.regular ? batch->end - 1 : search->list->view.regular - 1;
    finder->cell = cell_from(grid, finder->cell, first);
    uint32_t high = cell_from(grid, finder->cell, last);
    batch->ordered = search->own == UINT32_MAX && finder->cell / grid->cells[0] == high / grid->cells[0];
    if (!batch->ordered)
        return;
    find_rows(search, finder, finder->cell, high);
    batch->ordered = finder->candidates <= MAX_BATCH;
    if (batch->ordered)
        order_batch(search, finder, shape);
}

// Fills the neighbour list of particle `index` from its batch, which must be ordered. Returns the length of the list.
KERNEL size_t list_from_batch(const ListSearch *search, const Batch *batch, Measure shape, uint32_t index,
                              uint32_t *list) {
    const double *built[] = {batch->built[0], batch->built[1], batch->built[2]};
    SearchTarget target = search_target_of(search, shape, index);
    uint32_t self = index * (uint32_t)search->list->view.width;
    size_t count = 0;
    for (uint32_t s = 0; s < batch->count; s += LANES)
        count += mask_compress(is_near(&target, shape, built, batch->radius, s, mask_first(LANES)), batch->entry + s,
                               self, list + count);
    return count;
}

// Fills the neighbour list of particle `index` by a separate search. Returns the length of the list. If the length
// would exceed PHYS_MAX_NEIGHBOURS, the list is not filled.
KERNEL size_t list_single(const ListSearch *search, Finder *finder, Measure shape, uint32_t index, uint32_t *list) {
    finder->cell = cell_from(search->grid, finder->cell, index);
    if (finder->low != finder->cell || finder->high != finder->cell)
        find_rows(search, finder, finder->cell, finder->cell);
    size_t count = find_near(search, finder, shape, index);
    if (count > PHYS_MAX_NEIGHBOURS)
        return count;
    count = exclude_self(search, finder, index, count);
    rank_keys(finder, count);
    for (size_t k = 0; k < count; k++)
        list[((const int32_t *)finder->ranks)[k]] = finder->near[k] * search->list->view.width;
    return count;
}

// Builds the interleaved lists of one block. If that fails, returns false and sets chunk->crowded or chunk->full.
KERNEL bool search_block(const ListSearch *search, ListChunk *chunk, Finder *finder, Measure shape, uint32_t block) {
    const ListView *view = &search->list->view;
    uint32_t first = block * LANES, dummy = search->dummy * view->width;
    size_t counts[LANES] = {0}, max_length = 0;
    if (first >= finder->batch.end)
        next_batch(search, finder, shape, first);
    for (uint32_t lane = 0; lane < LANES; lane++) {
        uint32_t index = first + lane, *list = finder->lists[lane];
        size_t count = 0;
        if (index < view->regular && !(search->remote && search->remote[view->column[index]])) {
            if (finder->batch.ordered)
                count = list_from_batch(search, &finder->batch, shape, index, list);
            else
                count = list_single(search, finder, shape, index, list);
            chunk->scanned += finder->batch.ordered ? finder->candidates / 2 : finder->candidates;
            if (count > PHYS_MAX_NEIGHBOURS || chunk->scanned > search->scan_limit) {
                chunk->crowded = true;
                return false;
            }
        }
        memcpy(list + count, finder->dummies, sizeof finder->dummies);
        counts[lane] = count;
        max_length = count > max_length ? count : max_length;
    }
    if (chunk->used + (uint64_t)max_length * LANES > chunk->end) {
        chunk->full = true;
        return false;
    }
    for (uint32_t lane = 0; lane < LANES; lane++)
        for (size_t k = counts[lane] + SPARE; k < max_length; k++)
            finder->lists[lane][k] = dummy;
    uint32_t *entries = view->entries + chunk->used;
    for (size_t k = 0; k < max_length; k++)
        for (uint32_t lane = 0; lane < LANES; lane++)
            entries[k * LANES + lane] = finder->lists[lane][k];
    view->at[block] = chunk->used;
    view->max_length[block] = (uint32_t)max_length;
    chunk->used += (uint64_t)max_length * LANES;
    return true;
}

KERNEL void search_blocks(const ListSearch *search, ListChunk *chunk, Finder *finder, Measure shape) {
    for (uint32_t block = chunk->block; block < chunk->block_end; block++)
        if (!search_block(search, chunk, finder, shape, block))
            return;
}

#define SEARCH(n)                                                                                                      \
    static void search_##n(const ListSearch *search, ListChunk *part, Finder *finder) {                                \
        if (search->list->view.one_radius > 0)                                                                         \
            search_blocks(search, part, finder, (Measure){n, true});                                                   \
        else                                                                                                           \
            search_blocks(search, part, finder, (Measure){n, false});                                                  \
    }
SEARCH(1)
SEARCH(2)
SEARCH(3)

void PER_ISA(list_search)(const ListSearch *search, ListChunk *chunk) {
    const Grid *grid = search->grid;
    if (chunk->block == chunk->block_end)
        return;
    Finder finder;
    double position[PHYS_VECTOR_DIMENSIONS] = {0};
    for (size_t k = 0; k < grid->dimensions; k++)
        position[k] = search->list->view.built[k][chunk->block * LANES];
    finder.cell = phys_cell_of(grid, position, 1);
    finder.low = UINT32_MAX;
    finder.batch.end = 0;
    for (size_t k = 0; k < SPARE; k++)
        finder.dummies[k] = search->dummy * (uint32_t)search->list->view.width;
#define SEARCH_BLOCKS(n) search_##n(search, chunk, &finder)
    FOR_DIMENSIONS(grid->dimensions, SEARCH_BLOCKS);
}
