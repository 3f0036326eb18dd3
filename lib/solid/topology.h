// topology.h: edges of solids, and clean-up of meshes.
#pragma once

#include "solid/entries.h"
#include "solid/solid.h"

// An edge from point a to point b, where a < b. It runs along `left` from a to b, and along `right` from b to a.
typedef struct SolidEdge {
    uint32_t a;
    uint32_t b;
    uint32_t left;
    uint32_t right;
} SolidEdge;

// Pairs the sides of triangles to edges. Returns NULL if the mesh is not closed.
SolidEdge *solid_edges(Arena *arena, const Solid *solid, uint32_t *count);
// Joins points with the same coordinates. Omits triangles without an edge, pairs of opposite triangles, and points that
// no triangle uses.
Solid solid_weld(Arena *arena, const Solid *solid);
// Returns the sides of all triangles, sorted by their ends. The bucket is the lower point. The key has the higher point
// and, in the last bit, the direction: 0 from the lower to the higher point. The value is the triangle.
Entry *sorted_sides(Arena *arena, const Solid *solid);
// Like sorted_sides, for triangles: sorted by their corners. The bucket is the lowest point, and the key has the
// others. The value is twice the triangle, plus 1 if the corners are in descending order.
Entry *sorted_faces(Arena *arena, const Solid *solid);
