// scene_read.c: reads the nodes of a scene; see scene.h.
#include "base/source.h"
#include "gl/effect.h"
#include "maths/maths.h"
#include "scene3d/scene.h"
#include "scene3d/scene_solid.h"

#include <math.h>
#include <string.h>

// The inherited state at a node of the scene.
typedef struct InheritedState {
    Matrix matrix;
    GraphicsState3D look;
    SceneTextures textures;
    const SceneMaterial *material;
    SceneGroup *group;
} InheritedState;

static double *read_triple(const DrawNode *node, AttrName name, double out[3]) {
    const AttrValue *attr = draw_attr(node, name);
    if (!attr)
        return NULL;
    memcpy(out, attr->as.numbers, 3 * sizeof *out);
    return out;
}

static void read_sampling(SceneTextures *textures, const DrawNode *node) {
    const AttrValue *border = draw_attr(node, ATTR_BORDER), *repeat = draw_attr(node, ATTR_REPEAT);
    if (border && (border->count == 1 || border->count == 3 || border->count == 4)) {
        textures->border = true;
        for (uint32_t k = 0; k < 4; k++)
            textures->border_color[k] = (float)(border->count == 1  ? border->as.list[0]
                                                : k < border->count ? border->as.list[k]
                                                                    : 1);
    }
    for (int k = 0; repeat && k < 2; k++)
        textures->repeat[k] = repeat->as.numbers[k] != 0;
}

static bool same_textures(const SceneTextures *a, const SceneTextures *b) {
    for (int i = 0; i < SCENE_TEXTURES; i++)
        if (!str_equal(a->ids[i], b->ids[i]))
            return false;
    return a->border == b->border && a->repeat[0] == b->repeat[0] && a->repeat[1] == b->repeat[1] &&
           memcmp(a->border_color, b->border_color, sizeof a->border_color) == 0;
}

static uint32_t number_textures(Scene *scene, const InheritedState *place) {
    enum { MAX_COUNT = 1000 };
    SceneTextures wanted = place->textures;
    bool any = false;
    for (int i = 0; i < SCENE_TEXTURES; i++) {
        wanted.ids[i] = place->look.ids[i] ? str_from(place->look.ids[i]) : (Str){0};
        any |= wanted.ids[i].len > 0;
    }
    for (uint32_t i = scene->texture_count; i-- > 1 && any;)
        if (same_textures(&scene->textures[i], &wanted))
            return i;
    if (any && scene->texture_count > MAX_COUNT)
        scene_report(scene, "too-many-textures", scene->node,
                     "a scene can have at most 1000 different sets of textures; the others are left out");
    if (!any || scene->texture_count > MAX_COUNT)
        return 0;
    scene->textures = arena_grow_array(scene->arena, scene->textures, scene->texture_count, &scene->texture_capacity,
                                       sizeof *scene->textures);
    scene->textures[scene->texture_count] = wanted;
    return scene->texture_count++;
}

static void make_material(Scene *scene, InheritedState *place) {
    SceneMaterial *material = arena_alloc(scene->arena, sizeof *material);
    const GraphicsState3D *state = &place->look;
    *material = (SceneMaterial){.surface = {.transparency = (float)scene_clamp(state->transparency, 0, 1),
                                            .translucency = (float)scene_clamp(state->translucency, 0, 1e30),
                                            .ior = (float)scene_clamp(state->ior, 1, 1e30),
                                            .metal = (float)scene_clamp(state->metal, 0, 1),
                                            .roughness = (float)state->roughness,
                                            .ao = (float)scene_clamp(state->ao, 0, 1)},
                                .textures = number_textures(scene, place)};
    for (int k = 0; k < 3; k++) {
        material->surface.albedo[k] = (float)scene_clamp(state->color[k], -1e30, 1e30);
        material->surface.emissive[k] = (float)scene_clamp(state->emissive[k], -1e30, 1e30);
    }
    place->material = material;
}

// Changes the inherited state by the attributes of a node.
static void read_state(Scene *scene, InheritedState *place, const DrawNode *node) {
    double roughness = place->look.roughness, given = 1;
    bool any = false;
    for (uint32_t i = 0; i < node->attr_count; i++) {
        schema_store(&node->attrs[i], &place->look);
        any |= schema_rows[node->attrs[i].row].field != FIELD_NOWHERE || node->attrs[i].name == ATTR_BORDER ||
               node->attrs[i].name == ATTR_REPEAT;
        if (node->attrs[i].name == ATTR_ROUGHNESS)
            given = node->attrs[i].as.numbers[0];
    }
    if (!any)
        return;
    place->look.roughness = fmin(roughness, fmax(1e-6, given));
    read_sampling(&place->textures, node);
    make_material(scene, place);
}

