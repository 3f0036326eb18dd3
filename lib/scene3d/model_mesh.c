// model_mesh.c: creates the triangles of any model; see scene.h.
#include "scene3d/scene_solid.h"

bool scene_mesh(const Scene *scene, const SceneModel *model, Arena *arena, Mesh *mesh) {
    bool solid = scene_is_solid((NodeKind)model->kind);
    if (!(model->kind == KIND_SDF ? scene_field_mesh(scene, model->node, arena, mesh)
          : solid                 ? scene_solid_mesh(scene, model->node, arena, mesh)
                                  : scene_triangles(scene, model, arena, mesh)))
        return false;
    if (model->repair)
        scene_repair_mesh(arena, mesh);
    if (model->flat || model->snap == 0)
        mesh_flat(arena, mesh);
    else if (model->snap < 0.5 || solid || model->repair)
        mesh_snap(arena, mesh, model->snap);
    if (model->invert)
        mesh_invert(mesh);
    if (model->remap != REMAP_NONE)
        mesh_remap(arena, mesh, model->remap);
    return true;
}
