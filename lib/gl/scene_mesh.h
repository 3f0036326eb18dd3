// scene_mesh.h: the triangles of models (spec canvas3d.md 6 to 8), made on the CPU: corners counter-clockwise seen from
// outside. Nothing here needs OpenGL.
#ifndef PETRI_GL_SCENE_MESH_H
#define PETRI_GL_SCENE_MESH_H

#include "base/arena.h"
#include "base/str.h"
#include "schema/table.h"

typedef struct MeshVertex {
    float position[3];
    float normal[3];
    float uv[2];
} MeshVertex;

// In an arena, as is what the functions below return.
typedef struct Mesh Mesh;
struct Mesh {
    MeshVertex *vertices;
    uint32_t *indices; // three for each triangle
    uint32_t vertex_count;
    uint32_t index_count;
};

enum { MESH_MAX_SEGMENTS = 1024, MESH_MAX_CORNERS = 12 << 20 };

Mesh mesh_box(Arena *arena, bool repeat);                        // each face has all of the texture
Mesh mesh_sphere(Arena *arena, uint32_t segments);               // rounded up to a multiple of 4
Mesh mesh_disc(Arena *arena, uint32_t segments);                 // likewise; radius 1, towards z
Mesh mesh_cylinder(Arena *arena, uint32_t segments);             // 2 or more
Mesh mesh_cone(Arena *arena, uint32_t segments);                 // likewise
void mesh_bounds(const Mesh *mesh, float low[3], float high[3]); // the mesh is not empty

// Changes of a surface.
void mesh_flat(Arena *arena, Mesh *mesh);
// Splits it at edges where normals of triangles differ by more than `turns`; normals are made anew.
void mesh_snap(Arena *arena, Mesh *mesh, double turns);
void mesh_invert(Mesh *mesh);
void mesh_remap(Arena *arena, Mesh *mesh, int how); // REMAP_…

// Why a file has no triangles.
typedef struct MeshError {
    const char *text;
    uint32_t line; // of the file; 0: none in particular
} MeshError;

// From the bytes of a file: OBJ, STL as text or in binary. False with a reason.
bool mesh_from_file(Arena *arena, Str bytes, Mesh *mesh, MeshError *fault);
// The faces of the convex hull of points, three numbers each: numbers of points, three for a triangle. NULL if all lie
// in a plane.
enum { MESH_MAX_HULL = 2000 }; // points
const double *mesh_hull(Arena *arena, const double *vertices, uint32_t count, uint32_t *numbers);
// From numbers: of vertices, three each, of faces, three each, of texture places, two each or none.
bool mesh_from_lists(Arena *arena, const double *vertices, uint32_t vertex_numbers, const double *faces,
                     uint32_t face_numbers, const double *uv, uint32_t uv_numbers, Mesh *mesh, const char **problem);

#endif
