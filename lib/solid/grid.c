// grid.c: conversion between meshes and solids; see solid.h.
//
// The step is a power of two, and the middle is a multiple of it. So all coordinates of the grid are exact as doubles.
#include "solid/topology.h"

#include <math.h>
#include <string.h>

SolidGrid solid_grid(const double low[3], const double high[3]) {
    SolidGrid grid = {.step = 1};
    double size = 0;
    for (int k = 0; k < 3; k++)
        size = fmax(size, (high[k] - low[k]) / 2);
    // The corners are at most one step farther from the rounded middle than from the exact one.
    double wanted = fmin(fmax(size, 1e-290), 1e290) / (SOLID_MAX / 4 - 2);
    while (grid.step < wanted)
        grid.step *= 2;
    while (grid.step / 2 >= wanted)
        grid.step /= 2;
    for (int k = 0; k < 3; k++)
        grid.middle[k] = floor((low[k] / 2 + high[k] / 2) / grid.step) * grid.step;
    return grid;
}

static int32_t grid_coordinate(const SolidGrid *grid, double x, int axis) {
    const double max = SOLID_MAX / 4;
    double units = floor((x - grid->middle[axis]) / grid->step + 0.5);
    return (int32_t)(units > -max ? units < max ? units : max : -max);
}

void solid_coordinates(const SolidGrid *grid, const int32_t point[3], double out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = grid->middle[k] + grid->step * point[k];
}

bool solid_from_mesh(Arena *arena, const SolidGrid *grid, const double (*points)[3], uint32_t point_count,
                     const uint32_t *indices, uint32_t index_count, Solid *solid) {
    Solid mesh = {.points = arena_alloc_array(arena, point_count, sizeof *mesh.points),
                  .faces = arena_alloc_array(arena, index_count / 3, sizeof *mesh.faces),
                  .point_count = point_count,
                  .face_count = index_count / 3};
    arena_charge(arena, (uint64_t)index_count * 10);
    for (uint32_t i = 0; i < point_count; i++)
        for (int k = 0; k < 3; k++)
            mesh.points[i][k] = grid_coordinate(grid, points[i][k], k);
    if (index_count >= 3)
        memcpy(mesh.faces, indices, mesh.face_count * sizeof *mesh.faces);
    *solid = solid_weld(arena, &mesh);
    return solid_is_closed(arena, solid);
}
