// test_field.c: tests of the surfaces of distance fields.
#include "base/sha256.h"
#include "shapes.h"
#include "solid/field.h"

static int setup(void **state) {
    static Arena arena;
    arena_init(&arena, "test", SIZE_MAX);
    *state = &arena;
    return 0;
}

static int teardown(void **state) {
    arena_free(*state);
    return 0;
}

static Field primitive(FieldKind kind, double x) {
    return (Field){.kind = kind, .scale = 1, .inverse = {1, 0, 0, -x, 0, 1, 0, 0, 0, 0, 1, 0}};
}

static Field operation(FieldKind kind, Field **children, uint32_t count) {
    Field field = primitive(kind, 0);
    field.children = children;
    field.child_count = count;
    return field;
}

static FieldSurface surface_of(Arena *arena, const Field *field, double size, double cell) {
    FieldSurface surface;
    assert_true(
        field_surface(arena, field, (double[3]){-size, -size, -size}, (double[3]){size, size, size}, cell, &surface));
    return surface;
}

// Checks that the surface is closed, and that its volume differs from the expected one by less than 5 %.
static void check_volume(Arena *arena, const Field *field, double size, double expected) {
    FieldSurface surface = surface_of(arena, field, size, 0.05);
    Solid solid;
    assert_true(solid_from_mesh(arena, shape_grid(), (const double(*)[3])surface.points, surface.point_count,
                                surface.indices, surface.index_count, &solid));
    if (fabs(solid_volume(&solid) - expected) > 0.05 * expected)
        fail_msg("kind %d: volume %g instead of %g", field->kind, solid_volume(&solid), expected);
}

static void test_volumes_of_primitives(void **state) {
    static const double volumes[] = {
        [FIELD_BOX] = 1, [FIELD_SPHERE] = 4.18879, [FIELD_CYLINDER] = 3.14159, [FIELD_CONE] = 1.0472};
    for (FieldKind kind = FIELD_BOX; kind <= FIELD_CONE; kind++) {
        Field field = primitive(kind, 0);
        check_volume(*state, &field, 1.5, volumes[kind]);
    }
}

static void test_volumes_of_operations(void **state) {
    Field a = primitive(FIELD_BOX, 0), b = primitive(FIELD_BOX, 0.5), *both[] = {&a, &b};
    static const double volumes[] = {
        [FIELD_UNION] = 1.5, [FIELD_INTERSECTION] = 0.5, [FIELD_DIFFERENCE] = 0.5, [FIELD_TRIM] = 0.75};
    for (FieldKind kind = FIELD_UNION; kind <= FIELD_TRIM; kind++) {
        Field field = operation(kind, both, 2);
        field.normal[0] = 1;
        field.origin[0] = 0.25;
        check_volume(*state, &field, 1.5, volumes[kind]);
    }
}

static void test_mix_has_weighted_radius(void **state) {
    static const double weights[] = {1, 3};
    Field a = primitive(FIELD_SPHERE, 0), b = primitive(FIELD_SPHERE, 0), *both[] = {&a, &b};
    b.inverse[0] = b.inverse[5] = b.inverse[10] = 2;
    b.scale = 0.5;
    Field field = operation(FIELD_MIX, both, 2);
    field.weights = weights;
    field.weight_count = 2;
    check_volume(*state, &field, 1.5, 4.18879 * 0.625 * 0.625 * 0.625);
}

static void test_blends_add_material(void **state) {
    Field a = primitive(FIELD_SPHERE, -0.8), b = primitive(FIELD_SPHERE, 0.8), *both[] = {&a, &b};
    Field plain = operation(FIELD_UNION, both, 2), blend = plain;
    Solid solid;
    double volumes[4];
    for (int i = 0; i < 4; i++) {
        blend.smooth = i == 1 ? 0.5 : 0;
        blend.fillet = i == 2 ? 0.5 : 0;
        blend.chamfer = i == 3 ? 0.5 : 0;
        FieldSurface surface = surface_of(*state, &blend, 2, 0.05);
        assert_true(solid_from_mesh(*state, shape_grid(), (const double(*)[3])surface.points, surface.point_count,
                                    surface.indices, surface.index_count, &solid));
        volumes[i] = solid_volume(&solid);
        assert_true(i == 0 || (volumes[i] > volumes[0] + 0.05 && volumes[i] < volumes[0] + 1.5));
    }
}

static void test_body_is_cut_off_at_box(void **state) {
    Field field = primitive(FIELD_SPHERE, 0);
    check_volume(*state, &field, 0.5, 1);
}

