// grid.h: what sorting into cells and searching them share.
#ifndef PETRI_PHYSICS_GRID_H
#define PETRI_PHYSICS_GRID_H

#include "physics/neighbours.h"

enum { PHYS_MOST_LANES = 8 }; // of any kernel

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

// grid_search.c: makes the lists of all regular places. Free lanes list the place `dummy`. False if they would cost
// more than they are worth, or there is no memory.
bool phys_grid_search(PhysSystem *system, const Kernels *kernels, const Grid *grid, uint32_t dummy, Neighbours *list);

#endif
