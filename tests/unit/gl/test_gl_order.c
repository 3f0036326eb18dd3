// test_gl_order.c: tests, without OpenGL, of reading scenes and of draw_order: limits, which spheres are drawn as
// discs, and the positions of the discs.
#include "check.h"
#include "scene3d/draw_order.h"
#include "scene3d/mesh.h"
#include "scene3d/sphere_impostor.h"

#include <math.h>
#include <string.h>

// Three balls of radius 10 in a row, seen from the side. Test cases modify the stage.
enum { WIDTH = 400, MAX_INSTANCES = 60 };
typedef struct Stage {
    Arena arena;
    Scene scene;
    SceneGroup group;
    SceneGroup *groups[1];
    SceneInstance instances[MAX_INSTANCES];
    SceneMaterial material;
    SceneMaterial opaque;
    SceneModel model;
    SceneTextures textures;
    GraphicsState3D graphics_state;
    Eye eye;
    bool deep; // the depth test is also used for discs
} Stage;

static void set_stage(Stage *stage) {
    *stage = (Stage){
        .graphics_state = {.fov = 0.25, .near = 1, .far = 1000},
        .eye = {.position = {30, 20, 300}, .up = {0, 1, 0}, .near = 1, .far = 1000, .width = WIDTH, .aspect = 1},
        .material = {.surface = {.transparency = 0.5f, .roughness = 0.3f}},
        .opaque = {.surface = {.roughness = 0.3f}},
        .model = {.kind = KIND_SPHERE, .segments = 64, .snap = 0.5}};
    arena_init(&stage->arena, "test", SIZE_MAX);
    stage->eye.state = &stage->graphics_state;
    for (int i = 0; i < MAX_INSTANCES; i++) {
        Matrix *place = &stage->instances[i].matrix;
        *place = matrix_identity;
        place->m[0] = place->m[5] = place->m[10] = 10;
        place->m[12] = 40.0 * (i % 3 - 1);
        place->m[14] = -5.0 * i;
        stage->instances[i].material = &stage->material;
    }
    stage->group = (SceneGroup){.state = {.depth_sort = true, .depth_test = true, .face_cull = true},
                                .instances = stage->instances,
                                .instance_count = 3};
    stage->groups[0] = &stage->group;
    stage->scene = (Scene){.arena = &stage->arena,
                           .groups = stage->groups,
                           .group_count = 1,
                           .models = &stage->model,
                           .model_count = 1,
                           .textures = &stage->textures,
                           .texture_count = 1,
                           .instance_count = 3};
}

// Returns the number of the stage's balls that are drawn as discs.
static uint32_t count_discs(Stage *stage) {
    const SceneBox box = {.low = {-1, -1, -1}, .high = {1, 1, 1}, .triangles = 2048};
    Matrix view = matrix_view(&stage->eye), projection = matrix_projection(&stage->eye);
    DrawOrder order = draw_order(&stage->scene, &stage->eye, &view, &projection, WIDTH, &box);
    uint32_t count = 0;
    assert_int_equal(order.count, stage->group.instance_count);
    for (uint32_t i = 0; i < order.draw_count; i++) {
        count += order.draws[i].disc ? order.draws[i].count : 0;
        stage->deep |= order.draws[i].disc && order.draws[i].deep;
        if (order.draws[i].disc)
            assert_int_equal(order.draws[i].segments, stage->model.segments);
    }
    arena_free(&stage->arena);
    return count;
}

// Each case changes the stage. The comment at the start of a case gives the reason for the expected result.
static void test_which_spheres_become_discs(void **state) {
    (void)state;
    Stage stage;
    set_stage(&stage);
    assert_int_equal(count_discs(&stage), 3);
    assert_false(stage.deep);
    set_stage(&stage); // opaque balls must write depth
    stage.instances[1].material = &stage.opaque;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage); // if there are many discs, the depth test is used for them
    stage.group.instance_count = stage.scene.instance_count = MAX_INSTANCES;
    stage.instances[1].material = &stage.opaque;
    assert_int_equal(count_discs(&stage), MAX_INSTANCES - 1);
    assert_true(stage.deep);
    set_stage(&stage); // translucent balls must write depth and need their back faces
    stage.material.surface.translucency = 1;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage); // without sorting, all balls must write depth
    stage.group.state.depth_sort = false;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage); // back faces are drawn as well
    stage.group.state.face_cull = false;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage); // only back faces are drawn
    stage.group.state.cull_face = FACE_FRONT;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage);
    stage.model.flat = true;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage);
    stage.model.invert = true;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage); // the corners of the polygon are visible
    stage.model.segments = 12;
    assert_int_equal(count_discs(&stage), 0);
    set_stage(&stage); // the ball is an ellipsoid
    stage.instances[0].matrix.m[0] = 12;
    assert_int_equal(count_discs(&stage), 2);
    set_stage(&stage); // the ball is mirrored, so its inside is visible
    stage.instances[0].matrix.m[0] = -10;
    assert_int_equal(count_discs(&stage), 2);
    set_stage(&stage); // the ball is sheared
    stage.instances[0].matrix.m[4] = 3;
    assert_int_equal(count_discs(&stage), 2);
    set_stage(&stage); // the ball is clipped by the near plane
    stage.eye.near = 300;
    assert_true(count_discs(&stage) < 3);
    set_stage(&stage);
    stage.eye.far = 310;
    assert_true(count_discs(&stage) < 3);
}

