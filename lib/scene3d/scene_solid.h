// scene_solid.h: solids, which are boolean operations on models (spec canvas3d.md 9).
#pragma once

#include "scene3d/mesh.h"
#include "scene3d/scene.h"
#include "solid/field.h"

static inline bool scene_is_solid(NodeKind kind) {
    return kind == KIND_UNION || kind == KIND_INTERSECT || kind == KIND_DIFFERENCE || kind == KIND_TRIM ||
           kind == KIND_SLICE || kind == KIND_SDF;
}

// Returns true for nodes in a solid that have members.
static inline bool scene_is_operation(NodeKind kind) {
    return (scene_is_solid(kind) && kind != KIND_SDF) || kind == KIND_TRANSFORM3D;
}

// Returns true for members of a solid that are not operations.
static inline bool scene_is_model(NodeKind kind) {
    return kind == KIND_BOX || kind == KIND_SPHERE || kind == KIND_CYLINDER || kind == KIND_CONE ||
           kind == KIND_MODEL || kind == KIND_SDF;
}

// Creates the triangles of a solid node, without normals. Returns false, after a report, if there are none.
bool scene_solid_mesh(const Scene *scene, const DrawNode *node, Arena *arena, Mesh *mesh);
// Creates the triangles of an `!sdf`, without normals. Returns false, after a report, if there are none.
bool scene_field_mesh(const Scene *scene, const DrawNode *node, Arena *arena, Mesh *mesh);
// Calls the functions of all `!sdf` nodes in a window's tree for the points at which they are sampled, and stores the
// results in the nodes. The `function` of a call is a FunctionSamples.
void scene_sample_functions(Arena *arena, const DrawNode *node, FieldFunction *call, void *user_data);
// Repairs the triangles of a `!model`. Its normals and texture coordinates are lost.
void scene_repair_mesh(Arena *arena, Mesh *mesh);
