// grid.h: the grid into whose cells particles are sorted when neighbour lists are built.
#pragma once

#include "physics/neighbour_list.h"

enum {
    PHYS_MAX_NEIGHBOURS = 1024, // maximum length of a list
};

typedef struct Grid {
    size_t dimensions;
    double low[PHYS_VECTOR_DIMENSIONS];     // lower bound of the first cell along each axis
    double scale[PHYS_VECTOR_DIMENSIONS];   // cells per unit of length
    uint32_t cells[PHYS_VECTOR_DIMENSIONS]; // number of cells along each axis
    uint32_t *start;                        // particles of cell c: sorted indices start[c] to start[c + 1] - 1
} Grid;

// Returns the cell of coordinate x along axis k. Coordinates outside the grid belong to the first or last cell.
static inline uint32_t phys_axis_cell(const Grid *grid, size_t k, double x) {
    if (grid->cells[k] == 1)
        return 0;
    double cell = (x - grid->low[k]) * grid->scale[k], last = grid->cells[k] - 1;
    return (uint32_t)(cell > 0 ? cell < last ? cell : last : 0);
}

// Returns the cell of a position whose components are `stride` doubles apart.
static inline uint32_t phys_cell_of(const Grid *grid, const double *position, size_t stride) {
    uint32_t cell = 0;
    for (size_t k = grid->dimensions; k-- > 0;)
        cell = cell * grid->cells[k] + phys_axis_cell(grid, k, position[k * stride]);
    return cell;
}

// Special values of NeighbourList.cell. An idle particle gets no list, because its position is not finite, or because
// its radius is 0 and all forces need contact. A large particle is much larger than the others.
#define PHYS_CELL_IDLE UINT32_MAX
#define PHYS_CELL_LARGE (UINT32_MAX - 1)

// A search for the lists of all regular particles. Kernels perform it chunk by chunk.
typedef struct ListSearch {
    const NeighbourList *list;
    const Grid *grid;
    const bool *remote;  // by column: true for particles that need no list; NULL: all particles need one
    uint32_t own;        // particles whose NeighbourList.key is below this belong to the pass's own group
    uint32_t dummy;      // sorted index of the dummy particle that pads lists
    uint64_t scan_limit; // maximum number of candidates (particles tested as neighbours) per chunk
} ListSearch;

typedef struct ListChunk {
    uint32_t block, block_end; // range of blocks; a block is LANES consecutive sorted indices
    uint64_t begin, used, end; // range in ListView.entries; `used` is its first unused entry
    uint64_t scanned;          // number of candidates tested
    bool crowded, full; // reasons why the search stopped early: too many neighbours or candidates (`crowded`), or
                        // no entries left (`full`)
} ListChunk;

// grid.c: chooses a grid of at most `max` cells. Sets list->contact_distance, list->skin and *max_radius, the largest
// radius of a regular particle. Sets list->cell to PHYS_CELL_IDLE, PHYS_CELL_LARGE or, for regular particles, another
// value. Returns false if contact_distance is too small or too large.
bool phys_grid_layout(const PairPass *pass, NeighbourList *list, double max, Grid *grid, double *max_radius);

// grid.c: extends *low and *high to cover `count` numbers. Returns false if one of them is not finite.
bool phys_find_extremes(const double *numbers, size_t count, double *low, double *high);

// grid_search.c: builds the lists of all regular particles, padded with the sorted index `dummy`. Returns false if out
// of memory, or if the lists would have more than `max_entries` entries or a particle too many neighbours.
bool phys_grid_search(PhysSystem *system, const Grid *grid, uint32_t dummy, NeighbourList *list, uint64_t max_entries);