static void test_limits_of_resolution(void **state) {
    Field field = primitive(FIELD_SPHERE, 0);
    FieldSurface surface;
    const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1}, reversed[3] = {-2, -2, -2};
    assert_false(field_surface(*state, &field, low, high, 1e-9, &surface));
    assert_false(field_surface(*state, &field, low, high, 0, &surface));
    assert_false(field_surface(*state, &field, low, high, NAN, &surface));
    assert_true(field_surface(*state, &field, low, reversed, 0.1, &surface));
    assert_int_equal(surface.index_count, 0);
    field.inverse[3] = NAN;
    assert_true(field_surface(*state, &field, low, high, 0.1, &surface));
    assert_int_equal(surface.index_count, 0);
}

// Computes the distances of a sphere with radius 1. `function` counts the points; above 10^5, the function fails.
static bool sphere_function(void *user_data, void *function, const double (*points)[3], uint32_t count,
                            double *distances) {
    uint32_t *total = function;
    assert_string_equal(user_data, "user data");
    for (uint32_t i = 0; i < count; i++) {
        const double *p = points[i];
        distances[i] = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1;
    }
    return (*total += count) < 100000;
}

static void test_function_replaces_primitive(void **state) {
    static char text[] = "user data";
    const double low[] = {-1.5, -1.5, -1.5}, high[] = {1.5, 1.5, 1.5};
    uint32_t total = 0;
    Field a = primitive(FIELD_SPHERE, 0.25), b = primitive(FIELD_BOX, -0.5), *both[] = {&a, &b};
    Field field = operation(FIELD_UNION, both, 2);
    field.inverse[0] = 0.5;
    FieldSurface one = surface_of(*state, &field, 1.5, 0.125);
    a.kind = FIELD_FUNCTION;
    a.function = &total;
    field_sample_functions(*state, &field, low, high, 0.125, sphere_function, text);
    assert_int_equal(total, 27 * 27 * 27);
    assert_int_equal(a.sample_count, total);
    FieldSurface two = surface_of(*state, &field, 1.5, 0.125);
    assert_int_equal(two.point_count, one.point_count);
    assert_memory_equal(two.indices, one.indices, one.index_count * sizeof *one.indices);
    assert_memory_equal(two.points, one.points, one.point_count * sizeof *one.points);
}

static void test_failing_function_is_outside(void **state) {
    static char text[] = "user data";
    const double low[] = {-2, -2, -2}, high[] = {2, 2, 2};
    uint32_t total = 99000;
    Field field = primitive(FIELD_FUNCTION, 0);
    field.function = &total;
    field_sample_functions(*state, &field, low, high, 0.1, sphere_function, text);
    assert_in_range(total, 100000, 102000); // no points after the failure
    assert_null(field.samples);
    assert_int_equal(surface_of(*state, &field, 2, 0.1).point_count, 0);
    total = 0;
    field_sample_functions(*state, &field, low, high, 1e-9, sphere_function, text);
    assert_int_equal(total, 0); // too many cells
}

static void test_surface_has_same_bits_everywhere(void **state) {
    Field a = primitive(FIELD_SPHERE, -0.5), b = primitive(FIELD_CONE, 0.5), *both[] = {&a, &b};
    Field field = operation(FIELD_UNION, both, 2);
    field.smooth = 0.3;
    FieldSurface surface = surface_of(*state, &field, 2, 0.07);
    char digits[SHA256_DIGITS + 1] = {0};
    Sha256 hash = sha256_new();
    sha256_add(&hash, (const char *)surface.points, surface.point_count * sizeof *surface.points);
    sha256_add(&hash, (const char *)surface.indices, surface.index_count * sizeof *surface.indices);
    sha256_end(&hash, digits);
    assert_string_equal(digits, "cc449e68d5997fbcc8ba40bb385bcb969ecdbd71e742c7c1565a25b9b5fb931f");
}

TEST_GROUP(field) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_volumes_of_primitives, setup, teardown),
        cmocka_unit_test_setup_teardown(test_volumes_of_operations, setup, teardown),
        cmocka_unit_test_setup_teardown(test_mix_has_weighted_radius, setup, teardown),
        cmocka_unit_test_setup_teardown(test_blends_add_material, setup, teardown),
        cmocka_unit_test_setup_teardown(test_body_is_cut_off_at_box, setup, teardown),
        cmocka_unit_test_setup_teardown(test_limits_of_resolution, setup, teardown),
        cmocka_unit_test_setup_teardown(test_function_replaces_primitive, setup, teardown),
        cmocka_unit_test_setup_teardown(test_failing_function_is_outside, setup, teardown),
        cmocka_unit_test_setup_teardown(test_surface_has_same_bits_everywhere, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