// Opaque instances are drawn first, grouped by model, nearest first. Transparent instances follow, farthest first. At
// equal depth, they are in the order in which their models first appeared.
static void test_transparent_instances_are_sorted(void **state) {
    (void)state;
    static const struct {
        double z;
        bool opaque;
        uint32_t model;
    } rows[] = {{0, false, 0}, {0, false, 1}, {0, false, 0}, {-20, false, 1},
                {5, true, 1},  {-5, true, 0}, {-9, true, 1}, {-3, true, 0}};
    static const uint32_t wanted[] = {7, 5, 4, 6, 3, 0, 2, 1}; // order required by the specification
    enum { ROWS = sizeof rows / sizeof *rows };
    SceneModel models[2] = {{.kind = KIND_BOX}, {.kind = KIND_CONE}};
    const SceneBox boxes[2] = {{.low = {-1, -1, -1}, .high = {1, 1, 1}, .triangles = 12},
                               {.low = {-1, -1, -1}, .high = {1, 1, 1}, .triangles = 128}};
    Stage stage;
    set_stage(&stage);
    stage.scene.models = models;
    stage.scene.model_count = 2;
    stage.group.instance_count = stage.scene.instance_count = ROWS;
    for (uint32_t i = 0; i < ROWS; i++) {
        stage.instances[i].matrix.m[12] = 0;
        stage.instances[i].matrix.m[14] = rows[i].z;
        stage.instances[i].model = rows[i].model;
        stage.instances[i].material = rows[i].opaque ? &stage.opaque : &stage.material;
    }
    stage.eye.position[0] = stage.eye.position[1] = 0; // puts the eye on the z axis, so that depth is measured along z
    Matrix view = matrix_view(&stage.eye), projection = matrix_projection(&stage.eye);
    DrawOrder order = draw_order(&stage.scene, &stage.eye, &view, &projection, WIDTH, boxes);
    assert_int_equal(order.count, ROWS);
    for (uint32_t i = 0; i < ROWS; i++)
        assert_int_equal(order.instances[i] - stage.instances, wanted[i]);
    arena_free(&stage.arena);
}

static double apart(const double a[3], const double b[3]) {
    double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(vector_dot(d, d));
}

// A ray from the camera through the disc's rim touches the ball, which is checked with Pythagoras.
static void check_rim(Stage *stage, const Matrix *place) {
    SphereImpostor disc;
    Matrix view = matrix_view(&stage->eye);
    assert_true(sphere_impostor(&stage->eye, &view, place, &disc));
    double *eye = stage->eye.position, away = apart(eye, disc.middle), turned = 0;
    for (int i = 0; i < 16; i++) {
        double angle = i * 0.3927, rim[3], on[3] = {cos(angle), sin(angle), 0}, outwards[3], towards[3], normal[3];
        matrix_point(&disc.place, on, rim);
        for (int k = 0; k < 3; k++) {
            outwards[k] = rim[k] - disc.middle[k];
            towards[k] = stage->graphics_state.orthographic ? eye[k] - stage->eye.focus[k] : eye[k] - rim[k];
        }
        assert_true(fabs(apart(rim, disc.middle) - disc.radius) < 1e-9 * disc.radius);
        assert_true(fabs(vector_dot(outwards, towards)) < 1e-8 * away * disc.radius);
        matrix_direction(&disc.place, (double[3]){0, 0, 1},
                         normal); // corners are counter-clockwise as seen from the camera
        turned += vector_dot(normal, towards) > 0;
    }
    assert_int_equal((int)turned, 16);
    assert_true(fabs(disc.near - (stage->graphics_state.orthographic ? 0 : disc.radius / away)) < 1e-12);
}

static void test_disc_rim_touches_sphere(void **state) {
    (void)state;
    Stage stage;
    set_stage(&stage);
    for (int i = 0; i < 3; i++)
        check_rim(&stage, &stage.instances[i].matrix);
    stage.eye.position[1] = 150, stage.eye.up[0] = 1;
    check_rim(&stage, &stage.instances[0].matrix);
    stage.graphics_state.orthographic = true;
    for (int i = 0; i < 3; i++)
        check_rim(&stage, &stage.instances[i].matrix);
    arena_free(&stage.arena);
}

