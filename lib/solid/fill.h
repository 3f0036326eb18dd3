// fill.h: triangulation of polygons with holes.
#pragma once

#include "solid/solid.h"

// Triangles that are being made.
typedef struct FaceBuilder {
    uint32_t (*faces)[3];
    uint32_t count;
    uint32_t capacity;
} FaceBuilder;

void face_builder_add(Arena *arena, FaceBuilder *builder, uint32_t a, uint32_t b, uint32_t c);

// A side of a polygon, from one point to another.
typedef struct PolygonSide {
    uint32_t from;
    uint32_t to;
} PolygonSide;

// Triangulates polygons. At each point, as many sides end as begin. Polygons are counter-clockwise in the plane of the
// axes x and y, and holes are clockwise. The triangles have the sides as their border whatever the polygons are, even
// if sides intersect.
void fill_polygons(Arena *arena, FaceBuilder *builder, const int32_t (*points)[3], PolygonSide *sides, uint32_t count,
                   int x, int y);
