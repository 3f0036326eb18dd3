// field.h: distance fields, which are negative inside a body, and their surfaces.
#pragma once

#include "base/arena.h"

typedef enum FieldKind {
    FIELD_BOX,      // edges of length 1
    FIELD_SPHERE,   // radius 1
    FIELD_CYLINDER, // radius 1, length 1 along z
    FIELD_CONE,     // radius 1, height 1 along z
    FIELD_FUNCTION, // a function of the caller
    FIELD_UNION,
    FIELD_INTERSECTION,
    FIELD_DIFFERENCE, // first child minus all others
    FIELD_TRIM,       // union of the children, without the part on the side of `normal`
    FIELD_MIX,        // weighted mean of the children
} FieldKind;

typedef struct Field Field;
struct Field {
    FieldKind kind;
    double inverse[12]; // 3 rows of 4: from the coordinates outside to those of this field
    double scale;       // factor of distances, from inside to outside
    double smooth;      // rounding of edges between children; at most one of these three is used
    double fillet;
    double chamfer;
    double origin[3]; // of FIELD_TRIM
    double normal[3]; // has length 1
    Field **children;
    uint32_t child_count;
    const double *weights; // of FIELD_MIX, repeated if there are more children; NULL: all are 1
    uint32_t weight_count;
    void *function;        // of FIELD_FUNCTION: passed to FieldFunction
    const double *samples; // its distances at all points of the grid (field_sample_functions); NULL: all are outside
    size_t sample_count;   // number of samples
};

// Computes the distances of `count` points from the surface of a function. Returns false to stop.
typedef bool FieldFunction(void *user_data, void *function, const double (*points)[3], uint32_t count,
                           double *distances);

// The surface of a field: closed, with counter-clockwise corners seen from outside.
typedef struct FieldSurface {
    double (*points)[3];
    uint32_t *indices;
    uint32_t point_count;
    uint32_t index_count;
    uint32_t point_capacity;
    uint32_t index_capacity;
} FieldSurface;

enum { FIELD_MAX_CELLS = 1024, FIELD_MAX_POINTS = 1 << 22 }; // maximum number of cells along an axis; of points

// Calls `call` for all points of the grid that field_surface uses with the same arguments, layer by layer, for each
// FIELD_FUNCTION in the field, and stores the distances in its `samples`. If `call` returns false, `samples` is NULL.
// Does nothing if there would be too many cells.
void field_sample_functions(Arena *arena, Field *field, const double low[3], const double high[3], double cell,
                            FieldFunction *call, void *user_data);
// Computes the surface of a field inside a box, from samples in a grid of cubes with edges of length `cell`. Charges
// the work to the arena's budget. Returns false if there would be too many cells or points.
bool field_surface(Arena *arena, const Field *field, const double low[3], const double high[3], double cell,
                   FieldSurface *surface);
