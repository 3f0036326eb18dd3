// kernel_search.c: neighbour lists from the cells of a grid, LANES candidates at a time.
#include "physics/grid.h"
#include "physics/lanes.h"

enum {
    ROWS_MOST = 9 + 1, // of cells around one, and the large particles
    WORDS = LANES < 4 ? 4 : 8,
};

typedef int32_t Words __attribute__((vector_size(4 * WORDS)));

// The candidates for the places of one cell, and those of them that are near one of these places.
typedef struct Finder {
    uint32_t cell;
    uint32_t rows;
    uint32_t candidates; // in all rows
    uint32_t first[ROWS_MOST], end[ROWS_MOST];
    uint32_t near[PHYS_MOST_NEAR + LANES];
    Words keys[PHYS_MOST_NEAR / WORDS + 1];  // where they stand in the order of the pass
    Words ranks[PHYS_MOST_NEAR / WORDS + 1]; // and among each other
} Finder;

static void add_row(Finder *finder, uint32_t first, uint32_t end) {
    finder->first[finder->rows] = first;
    finder->end[finder->rows] = end;
    finder->rows += first < end;
    finder->candidates += end - first;
}

// Neighbours are in the cells around the own one, or large.
static void look_around(const ListSearch *search, Finder *finder) {
    const Grid *grid = search->grid;
    uint32_t low[PHYS_VECTOR_DIMENSIONS], high[PHYS_VECTOR_DIMENSIONS], rest = finder->cell;
    for (size_t k = 0; k < PHYS_VECTOR_DIMENSIONS; k++) {
        uint32_t at = rest % grid->cells[k];
        rest /= grid->cells[k];
        low[k] = at ? at - 1 : 0;
        high[k] = at + 1 < grid->cells[k] ? at + 1 : at;
    }
    finder->rows = finder->candidates = 0;
    for (uint32_t z = low[2]; z <= high[2]; z++)
        for (uint32_t y = low[1]; y <= high[1]; y++) {
            size_t row = ((size_t)z * grid->cells[1] + y) * grid->cells[0];
            add_row(finder, grid->start[row + low[0]], grid->start[row + high[0] + 1]);
        }
    add_row(finder, search->list->view.regular, search->list->view.listed);
}

// Collects who is nearer to a place than max(radius + radius, bound) + skin; stops beyond PHYS_MOST_NEAR.
KERNEL size_t find_near(const ListSearch *search, Finder *finder, size_t dimensions, uint32_t place) {
    const ListView *view = &search->list->view;
    Real here[PHYS_VECTOR_DIMENSIONS], radius = real_set(view->radius[place]);
    Real bound = real_set(search->list->bound), skin = real_set(search->list->skin);
    for (size_t k = 0; k < dimensions; k++)
        here[k] = real_set(view->built[k][place]);
    size_t count = 0;
    for (uint32_t row = 0; row < finder->rows; row++)
        for (uint32_t s = finder->first[row], end = finder->end[row]; s < end && count <= PHYS_MOST_NEAR; s += LANES) {
            Real square = real_zero();
            for (size_t k = 0; k < dimensions; k++) {
                Real d = real_load(view->built[k] + s) - here[k];
                square += d * d;
            }
            Real reach = real_larger(real_load(view->radius + s) + radius, bound) + skin;
            // Both may overflow; the pair is listed then.
            count +=
                mask_numbers(real_at_most_where(mask_first(end - s), square, reach * reach), s, finder->near + count);
        }
    return count;
}

// Without the place itself, and without pairs of two particles of enclosing groups, which are none.
KERNEL size_t leave_out(const ListSearch *search, Finder *finder, uint32_t place, size_t found) {
    const uint32_t *key = search->list->key;
    uint32_t limit = key[place] < search->own ? UINT32_MAX : search->own;
    int32_t *keys = (int32_t *)finder->keys;
    size_t count = 0;
    for (size_t k = 0; k < found; k++) {
        uint32_t other = finder->near[k];
        finder->near[count] = other;
        keys[count] = (int32_t)key[other];
        count += other != place && key[other] < limit;
    }
    return count;
}

// How many keys are smaller than each: quicker than sorting for as many as there are.
KERNEL void rank_keys(Finder *finder, size_t count) {
    const int32_t *keys = (const int32_t *)finder->keys;
    for (size_t v = 0; v * WORDS < count; v++) {
        Words mine = finder->keys[v], rank = {0};
        for (size_t k = 0; k < count; k++)
            rank -= (Words)((Words){0} + keys[k] < mine);
        finder->ranks[v] = rank;
    }
}

// The lists of one block side by side; false if there is no room for them.
KERNEL bool search_block(const ListSearch *search, ListPart *part, Finder *finder, size_t dimensions, uint32_t block) {
    const ListView *view = &search->list->view;
    uint32_t first = block * LANES, most = 0, *entries = view->entries + part->used;
    for (uint32_t lane = 0; lane < LANES && first + lane < view->regular; lane++) {
        uint32_t place = first + lane;
        if (search->foreign && search->foreign[view->column[place]])
            continue;
        if (place >= search->grid->start[finder->cell + 1]) {
            do
                finder->cell++;
            while (place >= search->grid->start[finder->cell + 1]);
            look_around(search, finder);
        }
        part->scanned += finder->candidates;
        size_t count = find_near(search, finder, dimensions, place);
        if (count > PHYS_MOST_NEAR || part->scanned > search->scan_limit) {
            part->crowded = true;
            return false;
        }
        count = leave_out(search, finder, place, count);
        if (part->used + (uint64_t)(count > most ? count : most) * LANES > part->end) {
            part->full = true;
            return false;
        }
        for (; most < count; most++)
            for (uint32_t l = 0; l < LANES; l++)
                entries[most * LANES + l] = search->dummy * view->width;
        rank_keys(finder, count);
        for (size_t k = 0; k < count; k++)
            entries[(size_t)((const int32_t *)finder->ranks)[k] * LANES + lane] = finder->near[k] * view->width;
    }
    view->at[block] = part->used;
    view->most[block] = most;
    part->used += (uint64_t)most * LANES;
    return true;
}

KERNEL void search_blocks(const ListSearch *search, ListPart *part, Finder *finder, size_t dimensions) {
    for (uint32_t block = part->block; block < part->block_end; block++)
        if (!search_block(search, part, finder, dimensions, block))
            return;
}

void PER_ISA(list_search)(const ListSearch *search, ListPart *part) {
    const Grid *grid = search->grid;
    if (part->block == part->block_end)
        return;
    Finder finder = {0};
    double place[PHYS_VECTOR_DIMENSIONS] = {0};
    for (size_t k = 0; k < grid->dimensions; k++)
        place[k] = search->list->view.built[k][part->block * LANES];
    finder.cell = phys_cell_of(grid, place, 1);
    look_around(search, &finder);
    if (grid->dimensions == 1)
        search_blocks(search, part, &finder, 1);
    else if (grid->dimensions == 2)
        search_blocks(search, part, &finder, 2);
    else
        search_blocks(search, part, &finder, 3);
}
