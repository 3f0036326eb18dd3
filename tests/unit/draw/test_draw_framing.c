// test_draw_framing.c: tests of the automatic picture's view, which shows all relevant bodies and only grows, and of
// its scale bar.
#include "check.h"
#include "picture/automatic.h"

#include <math.h>

enum { MAX_BODIES = 64 };

typedef struct Scene {
    AutoBody bodies[MAX_BODIES];
    AutoSystem system;
    AutoFrame frame;
} Scene;

static void scene_begin(Scene *scene, uint32_t dimensions) {
    *scene = (Scene){.system = {.dimensions = dimensions}};
    scene->system.bodies = scene->bodies;
}

static void add_body(Scene *scene, double x, double y, double radius) {
    scene->bodies[scene->system.body_count++] = (AutoBody){.position = {x, y, 0}, .radius = radius};
}

static void choose_frame(Scene *scene) {
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    auto_frame(&arena, &scene->frame, &scene->system);
    arena_free(&arena);
}

static bool shows(const Scene *scene, double x, double y) {
    return fabs(x - scene->frame.middle[0]) <= scene->frame.half &&
           fabs(y - scene->frame.middle[1]) <= scene->frame.half;
}

static void test_view_shows_all_bodies(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    add_body(&scene, -30, 5, 4);
    add_body(&scene, 100, 40, 1);
    choose_frame(&scene);
    assert_true(shows(&scene, -34, 5));
    assert_true(shows(&scene, 101, 40));
    assert_true(scene.frame.half < 150);
}

static void test_view_only_grows(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    add_body(&scene, -10, 0, 1);
    add_body(&scene, 10, 0, 1);
    choose_frame(&scene);
    AutoFrame first = scene.frame;
    for (int i = 0; i < 50; i++) { // the bodies move to and fro, and their extent shrinks to half
        scene.bodies[0].position[0] = -10 + i * 0.1 + sin(i) * 0.3;
        scene.bodies[1].position[1] = cos(i);
        choose_frame(&scene);
        assert_memory_equal(&scene.frame, &first, sizeof first);
    }
    scene.bodies[0].position[0] = -40;
    choose_frame(&scene);
    AutoFrame grown = scene.frame;
    assert_true(shows(&scene, -41, 0));
    assert_true(grown.half > first.half && grown.half < 1.6 * 41 && grown.middle[0] == first.middle[0]);
    scene.bodies[0].position[0] = 9;
    choose_frame(&scene);
    assert_memory_equal(&scene.frame, &grown, sizeof grown);
}

// The view does not follow a single body, so that its motion from the origin is visible.
static void test_view_does_not_follow_lone_body(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    add_body(&scene, 0, 0, 1);
    scene.bodies[0].velocity[0] = 60;
    scene.bodies[0].velocity[1] = 30;
    choose_frame(&scene);
    AutoFrame first = scene.frame;
    assert_true(shows(&scene, 0, 0) && shows(&scene, 120, 60) && first.half < 120);
    scene.bodies[0].position[0] = 120;
    scene.bodies[0].position[1] = 60;
    choose_frame(&scene);
    assert_memory_equal(&scene.frame, &first, sizeof first);
    scene.bodies[0].position[0] = 1200;
    choose_frame(&scene);
    assert_true(shows(&scene, 1200, 60) && shows(&scene, 0, 0));
    scene_begin(&scene, 2); // a body at rest does not fill the view
    add_body(&scene, 0, 0, 10);
    choose_frame(&scene);
    assert_true(scene.frame.half >= 80);
}

static void test_scale_bar_has_round_length(void **state) {
    (void)state;
    static const struct { double half, length; } rows[] = {{1, 0.2}, {12, 5}, {160, 50}, {1e9, 2e8}, {3e-7, 1e-7}};
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Arena arena;
        AutoSystem system = {.dimensions = 2, .frame.half = rows[i].half};
        arena_init(&arena, "test", SIZE_MAX);
        auto_scale(&arena, &system);
        const double unit = AUTO_PANEL / 2 * (1 - 2 * AUTO_MARGIN) / rows[i].half;
        assert_true(system.scale_count > 3);
        assert_true(fabs((system.scale[0].x2 - system.scale[0].x1) / unit / rows[i].length - 1) < 1e-9);
        for (uint32_t k = 0; k < system.scale_count; k++)
            assert_true(system.scale[k].x1 >= 0 && system.scale[k].x2 < AUTO_PANEL / 2 && system.scale[k].y1 >= 0);
        arena_free(&arena);
    }
}

// A body that flies away does not make the others too small to see.
static void test_view_ignores_distant_body(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    for (int i = 0; i < 30; i++)
        add_body(&scene, i % 6, i / 6, 0.5);
    add_body(&scene, 1e12, -1e12, 0.5);
    choose_frame(&scene);
    assert_true(scene.frame.half < 20);
    assert_true(shows(&scene, 5, 4));
}

// Distances are measured from the median, here 0: one more body is there than at -1000. From -1000, the last body would
// be too far away to be shown.
static void test_view_is_centred_on_the_median(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    add_body(&scene, 0, 0, 1);
    for (int i = 0; i < 31; i++)
        add_body(&scene, i < 16 ? -1000 : 0, 0, 1);
    add_body(&scene, 7500, 0, 1);
    choose_frame(&scene);
    assert_true(shows(&scene, 7500, 0));
}

static void test_view_of_degenerate_systems(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 3); // the first frame with bodies determines the view
    choose_frame(&scene);
    assert_true(scene.frame.half == 0);
    scene_begin(&scene, 3);
    add_body(&scene, 0, 0, 3);
    scene.bodies[0].velocity[0] = INFINITY;
    choose_frame(&scene);
    assert_true(scene.frame.half > 0 && isfinite(scene.frame.half));
    scene_begin(&scene, 2);
    add_body(&scene, 7, 7, 0);
    choose_frame(&scene);
    assert_true(scene.frame.half > 0 && shows(&scene, 7, 7));
    scene_begin(&scene, 1);
    add_body(&scene, -1e300, 0, 0);
    add_body(&scene, 1e300, 0, 0);
    choose_frame(&scene);
    assert_true(isfinite(scene.frame.half) && shows(&scene, 1e300, 0));
}

TEST_GROUP(draw_framing) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_view_shows_all_bodies),          cmocka_unit_test(test_view_only_grows),
        cmocka_unit_test(test_view_does_not_follow_lone_body), cmocka_unit_test(test_scale_bar_has_round_length),
        cmocka_unit_test(test_view_ignores_distant_body),      cmocka_unit_test(test_view_is_centred_on_the_median),
        cmocka_unit_test(test_view_of_degenerate_systems),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