static SceneGroup *add_group(Scene *scene, const SceneGroup *parent, const DrawNode *node,
                             const GraphicsState3D *state) {
    SceneGroup *group = arena_alloc(scene->arena, sizeof *group);
    bool own = draw_attr(node, ATTR_VERTEX) || draw_attr(node, ATTR_FRAGMENT);
    *group = (SceneGroup){.parent = parent, .program = own ? node : NULL, .state = *state};
    scene->groups = arena_grow_array(scene->arena, scene->groups, scene->group_count, &scene->group_capacity,
                                     sizeof *scene->groups);
    scene->groups[scene->group_count++] = group;
    return group;
}

static void set_floats(float *out, const double *x, int count) {
    for (int k = 0; k < count; k++)
        out[k] = (float)scene_clamp(x[k], -1e18, 1e18);
}

static bool read_spot(const Matrix *matrix, const DrawNode *node, const double *direction, const double position[3],
                      SceneLight *light) {
    double focus[3], towards[3];
    if (direction)
        memcpy(towards, direction, sizeof towards);
    else if (read_triple(node, ATTR_FOCUS, focus))
        for (int k = 0; k < 3; k++)
            towards[k] = focus[k] - position[k];
    else
        return false;
    if (vector_dot(towards, towards) == 0)
        return false;
    matrix_direction(matrix, towards, towards);
    set_floats(light->direction, towards, 3);
    double outer = scene_clamp(draw_number(node, ATTR_OUTER), 0, 1);
    double inner = scene_clamp(draw_number(node, ATTR_INNER), 0, outer);
    light->kind = LIGHT_SPOT;
    light->radius = (float)maths_cos(3.141592653589793 * outer);
    light->length = (float)maths_cos(3.141592653589793 * inner);
    return true;
}

static void read_kind(const Matrix *matrix, const DrawNode *node, SceneLight *light) {
    double start[3], end[3], position[3], direction[3];
    const double *towards = read_triple(node, ATTR_DIRECTION, direction);
    if (towards && vector_dot(towards, towards) == 0)
        towards = NULL;
    if (read_triple(node, ATTR_START, start) && read_triple(node, ATTR_END, end)) {
        matrix_point(matrix, start, start);
        matrix_point(matrix, end, end);
        set_floats(light->position, start, 3);
        for (int k = 0; k < 3; k++)
            end[k] -= start[k];
        light->kind = LIGHT_LINE;
        light->length = (float)fmin(sqrt(vector_dot(end, end)), 1e18);
        light->radius = (float)scene_clamp(draw_number(node, ATTR_RADIUS), 0, 1e18);
        if (!vector_normalise(end))
            memcpy(end, (double[3]){1, 0, 0}, sizeof end);
        set_floats(light->direction, end, 3);
    } else if (read_triple(node, ATTR_POSITION, position)) {
        double world[3];
        matrix_point(matrix, position, world);
        set_floats(light->position, world, 3);
        if (!read_spot(matrix, node, towards, position, light)) {
            light->radius = (float)scene_clamp(draw_number(node, ATTR_RADIUS), 0, 1e18);
            light->kind = light->radius > 0 ? LIGHT_BALL : LIGHT_POINT;
        }
    } else if (towards) {
        light->kind = LIGHT_DIRECTIONAL;
        matrix_direction(matrix, towards, direction);
        set_floats(light->direction, direction, 3);
    }
}

static void read_light(Scene *scene, const InheritedState *place, const DrawNode *node) {
    double color[3];
    if (!read_triple(node, ATTR_COLOR, color) || vector_dot(color, color) == 0)
        return;
    if (scene->light_count >= SCENE_MAX_LIGHTS) {
        scene_report(scene, "too-many-lights", node, "a scene can have at most 4000 lights; the others are left out");
        return;
    }
    SceneLight light = {.falloff = {0, 0, 1, 0}};
    const AttrValue *falloff = draw_attr(node, ATTR_FALLOFF);
    set_floats(light.color, color, 3);
    if (falloff)
        set_floats(light.falloff, falloff->as.numbers, 4);
    read_kind(&place->matrix, node, &light);
    SceneGroup *group = place->group;
    group->lights = arena_grow_array(scene->arena, group->lights, group->light_count, &group->light_capacity,
                                     sizeof *group->lights);
    group->lights[group->light_count++] = light;
    scene->light_count++;
}

static void read_points(SceneCamera *camera, const Matrix *matrix, const DrawNode *node) {
    double point[3];
    if (read_triple(node, ATTR_POSITION, point))
        matrix_point(matrix, point, camera->position);
    if (read_triple(node, ATTR_FOCUS, point))
        matrix_point(matrix, point, camera->focus);
    if (read_triple(node, ATTR_UP, point))
        matrix_direction(matrix, point, camera->up);
}

static SceneCamera *add_camera(Scene *scene) {
    scene->cameras = arena_grow_array(scene->arena, scene->cameras, scene->camera_count, &scene->camera_capacity,
                                      sizeof *scene->cameras);
    return &scene->cameras[scene->camera_count++];
}

