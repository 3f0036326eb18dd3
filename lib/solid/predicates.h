// predicates.h: exact comparisons of the positions of points, edges and triangles.
//
// Differences of coordinates are less than 1.001 * 2^30, so 64 bits suffice for areas. Volumes need more; they do
// without integers of 128 bits, which compilers for 32 bits lack.
#pragma once

#include <stdbool.h>
#include <stdint.h>

typedef int32_t Position[3];

// An exact volume: high * 2^31 + low, with low < 2^31.
typedef struct Volume {
    int64_t high;
    uint32_t low;
} Volume;

// Returns twice the signed area of a triangle in the plane of two axes.
static inline int64_t area_of(const int32_t *a, const int32_t *b, const int32_t *c, int x, int y) {
    return (int64_t)(b[x] - a[x]) * (c[y] - a[y]) - (int64_t)(b[y] - a[y]) * (c[x] - a[x]);
}

// Returns six times the signed volume of a tetrahedron. It is positive if d is on the side of the triangle a, b, c from
// which its corners are counter-clockwise.
static inline Volume volume_of(const int32_t *a, const int32_t *b, const int32_t *c, const int32_t *d) {
    int64_t areas[3] = {area_of(a, b, c, 1, 2), area_of(a, b, c, 2, 0), area_of(a, b, c, 0, 1)};
    int64_t high = 0, low = 0; // less than 2^62 and 2^63
    for (int k = 0; k < 3; k++) {
        int64_t edge = d[k] - a[k];
        high += (areas[k] >> 31) * edge;
        low += (areas[k] & INT32_MAX) * edge;
    }
    return (Volume){high + (low >> 31), low & INT32_MAX};
}

// Returns -1, 0 or 1.
static inline int volume_sign(Volume volume) {
    return volume.high < 0 ? -1 : volume.high > 0 || volume.low > 0;
}

// Returns the nearest double, of two nearest ones the even one.
static inline double volume_to_double(Volume volume) {
    bool negative = volume.high < 0;
    uint64_t low = negative ? (UINT64_C(1) << 31) - volume.low : volume.low; // 2^31 if volume.low is 0
    uint64_t high = (uint64_t)(negative ? -1 - volume.high : volume.high) + (low >> 31);
    low &= INT32_MAX;
    // The top 63 bits. Their last is also set if a bit below them is, so that only one conversion rounds.
    int shift = high >> 32 ? __builtin_clzll(high) - 1 : 31;
    int64_t top = (int64_t)(high << shift | low >> (31 - shift) | ((low << shift & INT32_MAX) > 0));
    double magnitude = (double)top * (double)(UINT32_C(1) << (31 - shift));
    return negative ? -magnitude : magnitude;
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
