// predicates.h: exact comparisons of the positions of points, edges and triangles.
//
// Differences of coordinates are less than 2^30, so 64 bits suffice for areas and 128 bits for volumes.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef int32_t Position[3];

__extension__ typedef __int128 SolidWide;

// Returns twice the signed area of a triangle in the plane of two axes.
static inline int64_t area_of(const int32_t *a, const int32_t *b, const int32_t *c, int x, int y) {
    return (int64_t)(b[x] - a[x]) * (c[y] - a[y]) - (int64_t)(b[y] - a[y]) * (c[x] - a[x]);
}

// Returns six times the signed volume of a tetrahedron. It is positive if d is on the side of the triangle a, b, c from
// which its corners are counter-clockwise.
static inline SolidWide volume_of(const int32_t *a, const int32_t *b, const int32_t *c, const int32_t *d) {
    int64_t e[3] = {d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    return (SolidWide)area_of(a, b, c, 1, 2) * e[0] + (SolidWide)area_of(a, b, c, 2, 0) * e[1] +
           (SolidWide)area_of(a, b, c, 0, 1) * e[2];
}

// Computes in how far a point p of the first operand is below (in y) an edge of the second one: 0 if it is not, else
// the sign of the edge's direction along x.
static inline int below_edge(const Position p, const Position a, const Position b) {
    int along = (p[0] < b[0]) - (p[0] < a[0]);
    if (along == 0)
        return 0;
    int64_t area = area_of(a, b, p, 0, 1); // positive: p is to the left of the edge
    return (along > 0 ? area < 0 : area > 0) ? along : 0;
}

// Computes in how far an edge of the first operand is below a point q of the second one.
static inline int edge_below(const Position a, const Position b, const Position q) {
    int along = (b[0] < q[0]) - (a[0] < q[0]);
    if (along == 0)
        return 0;
    int64_t area = area_of(a, b, q, 0, 1);
    return (along < 0 ? area > 0 : area < 0) ? along : 0;
}
