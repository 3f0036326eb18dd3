// What the automatic picture shows of space: all that matters, and the same from frame to frame as long as it goes.
#include "check.h"

#include "draw/automatic.h"

#include <math.h>

enum { MOST = 64 };

typedef struct Scene {
    AutoBody bodies[MOST];
    AutoSystem system;
    AutoFrame frame;
} Scene;

static void scene_begin(Scene *scene, uint32_t dimensions) {
    *scene = (Scene){.system = {.dimensions = dimensions}};
    scene->system.bodies = scene->bodies;
}

static void add(Scene *scene, double x, double y, double radius) {
    scene->bodies[scene->system.body_count++] = (AutoBody){.position = {x, y, 0}, .radius = radius};
}

static void choose(Scene *scene) {
    Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    auto_frame(&arena, &scene->frame, &scene->system);
    arena_free(&arena);
}

static bool shows(const Scene *scene, double x, double y) {
    return fabs(x - scene->frame.middle[0]) <= scene->frame.half &&
           fabs(y - scene->frame.middle[1]) <= scene->frame.half;
}

static void test_shows_all(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    add(&scene, -30, 5, 4);
    add(&scene, 100, 40, 1);
    choose(&scene);
    assert_true(shows(&scene, -34, 5));
    assert_true(shows(&scene, 101, 40));
    assert_true(scene.frame.half < 150);
}

static void test_stays(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    add(&scene, -10, 0, 1);
    add(&scene, 10, 0, 1);
    choose(&scene);
    AutoFrame first = scene.frame;
    for (int i = 0; i < 50; i++) { // wobbles, and shrinks to half
        scene.bodies[0].position[0] = -10 + i * 0.1 + sin(i) * 0.3;
        scene.bodies[1].position[1] = cos(i);
        choose(&scene);
        assert_memory_equal(&scene.frame, &first, sizeof first);
    }
    scene.bodies[0].position[0] = -40;
    choose(&scene);
    assert_true(shows(&scene, -41, 0));
    assert_true(scene.frame.half > first.half);
    scene.bodies[0].position[0] = 9;
    choose(&scene);
    assert_true(scene.frame.half < first.half);
}

// One that flies away does not make the others too small to see.
static void test_forgets_the_lost(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 2);
    for (int i = 0; i < 30; i++)
        add(&scene, i % 6, i / 6, 0.5);
    add(&scene, 1e12, -1e12, 0.5);
    choose(&scene);
    assert_true(scene.frame.half < 20);
    assert_true(shows(&scene, 5, 4));
}

static void test_degenerate(void **state) {
    (void)state;
    Scene scene;
    scene_begin(&scene, 3);
    choose(&scene);
    assert_true(scene.frame.half > 0);
    scene_begin(&scene, 2);
    add(&scene, 7, 7, 0);
    choose(&scene);
    assert_true(scene.frame.half > 0 && shows(&scene, 7, 7));
    scene_begin(&scene, 1);
    add(&scene, -1e300, 0, 0);
    add(&scene, 1e300, 0, 0);
    choose(&scene);
    assert_true(isfinite(scene.frame.half) && shows(&scene, 1e300, 0));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shows_all),
        cmocka_unit_test(test_stays),
        cmocka_unit_test(test_forgets_the_lost),
        cmocka_unit_test(test_degenerate),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
