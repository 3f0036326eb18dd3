// scene_solid.h: solids, which are boolean operations on models (spec canvas3d.md 9).
#pragma once

#include "gl/scene.h"
#include "gl/scene_mesh.h"
#include "solid/field.h"

static inline bool scene_is_solid(NodeKind kind) {
    return kind == KIND_UNION || kind == KIND_INTERSECT || kind == KIND_DIFFERENCE || kind == KIND_TRIM ||
           kind == KIND_SLICE || kind == KIND_SDF;
}

// Returns a hash of everything that determines the triangles of a solid node. The hash is never 0.
uint64_t scene_solid_hash(const Scene *scene, const DrawNode *node);
// Creates the triangles of a solid node, without normals. Returns false, after a report, if there are none.
bool scene_solid_mesh(const Scene *scene, const DrawNode *node, Arena *arena, Mesh *mesh);
// Creates the triangles of an `!sdf`, without normals. Returns false, after a report, if there are none.
bool scene_field_mesh(const Scene *scene, const DrawNode *node, Arena *arena, Mesh *mesh);
// Calls the functions of all `!sdf` nodes in a window's tree for the points at which they are sampled, and stores the
// results in the nodes. The `function` of a call is a FunctionSamples.
void scene_sample_functions(Arena *arena, const DrawNode *node, FieldFunction *call, void *user_data);
// Returns the matrix of a member of a solid or distance field, in the coordinates of the enclosing node.
Matrix scene_member_matrix(const Matrix *outside, const DrawNode *node);
// Repairs the triangles of a `!model`. Its normals and texture coordinates are lost.
void scene_repair_mesh(Arena *arena, Mesh *mesh);
