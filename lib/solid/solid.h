// solid.h: solids bounded by triangles, with integer coordinates, and boolean operations on them.
//
// A solid is a closed mesh: at each edge, as many triangles run along it in one direction as in the other. Corners are
// counter-clockwise seen from outside. The operations follow Smith, "Towards topologically robust boolean operations":
// each decision is a comparison of exact integers, and all parts of the result are derived from the same decisions. So
// the result is closed whatever the input is, even if solids overlap themselves. It has the same bits everywhere.
//
// Coplanar faces, touching corners and other special positions cannot occur, because the first operand is enlarged (for
// a union) or shrunk by SOLID_SHIFT units before the decisions are made. So solids that touch are united, and a cut
// that is flush with a face leaves no skin. The coordinates of the result are those of the unchanged operands.
#pragma once

#include "base/arena.h"

// Coordinates of a solid are at most SOLID_MAX. Those of a mesh that is read by a grid are at most SOLID_MAX / 4, which
// leaves room for the half spaces of solid_trim.
enum { SOLID_MAX = 1 << 23, SOLID_SHIFT = 4, SOLID_MAX_FACES = 1 << 22 };

typedef struct Solid {
    int32_t (*points)[3];
    uint32_t (*faces)[3]; // indices of points
    uint32_t point_count;
    uint32_t face_count;
} Solid;

// The integer coordinates: x is the integer (x - middle) / step, rounded.
typedef struct SolidGrid {
    double middle[3];
    double step;
} SolidGrid;

// Returns a grid for meshes between two corners. Its step is a power of 2. The corners must be finite.
SolidGrid solid_grid(const double low[3], const double high[3]);

// Creates a solid from the triangles of a mesh. Corners at the same grid point are joined, and triangles without an
// edge are omitted. Returns false if the mesh is not closed; *solid is then valid, but must not be an operand. Points
// must lie between the corners of the grid.
bool solid_from_mesh(Arena *arena, const SolidGrid *grid, const double (*points)[3], uint32_t point_count,
                     const uint32_t *indices, uint32_t index_count, Solid *solid);
// Turns the triangles of a mesh the same way round, outwards where they enclose a volume. Removes duplicate triangles,
// and closes each hole whose edges form a loop with a fan of triangles. Returns whether the mesh is then closed.
bool solid_repair(Arena *arena, Solid *solid);
// Turns a solid that is inside out, so that its volume is positive.
void solid_turn_outwards(Solid *solid);
bool solid_is_closed(Arena *arena, const Solid *solid);
// Computes the coordinates of a point in the mesh.
void solid_coordinates(const SolidGrid *grid, const int32_t point[3], double out[3]);

typedef enum SolidOperation { SOLID_UNION, SOLID_INTERSECTION, SOLID_DIFFERENCE } SolidOperation;

// Returns the result of an operation on two closed solids. It may share arrays with them. Charges the work to the
// arena's budget.
Solid solid_combine(Arena *arena, SolidOperation operation, const Solid *a, const Solid *b);
// Returns the union or intersection of all solids, or the difference of the first and all others.
Solid solid_combine_all(Arena *arena, SolidOperation operation, const Solid *solids, uint32_t count);
// Removes the part of a solid on the side of a plane to which `normal` points.
Solid solid_trim(Arena *arena, const SolidGrid *grid, const Solid *solid, const double origin[3],
                 const double normal[3]);
