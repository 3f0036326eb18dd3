// shapes.h: closed meshes for tests of solids, and measures of solids.
#pragma once

#include "check.h"
#include "maths/maths.h"
#include "solid/topology.h"

#include <math.h>
#include <string.h>

enum { SHAPE_MAX_POINTS = 40000, SHAPE_SPHERE_ROWS = 6 };

typedef enum ShapeKind { SHAPE_BOX, SHAPE_SPHERE, SHAPE_CYLINDER, SHAPE_CONE, SHAPE_KINDS } ShapeKind;

typedef struct Shape {
    double (*points)[3];
    uint32_t *indices;
    uint32_t point_count;
    uint32_t index_count;
} Shape;

static inline void shape_add(Shape *shape, uint32_t a, uint32_t b, uint32_t c) {
    uint32_t *index = shape->indices + shape->index_count;
    index[0] = a, index[1] = b, index[2] = c;
    shape->index_count += 3;
}

// Revolves a profile of radii and heights about the z axis. The first and the last radius are 0.
static inline Shape shape_revolved(Arena *arena, const double (*profile)[2], uint32_t rows, uint32_t segments) {
    Shape shape = {.points = arena_alloc_array(arena, (size_t)rows * segments, sizeof *shape.points),
                   .indices = arena_alloc_array(arena, 6 * (size_t)rows * segments, sizeof *shape.indices)};
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t i = 0; i < segments; i++) {
            double angle = 6.283185307179586 * (i + 0.5) / segments;
            double *point = shape.points[shape.point_count++];
            point[0] = profile[row][0] * maths_cos(angle);
            point[1] = profile[row][0] * maths_sin(angle);
            point[2] = profile[row][1];
        }
    for (uint32_t row = 0; row + 1 < rows; row++)
        for (uint32_t i = 0; i < segments; i++) {
            uint32_t a = row * segments + i, b = row * segments + (i + 1) % segments;
            if (profile[row][0] > 0)
                shape_add(&shape, a, b, b + segments);
            if (profile[row + 1][0] > 0)
                shape_add(&shape, a, b + segments, a + segments);
        }
    return shape;
}

// A shape with a diameter and a height of 2 around the origin.
static inline Shape shape_new(Arena *arena, ShapeKind kind, uint32_t segments) {
    static const double box[4][2] = {{0, -1}, {1.4142135623730951, -1}, {1.4142135623730951, 1}, {0, 1}};
    static const double cylinder[4][2] = {{0, -1}, {1, -1}, {1, 1}, {0, 1}}, cone[3][2] = {{0, -1}, {1, -1}, {0, 1}};
    if (kind != SHAPE_SPHERE)
        return kind == SHAPE_BOX        ? shape_revolved(arena, box, 4, 4)
               : kind == SHAPE_CYLINDER ? shape_revolved(arena, cylinder, 4, segments)
                                        : shape_revolved(arena, cone, 3, segments);
    uint32_t rows = segments / 2 + 1;
    double(*profile)[2] = arena_alloc_array(arena, rows, sizeof *profile);
    for (uint32_t i = 0; i < rows; i++) {
        double angle = 3.141592653589793 * i / (rows - 1);
        profile[i][0] = i == 0 || i == rows - 1 ? 0 : maths_sin(angle);
        profile[i][1] = -maths_cos(angle);
    }
    return shape_revolved(arena, (const double(*)[2])profile, rows, segments);
}

// Moves the points: p -> centre + size * rotation * p. The rotation is about z by `turns`, then about x by `turns`.
static inline void shape_place(Shape *shape, const double size[3], double turns, const double centre[3]) {
    double c = maths_cos(6.283185307179586 * turns), s = maths_sin(6.283185307179586 * turns);
    for (uint32_t i = 0; i < shape->point_count; i++) {
        double *p = shape->points[i], x = p[0] * size[0], y = p[1] * size[1], z = p[2] * size[2];
        double u = c * x - s * y, v = s * x + c * y;
        p[0] = centre[0] + u;
        p[1] = centre[1] + c * v - s * z;
        p[2] = centre[2] + s * v + c * z;
    }
}

static inline const SolidGrid *shape_grid(void) {
    static SolidGrid grid;
    grid = solid_grid((double[3]){-8, -8, -8}, (double[3]){8, 8, 8});
    return &grid;
}

static inline Solid shape_solid(Arena *arena, const Shape *shape) {
    Solid solid;
    assert_true(solid_from_mesh(arena, shape_grid(), (const double(*)[3])shape->points, shape->point_count,
                                shape->indices, shape->index_count, &solid));
    return solid;
}

static inline Solid solid_placed(Arena *arena, ShapeKind kind, uint32_t segments, double size, double turns, double x,
                                 double y, double z) {
    Shape shape = shape_new(arena, kind, segments);
    shape_place(&shape, (double[3]){size, size, size}, turns, (double[3]){x, y, z});
    return shape_solid(arena, &shape);
}

static inline double solid_volume(const Solid *solid) {
    double sum = 0, p[3][3];
    for (uint32_t i = 0; i < solid->face_count; i++) {
        for (int k = 0; k < 3; k++)
            solid_coordinates(shape_grid(), solid->points[solid->faces[i][k]], p[k]);
        sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    return sum / 6;
}

static inline uint32_t set_root(uint32_t *parents, uint32_t i) {
    while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
    return i;
}

static inline uint32_t corner_at(const Solid *solid, uint32_t face, uint32_t point) {
    const uint32_t *f = solid->faces[face];
    return 3 * face + (f[0] == point ? 0 : f[1] == point ? 1 : 2);
}

// Returns the Euler characteristic: points - edges + triangles. It is 2 for each sphere, and 2 less for each handle. A
// point where two surfaces touch counts once for each surface. *parts receives the number of connected surfaces.
static inline int64_t solid_euler(Arena *arena, const Solid *solid, int64_t *parts) {
    uint32_t edge_count, corners = 3 * solid->face_count;
    const SolidEdge *edges = solid_edges(arena, solid, &edge_count);
    assert_non_null(edges);
    uint32_t *fans = arena_alloc_array(arena, corners, sizeof *fans);
    uint32_t *surfaces = arena_alloc_array(arena, corners, sizeof *surfaces);
    for (uint32_t i = 0; i < corners; i++)
        fans[i] = surfaces[i] = i;
    for (uint32_t i = 0; i < edge_count; i++) {
        const SolidEdge *edge = &edges[i];
        surfaces[set_root(surfaces, edge->left)] = set_root(surfaces, edge->right);
        for (int end = 0; end < 2; end++) {
            uint32_t point = end ? edge->b : edge->a;
            fans[set_root(fans, corner_at(solid, edge->left, point))] =
                set_root(fans, corner_at(solid, edge->right, point));
        }
    }
    int64_t points = 0;
    *parts = 0;
    for (uint32_t i = 0; i < corners; i++)
        points += fans[i] == i;
    for (uint32_t i = 0; i < solid->face_count; i++)
        *parts += surfaces[i] == i;
    return points - edge_count + solid->face_count;
}
