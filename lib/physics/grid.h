// grid.h: what sorting into cells and searching them share.
#ifndef PETRI_PHYSICS_GRID_H
#define PETRI_PHYSICS_GRID_H

#include "physics/neighbour_list.h"

enum {
    PHYS_MAX_LANES = 8,         // of any kernel
    PHYS_MAX_NEIGHBOURS = 1024, // entries of the longest list
};

typedef struct Grid {
    size_t dimensions;
    double low[PHYS_VECTOR_DIMENSIONS];
    double scale[PHYS_VECTOR_DIMENSIONS]; // cells per length
    uint32_t cells[PHYS_VECTOR_DIMENSIONS];
    uint32_t *start; // places of cell c: start[c] up to start[c + 1]
} Grid;

static inline uint32_t phys_axis_cell(const Grid *grid, size_t k, double x) {
    if (grid->cells[k] == 1)
        return 0;
    double cell = (x - grid->low[k]) * grid->scale[k], last = grid->cells[k] - 1;
    return (uint32_t)(cell > 0 ? cell < last ? cell : last : 0);
}

static inline uint32_t phys_cell_of(const Grid *grid, const double *position, size_t stride) {
    uint32_t cell = 0;
    for (size_t k = grid->dimensions; k-- > 0;)
        cell = cell * grid->cells[k] + phys_axis_cell(grid, k, position[k * stride]);
    return cell;
}

// Instead of a cell.
#define PHYS_CELL_IDLE UINT32_MAX
#define PHYS_CELL_LARGE (UINT32_MAX - 1)

// Lists of all regular places, made by kernels in parts.
typedef struct ListSearch {
    const NeighbourList *list;
    const Grid *grid;
    const bool *remote;  // by column: needs no list; NULL: none
    uint32_t own;        // places with a key below are of the pass's own group
    uint32_t dummy;      // listed by lanes that are free
    uint64_t scan_limit; // candidates of a part
} ListSearch;

typedef struct ListChunk {
    uint32_t block, block_end;
    uint64_t begin, used, end; // of its entries
    uint64_t scanned;          // candidates that it looked at
    bool crowded, full;        // ended early: too many neighbours for lists; no more room
} ListChunk;

// grid.c: only where the cells are, `most` of them, and what list->base, list->skin and the largest radius in a cell
// are. list->cell tells of each particle whether it has a cell. False if the particles do not lie in a way that a grid
// can sort.
bool phys_grid_layout(const PairPass *pass, NeighbourList *list, double max, Grid *grid, double *max_radius);

// grid_search.c: makes the lists of all regular places. Free lanes list the place `dummy`. False if they would cost
// more than they are worth, or there is no memory.
bool phys_grid_search(PhysSystem *system, const Kernels *kernels, const Grid *grid, uint32_t dummy,
                      NeighbourList *list);

#endif
