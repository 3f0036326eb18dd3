// test_gl_cost.c: tests of the estimated cost of scenes, without OpenGL: what must hold for any way to estimate it.
#include "check.h"
#include "scene3d/mesh.h"
#include "scene3d/scene_cost.h"
#include "scene3d/scene_cover.h"

enum { SIDE = 400, MAX_MODELS = 200 };

// Models in front of a camera at the distance 10.
typedef struct Stage {
    Arena arena;
    Scene scene;
    SceneGroup group;
    SceneGroup *groups[1];
    SceneInstance instances[MAX_MODELS];
    SceneMaterial material;
    SceneModel model;
    SceneBox box;
    SceneTextures textures;
    GraphicsState3D state;
    Eye eye;
} Stage;

static void set_stage(Stage *stage, NodeKind kind, uint32_t count) {
    *stage = (Stage){.state = {.fov = 0.04,
                               .near = 1,
                               .far = 1000,
                               .depth_sort = true,
                               .depth_test = true,
                               .face_cull = true,
                               .max_lights = 10},
                     .eye = {.position = {0, 0, 10}, .up = {0, 1, 0}, .near = 1, .far = 1000, .aspect = 1},
                     .material = {.surface = {.roughness = 0.3f}},
                     .model = {.kind = (uint8_t)kind, .segments = 64, .snap = 0.5}};
    arena_init(&stage->arena, "test", SIZE_MAX);
    stage->eye.state = &stage->state;
    for (uint32_t i = 0; i < count; i++) {
        stage->instances[i] = (SceneInstance){.matrix = matrix_identity, .material = &stage->material};
        stage->instances[i].matrix.m[14] = -0.05 * i; // one behind the other
    }
    Mesh mesh = kind == KIND_BOX      ? mesh_box(&stage->arena, false)
                : kind == KIND_SPHERE ? mesh_sphere(&stage->arena, 64)
                                      : mesh_cone(&stage->arena, 64);
    mesh_bounds(&mesh, stage->box.low, stage->box.high);
    mesh_measure(&mesh, stage->box.low, stage->box.high, stage->box.layers, stage->box.lengths);
    stage->box.triangles = mesh.index_count / 3;
    stage->group = (SceneGroup){.state = stage->state, .instances = stage->instances, .instance_count = count};
    stage->groups[0] = &stage->group;
    stage->scene = (Scene){.arena = &stage->arena,
                           .groups = stage->groups,
                           .group_count = 1,
                           .models = &stage->model,
                           .model_count = 1,
                           .textures = &stage->textures,
                           .texture_count = 1,
                           .instance_count = count};
}

// Returns the cost in nanoseconds, and frees the stage.
static double cost_of(Stage *stage) {
    Matrix view = matrix_view(&stage->eye), projection = matrix_projection(&stage->eye);
    DrawOrder order = draw_order(&stage->scene, &stage->eye, &view, &projection, SIDE, &stage->box);
    SceneView seen = {.scene = &stage->scene,
                      .order = &order,
                      .boxes = &stage->box,
                      .clip = matrix_product(&projection, &view),
                      .width = SIDE,
                      .height = SIDE};
    double cost = scene_cost(&seen, 0), bound = scene_cost(&seen, INFINITY);
    assert_true(cost >= 0 && cost <= bound && isfinite(bound));
    arena_free(&stage->arena);
    return cost;
}

static double cost_of_row(NodeKind kind, uint32_t count, bool sorts, double transparency) {
    Stage stage;
    set_stage(&stage, kind, count);
    stage.group.state.depth_sort = sorts;
    stage.material.surface.transparency = (float)transparency;
    return cost_of(&stage);
}

static void test_what_nearer_models_hide_costs_little(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        NodeKind kind = i ? KIND_SPHERE : KIND_BOX;
        double one = cost_of_row(kind, 1, true, 0), many = cost_of_row(kind, 100, true, 0);
        assert_claim(i ? "balls" : "boxes", many < 60 * one);
        assert_claim(i ? "balls" : "boxes", cost_of_row(kind, 100, true, 0.5) > 1.4 * many);
        assert_claim(i ? "balls" : "boxes", cost_of_row(kind, 100, false, 0) > 1.4 * many);
    }
    double one = cost_of_row(KIND_BOX, 1, true, 0);
    assert_true(cost_of_row(KIND_BOX, 100, true, 0) < 5 * one);
    assert_true(cost_of_row(KIND_BOX, 100, false, 0) > 40 * one);
}

