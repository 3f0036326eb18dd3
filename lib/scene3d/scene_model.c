// scene_model.c: the properties of models, which identify equal models; see scene.h.
#include "base/file.h"
#include "base/source.h"
#include "gl/effect.h"
#include "scene3d/scene.h"
#include "scene3d/scene_solid.h"

static uint64_t hash_list(uint64_t seed, const DrawNode *node, AttrName name) {
    const AttrValue *attr = draw_attr(node, name);
    return attr ? hash_bytes(seed, attr->as.list, attr->count * sizeof *attr->as.list) : seed + 1;
}

// Returns a hash of the data from which the triangles of a `!model` are created. The hash is never 0.
static uint64_t hash_model(const Scene *scene, const DrawNode *node) {
    const AttrValue *name = draw_attr(node, ATTR_FILENAME);
    Str version = {0};
    if (!name || name->as.text.len == 0)
        return hash_list(hash_list(hash_list(1, node, ATTR_VERTICES), node, ATTR_FACES), node, ATTR_UV) | 1;
    file_version(scene->arena, scene->reach, scene_path(scene, name->as.text), &version);
    uint64_t seed = hash_bytes(2, name->as.text.bytes, name->as.text.len);
    return hash_bytes(seed, version.bytes, version.len) | 1;
}

bool scene_same_model(const SceneModel *a, const SceneModel *b) {
    return a->kind == b->kind && a->segments == b->segments && a->source == b->source && a->flat == b->flat &&
           a->invert == b->invert && a->repair == b->repair && a->disc == b->disc && a->remap == b->remap &&
           a->uv_map == b->uv_map && a->snap == b->snap;
}

// Adds the attributes that determine the shape, other than those of the placement.
static uint64_t hash_attributes(const DrawNode *node, uint64_t seed) {
    static const AttrName names[] = {ATTR_ORIGIN,  ATTR_NORMAL,  ATTR_MINIMUM,    ATTR_MIN,
                                     ATTR_MAXIMUM, ATTR_MAX,     ATTR_RESOLUTION, ATTR_SMOOTH,
                                     ATTR_FILLET,  ATTR_CHAMFER, ATTR_WEIGHTS,    ATTR_FUNCTION};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const AttrValue *attr = schema_row((NodeKind)node->kind, names[i]) ? draw_attr(node, names[i]) : NULL;
        if (!attr)
            seed++;
        else if (names[i] == ATTR_WEIGHTS)
            seed = hash_bytes(seed, attr->as.list, attr->count * sizeof *attr->as.list);
        else if (names[i] == ATTR_FUNCTION)
            seed = hash_bytes(seed, &attr->as.function->hash, sizeof attr->as.function->hash);
        else
            seed = hash_bytes(seed, attr->as.numbers, (i < 6 ? 3 : 1) * sizeof *attr->as.numbers);
    }
    return seed;
}

static uint64_t hash_children(const Scene *scene, const DrawNode *node, uint64_t seed);

static uint64_t hash_member(const Scene *scene, const DrawNode *node, uint64_t seed) {
    NodeKind kind = (NodeKind)node->kind;
    Matrix matrix = matrix_of_member(&matrix_identity, node);
    seed = hash_bytes(seed, matrix.m, sizeof matrix.m);
    if (scene_is_operation(kind) || kind == KIND_SDF || kind == KIND_MIX)
        return hash_children(scene, node, seed);
    if (!scene_is_model(kind))
        return seed;
    SceneModel model = scene_model(scene, node);
    uint64_t facts[] = {model.kind, model.source, model.segments, model.repair};
    return hash_bytes(seed, facts, sizeof facts);
}

// Returns a hash of everything that determines the triangles of a solid. The recursion is limited by the maximum depth
// of nodes.
static uint64_t hash_children(const Scene *scene, const DrawNode *node, uint64_t seed) {
    arena_charge(scene->arena, 20 + (uint64_t)node->child_count * 20);
    uint64_t facts[] = {node->kind, node->child_count};
    seed = hash_bytes(seed, facts, sizeof facts);
    seed = hash_attributes(node, seed);
    for (uint32_t i = 0; i < node->child_count; i++)
        seed = hash_member(scene, node->children[i], seed);
    return seed;
}

SceneModel scene_model(const Scene *scene, const DrawNode *node) {
    NodeKind kind = (NodeKind)node->kind;
    SceneModel model = {.kind = node->kind,
                        .node = node,
                        .snap = scene_clamp(draw_number(node, ATTR_SNAP_EDGES), 0, 0.5),
                        .flat = draw_flag(node, ATTR_FLAT),
                        .invert = draw_flag(node, ATTR_INVERT),
                        .remap = (uint8_t)draw_word(node, ATTR_UV_REMAP)};
    if (kind == KIND_BOX) {
        model.uv_map = (uint8_t)draw_word(node, ATTR_UV_MAP);
    } else if (scene_is_solid(kind)) {
        model.source = hash_children(scene, node, 3) | 1;
    } else if (kind == KIND_MODEL) {
        model.source = hash_model(scene, node);
        model.repair = draw_flag(node, ATTR_REPAIR);
    } else {
        double segments = draw_number(node, ATTR_SEGMENTS);
        if (segments > MESH_MAX_SEGMENTS)
            scene_report(scene, "too-many-segments", node, "the number of segments is limited to 1024");
        model.segments = (uint32_t)scene_clamp(segments, kind == KIND_SPHERE ? 4 : 2, MESH_MAX_SEGMENTS);
    }
    return model;
}