// The corners of the disc form a regular polygon, and all its triangles have the same orientation.
static void test_disc_mesh_is_regular(void **state) {
    (void)state;
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    for (uint32_t segments = 4; segments <= 128; segments += 4) {
        Mesh mesh = mesh_disc(&arena, segments);
        double area = 0, n = segments;
        assert_int_equal(mesh.vertex_count, segments);
        assert_int_equal(mesh.index_count, 3 * (segments - 2));
        for (uint32_t i = 0; i < mesh.index_count; i += 3) {
            const float *a = mesh.vertices[mesh.indices[i]].position, *b = mesh.vertices[mesh.indices[i + 1]].position,
                        *c = mesh.vertices[mesh.indices[i + 2]].position;
            double part = ((double)b[0] - a[0]) * ((double)c[1] - a[1]) - ((double)b[1] - a[1]) * ((double)c[0] - a[0]);
            assert_true(part > 0);
            area += part / 2;
        }
        assert_true(fabs(area - n / 2 * sin(6.283185307179586 / n)) < 1e-5);
    }
    arena_free(&arena);
}

// Reads a scene with `count` references to the same node. Collects the diagnostics.
static Scene *read_many(Arena *arena, DiagSink *diags, NodeKind kind, AttrValue *attr, uint32_t count) {
    DrawNode *node = arena_alloc(arena, sizeof *node), *top = arena_alloc(arena, sizeof *top);
    const DrawNode **children = arena_alloc_array(arena, count, sizeof *children);
    *node = (DrawNode){.kind = (uint8_t)kind, .attrs = attr, .attr_count = 1};
    for (uint32_t i = 0; i < count; i++)
        children[i] = node;
    *top = (DrawNode){.kind = KIND_CANVAS3D, .children = children, .child_count = count};
    return scene_read(arena, top, WIDTH, WIDTH, 16, NULL, diags);
}

// Instances beyond the limits are omitted, which is reported once.
static void test_limits_are_reported_once(void **state) {
    (void)state;
    static const struct {
        NodeKind kind;
        AttrName name;
        uint32_t count;
        uint32_t max;
        const char *code;
    } rows[] = {
        {KIND_SPHERE, ATTR_SIZE, 1000000, SCENE_MAX_INSTANCES, "too-many-models"},
        {KIND_LIGHT, ATTR_COLOR, 5000, SCENE_MAX_LIGHTS, "too-many-lights"},
        {KIND_CAMERA, ATTR_ID, 200, 100, "too-many-cameras"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        Arena arena;
        arena_init(&arena, "test", SIZE_MAX);
        DiagSink diags = diag_sink_new(&arena, 100);
        const SchemaRow *row = schema_row(rows[i].kind, rows[i].name);
        AttrValue attr = {
            .name = (uint16_t)rows[i].name, .row = (uint16_t)(row - schema_rows), .as.numbers = {1, 1, 1}};
        if (rows[i].name == ATTR_ID)
            attr.as.text = STR("c");
        Scene *scene = read_many(&arena, &diags, rows[i].kind, &attr, rows[i].count);
        uint32_t count = rows[i].kind == KIND_SPHERE  ? scene->instance_count
                         : rows[i].kind == KIND_LIGHT ? scene->light_count
                                                      : scene->camera_count;
        assert_int_equal(count, rows[i].max);
        assert_int_equal(diags.count, 1);
        assert_string_equal(diags.items[0].code, rows[i].code);
        if (rows[i].kind == KIND_SPHERE) { // the limit of triangles would be exceeded if all spheres were near
            const SceneBox box = {.low = {-1, -1, -1}, .high = {1, 1, 1}, .triangles = 2048};
            Eye eye = scene_eye(scene, &scene->cameras[0]);
            Matrix view = matrix_view(&eye), projection = matrix_projection(&eye);
            projection.m[0] *= 1e6, view.m[12] = view.m[13] = 0;
            DrawOrder order = draw_order(scene, &eye, &view, &projection, WIDTH, &box);
            assert_true(order.cut && order.triangles <= SCENE_MAX_TRIANGLES && order.count > 10000);
        }
        diag_sink_free(&diags);
        arena_free(&arena);
    }
}

TEST_GROUP(gl_order) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_which_spheres_become_discs), cmocka_unit_test(test_transparent_instances_are_sorted),
        cmocka_unit_test(test_disc_rim_touches_sphere), cmocka_unit_test(test_disc_mesh_is_regular),
        cmocka_unit_test(test_limits_are_reported_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