static double cost_of_needle(double turn) {
    Stage stage;
    set_stage(&stage, KIND_CONE, 1);
    Matrix *place = &stage.instances[0].matrix;
    double c = cos(turn), s = sin(turn); // a long cone in the plane of the picture
    *place = (Matrix){{0.02 * c, 0.02 * s, 0, 0, 0, 0, 0.02, 0, -4 * s, 4 * c, 0, 0, 0, 0, 0, 1}};
    return cost_of(&stage);
}

static void test_a_needle_costs_the_same_at_any_angle(void **state) {
    (void)state;
    double upright = cost_of_needle(0);
    for (int i = 1; i < 16; i++)
        assert_true(cost_of_needle(0.4 * i) < 1.6 * upright && upright < 1.6 * cost_of_needle(0.4 * i));
}

// A mesh of `count` equal squares has `count` layers; turning the squares round exchanges the axes.
static void test_layers_are_counted(void **state) {
    (void)state;
    for (uint32_t count = 1; count <= 50; count++)
        for (int axis = 0; axis < 3; axis++) {
            MeshVertex vertices[4 * 50] = {0};
            uint32_t indices[6 * 50];
            Mesh mesh = {vertices, indices, 4 * count, 6 * count};
            for (uint32_t i = 0; i < count; i++) {
                for (uint32_t k = 0; k < 4; k++) {
                    float *at = vertices[4 * i + k].position;
                    at[axis] = (float)i;
                    at[(axis + 1) % 3] = k & 1;
                    at[(axis + 2) % 3] = (float)(k >> 1);
                }
                const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
                for (uint32_t k = 0; k < 6; k++)
                    indices[6 * i + k] = 4 * i + corners[k];
            }
            SceneBox box;
            mesh_bounds(&mesh, box.low, box.high);
            mesh_measure(&mesh, box.low, box.high, box.layers, box.lengths);
            for (int k = 0; k < 3; k++)
                assert_true(box.layers[k] == (k == axis ? (float)count : 0));
        }
}

// Returns true if the point is in one of the triangles between corners of the face, which cover its convex hull.
static bool is_within(const HidingFace *face, double x, double y) {
    for (int i = 0; i < face->count; i++)
        for (int j = 0; j < i; j++)
            for (int k = 0; k < j; k++) {
                const double *at[3] = {face->corners[i], face->corners[j], face->corners[k]};
                int left = 0, right = 0;
                for (int side = 0; side < 3; side++) {
                    const double *a = at[side], *b = at[(side + 1) % 3];
                    double turn = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
                    left += turn >= -1e-9;
                    right += turn <= 1e-9;
                }
                if (left == 3 || right == 3)
                    return true;
            }
    return false;
}

// Compares random faces with all points of a finer grid: a cell is hidden only if all of it is within a nearer face,
// and most of a large face is hidden.
static void test_only_covered_cells_are_hidden(void **state) {
    (void)state;
    uint64_t seed = 7;
    for (int round = 0; round < 60; round++) {
        static HiddenCells hidden;
        HidingFace face = {.count = 4 + round % 2 * 4, .depth = 5};
        double size = round % 3 == 0 ? 4 : 1;
        for (int i = 0; i < face.count; i++)
            for (int k = 0; k < 2; k++)
                face.corners[i][k] = size * (2e-19 * (double)(next_bits(&seed) >> 1) / 1.8 - 0.5) * 2;
        hidden_clear(&hidden);
        hidden_add(&hidden, &face);
        int cells = 0;
        for (int row = 0; row < HIDDEN_CELLS; row++)
            for (int column = 0; column < HIDDEN_CELLS; column++) {
                bool within = true;
                for (int i = 0; i < 9; i++)
                    within &= is_within(&face, 2 * (column + i % 3 / 2.0) / HIDDEN_CELLS - 1,
                                        2 * (row + i / 3 / 2.0) / HIDDEN_CELLS - 1);
                assert_true(within || isinf(hidden.depths[row][column]));
                cells += within;
                Footprint cell = {.low = {2.0 * column / HIDDEN_CELLS - 1, 2.0 * row / HIDDEN_CELLS - 1},
                                  .high = {2.0 * (column + 1) / HIDDEN_CELLS - 1, 2.0 * (row + 1) / HIDDEN_CELLS - 1}};
                assert_true(hidden_room(&hidden, &cell, 4) > 0); // nearer than the face
            }
        Footprint all = {.low = {-1, -1}, .high = {1, 1}};
        assert_true(1 - hidden_room(&hidden, &all, 5) >= (cells - 4 * HIDDEN_CELLS) / 4096.0);
    }
}

TEST_GROUP(gl_cost) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_what_nearer_models_hide_costs_little),
                                       cmocka_unit_test(test_a_needle_costs_the_same_at_any_angle),
                                       cmocka_unit_test(test_layers_are_counted),
                                       cmocka_unit_test(test_only_covered_cells_are_hidden)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
