// scene_model.c: identifies equal models and creates their triangles; see scene.h.
#include "base/file.h"
#include "base/source.h"
#include "gl/effect.h"
#include "gl/scene.h"
#include "gl/scene_solid.h"

static uint64_t hash_list(uint64_t seed, const DrawNode *node, AttrName name) {
    const AttrValue *attr = draw_attr(node, name);
    return attr ? hash_bytes(seed, attr->as.list, attr->count * sizeof *attr->as.list) : seed + 1;
}

static const char *path_of(const Scene *scene, Str name) {
    return str_to_c(scene->arena, path_join(scene->arena, scene->reach->directory, name));
}

uint64_t scene_model_hash(const Scene *scene, const DrawNode *node) {
    const AttrValue *name = draw_attr(node, ATTR_FILENAME);
    Str version = {0};
    if (!name || name->as.text.len == 0)
        return hash_list(hash_list(hash_list(1, node, ATTR_VERTICES), node, ATTR_FACES), node, ATTR_UV) | 1;
    file_version(scene->arena, scene->reach, path_of(scene, name->as.text), &version);
    uint64_t seed = hash_bytes(2, name->as.text.bytes, name->as.text.len);
    return hash_bytes(seed, version.bytes, version.len) | 1;
}

bool scene_same_model(const SceneModel *a, const SceneModel *b) {
    return a->kind == b->kind && a->segments == b->segments && a->source == b->source && a->flat == b->flat &&
           a->invert == b->invert && a->repair == b->repair && a->disc == b->disc && a->remap == b->remap &&
           a->uv_map == b->uv_map && a->snap == b->snap;
}

static bool read_file(const Scene *scene, const DrawNode *node, Str name, Arena *arena, Mesh *mesh) {
    enum { MAX_BYTES = 256 << 20 };
    MeshError fault = {0};
    Str bytes, text;
    if (file_read(arena, scene->reach, path_of(scene, name), true, MAX_BYTES, &bytes, NULL, &fault.text) &&
        mesh_from_file(arena, bytes, mesh, &fault))
        return true;
    Arena *report_arena = scene->faults->arena;
    if (fault.line)
        text = str_format(report_arena, "%.*s:%u: %s", STR_ARGS(name), fault.line, fault.text);
    else
        text = str_format(report_arena, "cannot read '%.*s': %s", STR_ARGS(name), fault.text);
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