static void read_camera(Scene *scene, const InheritedState *place, const DrawNode *node) {
    enum { MAX_COUNT = 100 };
    const AttrValue *id = draw_attr(node, ATTR_ID);
    double size[2];
    if (!id || id->as.text.len == 0)
        return;
    if (scene->camera_count >= MAX_COUNT) {
        scene_report(scene, "too-many-cameras", node, "a scene can have at most 100 cameras; the others are left out");
        return;
    }
    SceneCamera *camera = add_camera(scene);
    *camera = scene->cameras[0];
    camera->node = node;
    camera->id = id->as.text;
    camera->secondary = draw_flag(node, ATTR_SECONDARY);
    for (uint32_t i = 0; i < node->attr_count; i++)
        schema_store(&node->attrs[i], &camera->state);
    read_points(camera, &place->matrix, node);
    if (draw_pair(node, ATTR_SIZE, size)) {
        camera->width = (int)scene_clamp(size[0], 0, 1e6);
        camera->height = (int)scene_clamp(size[1], 0, 1e6);
    }
}

// Returns the index of a node's model in the scene. If there are too many models, reports this and returns UINT32_MAX.
static uint32_t number_model(Scene *scene, const DrawNode *node) {
    SceneModel model = scene_model(scene, node);
    for (uint32_t i = scene->model_count; i-- > 0;)
        if (scene_same_model(&scene->models[i], &model))
            return i;
    if (scene->model_count >= SCENE_MAX_MODELS) {
        scene_report(scene, "too-many-models", node,
                     "a scene can have at most 2000 different models; the others are left out");
        return UINT32_MAX;
    }
    scene->models =
        arena_grow_array(scene->arena, scene->models, scene->model_count, &scene->model_capacity, sizeof model);
    scene->models[scene->model_count] = model;
    return scene->model_count++;
}

static void read_model(Scene *scene, const InheritedState *outside, const DrawNode *node) {
    InheritedState place = *outside;
    if (scene->instance_count >= SCENE_MAX_INSTANCES) {
        scene_report(scene, "too-many-models", node, "a scene can have at most 200000 models; the others are left out");
        return;
    }
    read_state(scene, &place, node);
    SceneInstance instance = {matrix_placed(place.matrix, node), place.material, number_model(scene, node)};
    if (instance.model == UINT32_MAX || !matrix_is_finite(&instance.matrix))
        return;
    SceneGroup *group = place.group;
    group->instances = arena_grow_array(scene->arena, group->instances, group->instance_count,
                                        &group->instance_capacity, sizeof *group->instances);
    group->instances[group->instance_count++] = instance;
    scene->instance_count++;
}

// The recursion is limited by the maximum depth of nodes.
static void read_children(Scene *scene, const InheritedState *outside, const DrawNode *node) {
    for (uint32_t i = 0; i < node->child_count; i++) {
        const DrawNode *child = node->children[i];
        InheritedState place;
        switch ((NodeKind)child->kind) {
        case KIND_LIGHT:
            read_light(scene, outside, child);
            break;
        case KIND_CAMERA:
            read_camera(scene, outside, child);
            break;
        case KIND_TRANSFORM3D:
        case KIND_MATERIAL:
        case KIND_GROUP3D:
            place = *outside;
            place.matrix = matrix_transformed(place.matrix, child);
            read_state(scene, &place, child);
            if (child->kind == KIND_GROUP3D)
                place.group = add_group(scene, outside->group, child, &place.look);
            read_children(scene, &place, child);
            break;
        case KIND_MIX:
            scene_report(scene, "misplaced-node", child, "has no effect outside a distance field; ignored");
            break;
        default:
            read_model(scene, outside, child);
        }
    }
}

Scene *scene_read(Arena *arena, const DrawNode *node, int width, int height, int bits, const FileAccess *reach,
                  DiagSink *diags) {
    Scene *scene = arena_alloc(arena, sizeof *scene);
    *scene = (Scene){
        .arena = arena, .node = node, .reach = reach, .diags = diags, .width = width, .detail = 1, .bits = bits};
    scene->textures = arena_grow_array(arena, NULL, 0, &scene->texture_capacity, sizeof *scene->textures);
    scene->textures[scene->texture_count++] = (SceneTextures){.border = false};
    InheritedState place = {.matrix = matrix_identity};
    schema_defaults(KIND_CANVAS3D, &place.look);
    make_material(scene, &place);
    read_state(scene, &place, node);
    SceneCamera *camera = add_camera(scene);
    *camera = (SceneCamera){.node = node,
                            .state = place.look,
                            .position = {0, 0, width / 2.0},
                            .up = {0, 1, 0},
                            .width = width,
                            .height = height};
    read_points(camera, &matrix_identity, node);
    place.matrix = matrix_transformed(place.matrix, node);
    place.group = add_group(scene, NULL, node, &place.look);
    read_children(scene, &place, node);
    const AttrValue *id = draw_attr(node, ATTR_CAMERA_ID);
    for (uint32_t i = 1; id && i < scene->camera_count; i++)
        if (str_equal(scene->cameras[i].id, id->as.text))
            scene->shown = i;
    return scene;
}
