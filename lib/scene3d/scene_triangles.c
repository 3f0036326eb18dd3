// scene_triangles.c: creates the triangles of models that are not solids; see scene.h.
#include "base/file.h"
#include "scene3d/mesh_file.h"
#include "scene3d/scene_solid.h"

bool mesh_from_file(Arena *arena, Str bytes, Mesh *mesh, MeshError *error) {
    *error = (MeshError){
        "glTF is not supported; convert it to OBJ, for example with 'assimp export MODEL.glb MODEL.obj'", 0};
    if (str_starts_with(bytes, STR("glTF")) || str_starts_with(bytes, STR("{")))
        return false;
    if (str_starts_with(bytes, STR("ply\n")) || str_starts_with(bytes, STR("ply\r\n")))
        return mesh_read_ply(arena, bytes, mesh, error);
    if (str_starts_with(bytes, STR("OFF")) || str_starts_with(bytes, STR("COFF")))
        return mesh_read_off(arena, bytes, mesh, error);
    return (mesh_is_stl(bytes) ? mesh_read_stl : mesh_read_obj)(arena, bytes, mesh, error);
}

static bool read_file(const Scene *scene, const DrawNode *node, Str name, Arena *arena, Mesh *mesh) {
    enum { MAX_BYTES = 256 << 20 };
    MeshError error = {0};
    Str bytes, text;
    if (file_read(arena, scene->reach, scene_path(scene, name), true, MAX_BYTES, &bytes, NULL, &error.text) &&
        mesh_from_file(arena, bytes, mesh, &error))
        return true;
    Arena *report_arena = scene->diags->arena;
    if (error.line)
        text = str_format(report_arena, "%.*s:%u: %s", STR_ARGS(name), error.line, error.text);
    else
        text = str_format(report_arena, "cannot read '%.*s': %s", STR_ARGS(name), error.text);
    scene_report(scene, "cannot-read", node, str_to_c(report_arena, text));
    return false;
}

static bool read_triangles(const Scene *scene, const DrawNode *node, Arena *arena, Mesh *mesh) {
    const AttrValue *name = draw_attr(node, ATTR_FILENAME), *vertices = draw_attr(node, ATTR_VERTICES),
                    *faces = draw_attr(node, ATTR_FACES), *uv = draw_attr(node, ATTR_UV);
    if (name && name->as.text.len > 0)
        return read_file(scene, node, name->as.text, arena, mesh);
    if (!vertices)
        return false;
    const double *corners = faces ? faces->as.list : NULL;
    uint32_t count = faces ? faces->count : 0;
    const char *problem = "a model without faces can have at most 2000 vertices, which must not all lie in one plane";
    if (!faces && vertices->count % 3 == 0 && vertices->count <= 3 * MESH_MAX_HULL)
        corners = mesh_hull(arena, vertices->as.list, vertices->count / 3, &count);
    if (corners && mesh_from_lists(arena, vertices->as.list, vertices->count, corners, count, uv ? uv->as.list : NULL,
                                   uv ? uv->count : 0, mesh, &problem))
        return true;
    scene_report(scene, "bad-model", node, problem);
    return false;
}

bool scene_triangles(const Scene *scene, const SceneModel *model, Arena *arena, Mesh *mesh) {
    *mesh = (Mesh){.vertices = NULL};
    if (model->kind == KIND_MODEL && !read_triangles(scene, model->node, arena, mesh))
        return false;
    if (model->kind != KIND_MODEL)
        *mesh = model->kind == KIND_BOX        ? mesh_box(arena, model->uv_map == UV_REPEAT)
                : model->disc                  ? mesh_disc(arena, model->segments)
                : model->kind == KIND_SPHERE   ? mesh_sphere(arena, model->segments)
                : model->kind == KIND_CYLINDER ? mesh_cylinder(arena, model->segments)
                                               : mesh_cone(arena, model->segments);
    return mesh->index_count > 0;
}
