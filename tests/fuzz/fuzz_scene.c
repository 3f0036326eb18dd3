// fuzz_scene.c: fuzzes scenes without OpenGL. The input is a script. Its `!canvas3d` nodes are read, the triangles of
// their models are made, and the drawing order and cost of each camera's view are computed.
#include "mesh.h"
#include "picture/picture.h"
#include "pictures.h"
#include "scene3d/mesh.h"
#include "scene3d/scene_cost.h"

#include <string.h>

static const char MODEL[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 1\nf 1/1 2/1 3/1\nf -1 -2 1\nf 1 2 3 4\n";

typedef struct Reading {
    Arena *arena;
    const DrawNode *node;
    const FileAccess *reach;
    DiagSink diags;
} Reading;

static void view_scene(const Scene *scene, const SceneCamera *camera, const SceneBox *boxes) {
    Eye eye = scene_eye(scene, camera);
    Matrix view = matrix_view(&eye), projection = matrix_projection(&eye);
    DrawOrder order = draw_order(scene, &eye, &view, &projection, camera->width, boxes);
    SceneView seen = {scene,         &order,         boxes,       matrix_product(&projection, &view),
                      camera->width, camera->height, .samples = 4};
    if (!(scene_cost(&seen, 0) >= 0) || !(scene_cost(&seen, 1e300) >= 0))
        fuzz_fail("the cost of a view is not a number >= 0");
    for (uint32_t i = 0; i < order.draw_count; i++)
        if (order.draws[i].first > order.count || order.draws[i].count > order.count - order.draws[i].first)
            fuzz_fail("a draw has instances that do not exist");
}

// For arena_protect.
static void read_scene(void *context) {
    Reading *reading = context;
    static SceneLight lights[SCENE_MAX_LIGHTS];
    Scene *scene = scene_read(reading->arena, reading->node, 32, 32, 8, reading->reach, &reading->diags);
    scene->detail = 1;
    SceneBox *boxes = arena_alloc_array(reading->arena, scene->model_count, sizeof *boxes);
    for (uint32_t i = 0; i < scene->model_count; i++) {
        Mesh mesh = {0};
        memset(&boxes[i], 0, sizeof boxes[i]);
        if (!scene_mesh(scene, &scene->models[i], reading->arena, &mesh) || mesh.index_count == 0)
            continue;
        mesh_check(&mesh);
        mesh_bounds(&mesh, boxes[i].low, boxes[i].high);
        mesh_measure(&mesh, boxes[i].low, boxes[i].high, boxes[i].layers, boxes[i].lengths);
        boxes[i].triangles = mesh.index_count / 3;
    }
    for (uint32_t i = 0; i < scene->group_count; i++)
        scene_lights(scene->groups[i], lights, SCENE_MAX_LIGHTS);
    for (uint32_t i = 0; i < scene->camera_count; i++)
        view_scene(scene, &scene->cameras[i], boxes);
}

static void find_scenes(const CanvasPicture *picture, const DrawNode *node) {
    for (uint32_t i = 0; i < node->child_count; i++)
        find_scenes(picture, node->children[i]);
    if (node->kind != KIND_CANVAS3D)
        return;
    Arena arena;
    Budget budget = {.memory_limit = (size_t)64 << 20};
    budget_begin(&budget, 1 << 22, NULL);
    arena_init(&arena, "fuzz", SIZE_MAX);
    arena.budget = &budget;
    Arena *const arenas[] = {&arena};
    Reading reading = {&arena, node, &picture->reach, diag_sink_new(&arena, 100)};
    arena_protect(arenas, 1, read_scene, &reading);
    diag_sink_free(&reading.diags);
    arena_free(&arena);
}

FUZZ_HARNESS(scene) {
    static bool model_written;
    if (!model_written)
        fuzz_put("model.obj", MODEL, sizeof MODEL - 1);
    model_written = true;
    PetriSession *session = pictures_open((const char *)data, size);
    PetriPicture *picture = NULL;
    PetriPictureOptions options = petri_default_picture_options();
    if (session && petri_picture(session, &options, &picture) == PETRI_OK)
        for (uint32_t i = 0; i < picture->picture.top_count; i++)
            find_scenes(&picture->picture, picture->picture.tops[i]);
    petri_picture_free(&picture);
    if (session)
        fuzz_close(&session);
    return 0;
}
