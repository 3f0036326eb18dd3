// mesh.h: a check of meshes, shared by harnesses.
#pragma once

#include "fuzz.h"
#include "scene3d/mesh.h"

// Checks that all indices of a mesh refer to its vertices.
static inline void mesh_check(const Mesh *mesh) {
    if (mesh->index_count % 3 != 0)
        fuzz_fail("a mesh has an incomplete triangle");
    for (uint32_t i = 0; i < mesh->index_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            fuzz_fail("a mesh has an index without a vertex");
}
