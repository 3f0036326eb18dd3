// mesh.h: the triangles of models (spec canvas3d.md 6 to 8), created on the CPU without OpenGL. Corners are
// counter-clockwise when seen from outside.
#pragma once

#include "base/arena.h"
#include "base/str.h"
#include "schema/table.h"

typedef struct MeshVertex {
    float position[3];
    float normal[3];
    float uv[2];
} MeshVertex;

// A triangle mesh. Its arrays are in the arena that was passed to the function that created the mesh.
typedef struct Mesh Mesh;
struct Mesh {
    MeshVertex *vertices;
    uint32_t *indices; // three per triangle
    uint32_t vertex_count;
    uint32_t index_count;
};

enum { MESH_MAX_SEGMENTS = 1024, MESH_MAX_CORNERS = 12 << 20 };

Mesh mesh_box(Arena *arena, bool repeat);            // if `repeat` is true, each face shows the whole texture
Mesh mesh_sphere(Arena *arena, uint32_t segments);   // `segments` is rounded up to a multiple of 4
Mesh mesh_disc(Arena *arena, uint32_t segments);     // radius 1, facing z; `segments` is rounded up to a multiple of 4
Mesh mesh_cylinder(Arena *arena, uint32_t segments); // `segments` below 2 is treated as 2
Mesh mesh_cone(Arena *arena, uint32_t segments);     // `segments` below 2 is treated as 2
void mesh_bounds(const Mesh *mesh, float low[3], float high[3]); // the mesh must not be empty
// Computes how many triangles a line along each axis meets from one side, on average over the box low..high, and the
// sum of the lengths of all triangles along each axis, in lengths of the box.
void mesh_measure(const Mesh *mesh, const float low[3], const float high[3], float layers[3], float lengths[3]);

// Modify the surface of a mesh. mesh_flat gives each corner the normal of its triangle. mesh_invert turns the surface
// inside out.
void mesh_flat(Arena *arena, Mesh *mesh);
// Recomputes the normals. At edges where the normals of the two triangles differ by more than `turns`, the surface gets
// a sharp edge.
void mesh_snap(Arena *arena, Mesh *mesh, double turns);
void mesh_invert(Mesh *mesh);
void mesh_remap(Arena *arena, Mesh *mesh, int how); // `how` is REMAP_SPHERE and so on

// Why a file could not be read as a mesh.
typedef struct MeshError {
    const char *text;
    uint32_t line; // line of the file; 0: unknown
} MeshError;

// Reads a mesh from the bytes of an OBJ, STL, PLY or OFF file; STL and PLY files can be text or binary. On failure,
// sets *error and returns false.
bool mesh_from_file(Arena *arena, Str bytes, Mesh *mesh, MeshError *error);
// Returns the faces of the convex hull of `count` points. Each point is three numbers in `vertices`, and each face is
// three indices of points. *numbers receives the number of all indices. Returns NULL if all points lie in a plane.
enum { MESH_MAX_HULL = 2000 }; // maximum number of points
const double *mesh_hull(Arena *arena, const double *vertices, uint32_t count, uint32_t *numbers);
// Creates a mesh from lists: vertices and faces of three numbers each, and optional texture coordinates of two numbers
// each.
bool mesh_from_lists(Arena *arena, const double *vertices, uint32_t vertex_numbers, const double *faces,
                     uint32_t face_numbers, const double *uv, uint32_t uv_numbers, Mesh *mesh, const char **problem);
