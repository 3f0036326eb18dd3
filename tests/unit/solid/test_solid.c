// test_solid.c: tests of boolean operations on solids.
#include "base/sha256.h"
#include "shapes.h"

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

static Solid combine(Arena *arena, SolidOperation operation, const Solid *a, const Solid *b) {
    Solid result = solid_combine(arena, operation, a, b);
    assert_true(solid_is_closed(arena, &result));
    for (uint32_t i = 0; i < result.face_count; i++)
        for (int k = 0; k < 3; k++)
            assert_true(result.faces[i][k] < result.point_count);
    return result;
}

static void check_result(Arena *arena, SolidOperation operation, const Solid *a, const Solid *b, double volume,
                         int64_t euler) {
    Solid result = combine(arena, operation, a, b);
    int64_t parts, found = solid_euler(arena, &result, &parts);
    if (fabs(solid_volume(&result) - volume) > 1e-4 * (1 + fabs(volume)) || found != euler)
        fail_msg("operation %d: volume %.9g instead of %.9g, Euler characteristic %ld instead of %ld", operation,
                 solid_volume(&result), volume, (long)found, (long)euler);
}

static void test_overlapping_boxes(void **state) {
    Arena *arena = *state;
    Solid a = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 0, 0, 0),
          b = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 1, 0.5, 0.25);
    double common = 1 * 1.5 * 1.75;
    check_result(arena, SOLID_UNION, &a, &b, 16 - common, 2);
    check_result(arena, SOLID_INTERSECTION, &a, &b, common, 2);
    check_result(arena, SOLID_DIFFERENCE, &a, &b, 8 - common, 2);
}

static void test_coplanar_and_touching_boxes(void **state) {
    Arena *arena = *state;
    Solid a = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 0, 0, 0),
          shifted = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 1, 0, 0),
          next = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 2, 0, 0),
          small = solid_placed(arena, SHAPE_BOX, 4, 0.5, 0, 0, 0, 1.5),
          diagonal = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 2, 2, 0);
    check_result(arena, SOLID_UNION, &a, &shifted, 12, 2);
    check_result(arena, SOLID_INTERSECTION, &a, &shifted, 4, 2);
    check_result(arena, SOLID_DIFFERENCE, &a, &shifted, 4, 2);
    check_result(arena, SOLID_UNION, &a, &next, 16, 2);
    check_result(arena, SOLID_INTERSECTION, &a, &next, 0, 0);
    check_result(arena, SOLID_DIFFERENCE, &a, &next, 8, 2);
    check_result(arena, SOLID_UNION, &a, &small, 9, 2);
    check_result(arena, SOLID_DIFFERENCE, &a, &small, 8, 2);
    check_result(arena, SOLID_UNION, &a, &a, 8, 2);
    check_result(arena, SOLID_INTERSECTION, &a, &a, 8, 2);
    check_result(arena, SOLID_DIFFERENCE, &a, &a, 0, 0);
    Solid result = combine(arena, SOLID_UNION, &a, &diagonal);
    assert_true(fabs(solid_volume(&result) - 16) < 1e-4);
}

static void test_nested_and_separate_solids(void **state) {
    Arena *arena = *state;
    Solid outer = solid_placed(arena, SHAPE_BOX, 4, 1, 0.1, 0, 0, 0),
          inner = solid_placed(arena, SHAPE_BOX, 4, 0.5, 0.2, 0, 0, 0),
          far = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 5, 0, 0);
    check_result(arena, SOLID_UNION, &outer, &inner, 8, 2);
    check_result(arena, SOLID_INTERSECTION, &outer, &inner, 1, 2);
    check_result(arena, SOLID_DIFFERENCE, &outer, &inner, 7, 4);
    check_result(arena, SOLID_DIFFERENCE, &inner, &outer, 0, 0);
    check_result(arena, SOLID_UNION, &outer, &far, 16, 4);
    check_result(arena, SOLID_INTERSECTION, &outer, &far, 0, 0);
    check_result(arena, SOLID_DIFFERENCE, &outer, &far, 8, 2);
}

static void test_drilled_box_has_handles(void **state) {
    Arena *arena = *state;
    Solid box = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 0, 0, 0);
    for (int flush = 0; flush < 2; flush++) { // with flush=1, the caps of the drill are in the faces of the box
        Shape shape = shape_new(arena, SHAPE_CYLINDER, 32);
        shape_place(&shape, (double[3]){0.5, 0.5, flush ? 1 : 1.5}, 0, (double[3]){0, 0, 0});
        Solid drill = shape_solid(arena, &shape);
        double area = 16 * 0.25 * maths_sin(6.283185307179586 / 32);
        check_result(arena, SOLID_DIFFERENCE, &box, &drill, 8 - 2 * area, 0);
    }
}

static void test_operations_keep_only_their_results(void **state) {
    enum { ROUNDING = 64 };
    Arena *arena = *state;
    Solid a = solid_placed(arena, SHAPE_SPHERE, 32, 1, 0, 0, 0, 0),
          b = solid_placed(arena, SHAPE_SPHERE, 32, 1, 0, 0.5, 0, 0);
    for (int i = 0; i < 3; i++) {
        size_t used = arena->used;
        Solid result = solid_combine(arena, (SolidOperation)i, &a, &b);
        size_t size = result.point_count * sizeof *result.points + result.face_count * sizeof *result.faces;
        assert_true(size > 1000);
        assert_true(arena->used - used <= size + ROUNDING);
    }
}

static void test_identical_spheres(void **state) {
    Arena *arena = *state;
    Solid a = solid_placed(arena, SHAPE_SPHERE, 32, 1, 0.13, 0.1, 0.2, 0.3);
    double volume = solid_volume(&a);
    check_result(arena, SOLID_UNION, &a, &a, volume, 2);
    check_result(arena, SOLID_INTERSECTION, &a, &a, volume, 2);
    check_result(arena, SOLID_DIFFERENCE, &a, &a, 0, 0);
}

static void test_trim_keeps_lower_side(void **state) {
    Arena *arena = *state;
    Solid box = solid_placed(arena, SHAPE_BOX, 4, 1, 0, 0.5, 0, 0);
    static const struct {
        double origin[3];
        double normal[3];
        double volume;
    } cases[] = {{{0.5, 0, 0}, {1, 0, 0}, 4},     {{0.5, 0, 0}, {-3, 0, 0}, 4}, {{0.5, 0, 0}, {1, 1, 1}, 4},
                 {{0, 0, 0.5}, {0, 0, 1e-9}, 6},  {{0, 0, 1}, {0, 0, 1}, 8},    {{0, 0, -1}, {0, 0, 1}, 0},
                 {{0, 0, 1e9}, {0, 0, 1}, 8},     {{0, 0, -1e9}, {0, 0, 1}, 0}, {{0, 0, 0}, {0, 0, 0}, 8},
                 {{0, 0, 0}, {INFINITY, 0, 0}, 8}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Solid result = solid_trim(arena, shape_grid(), &box, cases[i].origin, cases[i].normal);
        assert_true(solid_is_closed(arena, &result));
        if (fabs(solid_volume(&result) - cases[i].volume) > 1e-4)
            fail_msg("case %zu: volume %g instead of %g", i, solid_volume(&result), cases[i].volume);
    }
}

static void test_open_mesh_is_not_closed(void **state) {
    Arena *arena = *state;
    Shape shape = shape_new(arena, SHAPE_CYLINDER, 8);
    Solid solid;
    uint32_t count = shape.index_count - 3;
    assert_false(solid_from_mesh(arena, shape_grid(), (const double(*)[3])shape.points, shape.point_count,
                                 shape.indices, count, &solid));
    assert_int_equal(solid.face_count, count / 3);
    assert_true(solid_repair(arena, &solid));
    assert_true(solid_is_closed(arena, &solid));
    int64_t parts;
    assert_int_equal(solid_euler(arena, &solid, &parts), 2);
    assert_int_equal(parts, 1);
}

// A tree of operations on shapes, with enough data to decide whether a point is inside.
enum { TREE_LEAVES = 4 };
typedef struct Tree {
    Shape leaves[TREE_LEAVES];
    SolidOperation operations[TREE_LEAVES - 1]; // (((0 op 1) op 2) op 3)
    Solid solid;
} Tree;

static uint64_t next_random(uint64_t *seed) {
    uint64_t x = *seed += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static double random_number(uint64_t *seed, double low, double high) {
    return low + (high - low) * (double)(next_random(seed) & 0xffff) / 0xffff;
}

// In half of the trees, sizes and positions are multiples of 0.5 and nothing is rotated, so that many faces coincide.
static Tree random_tree(Arena *arena, uint64_t seed) {
    Tree tree;
    bool aligned = seed & 1;
    seed *= 1000003;
    for (int i = 0; i < TREE_LEAVES; i++) {
        ShapeKind kind = (ShapeKind)(next_random(&seed) % SHAPE_KINDS);
        tree.leaves[i] = shape_new(arena, kind, 4 + 4 * (uint32_t)(next_random(&seed) % 4));
        double size[3], centre[3], turns = aligned ? 0 : random_number(&seed, 0, 1);
        for (int k = 0; k < 3; k++) {
            size[k] = random_number(&seed, 0.3, 1.5);
            centre[k] = random_number(&seed, -1, 1);
            if (aligned) {
                size[k] = 0.5 + 0.5 * (double)(next_random(&seed) % 2);
                centre[k] = 0.5 * (double)(next_random(&seed) % 5) - 1;
            }
        }
        shape_place(&tree.leaves[i], size, turns, centre);
        Solid leaf = shape_solid(arena, &tree.leaves[i]);
        if (i == 0) {
            tree.solid = leaf;
            continue;
        }
        SolidOperation operation = (SolidOperation)(next_random(&seed) % 3);
        tree.operations[i - 1] = operation;
        Solid both = combine(arena, SOLID_UNION, &tree.solid, &leaf),
              common = combine(arena, SOLID_INTERSECTION, &tree.solid, &leaf),
              rest = combine(arena, SOLID_DIFFERENCE, &tree.solid, &leaf);
        double a = solid_volume(&tree.solid), b = solid_volume(&leaf), c = solid_volume(&common);
        if (fabs(solid_volume(&both) + c - a - b) > 1e-4 || fabs(solid_volume(&rest) + c - a) > 1e-4)
            fail_msg("volumes %g and %g: union %g, intersection %g, difference %g", a, b, solid_volume(&both), c,
                     solid_volume(&rest));
        tree.solid = operation == SOLID_UNION ? both : operation == SOLID_INTERSECTION ? common : rest;
    }
    return tree;
}

// All shapes are convex.
static bool in_shape(const Shape *shape, const double p[3]) {
    for (uint32_t i = 0; i < shape->index_count; i += 3) {
        const double *a = shape->points[shape->indices[i]], *b = shape->points[shape->indices[i + 1]],
                     *c = shape->points[shape->indices[i + 2]];
        double u[3], v[3], w[3];
        for (int k = 0; k < 3; k++)
            u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = p[k] - a[k];
        if (w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
                w[2] * (u[0] * v[1] - u[1] * v[0]) >
            0)
            return false;
    }
    return true;
}

static bool in_tree(const Tree *tree, const double p[3]) {
    bool inside = in_shape(&tree->leaves[0], p);
    for (int i = 1; i < TREE_LEAVES; i++) {
        bool other = in_shape(&tree->leaves[i], p);
        inside = tree->operations[i - 1] == SOLID_UNION          ? inside || other
                 : tree->operations[i - 1] == SOLID_INTERSECTION ? inside && other
                                                                 : inside && !other;
    }
    return inside;
}

static void test_random_trees(void **state) {
    enum { TREES = 1000, SAMPLES = 4000 };
    const double side = 7;
    Arena *arena = *state;
    Sha256 hash = sha256_new();
    int64_t handles = 0;
    for (uint64_t t = 0; t < TREES; t++) {
        arena_reset(arena);
        Tree tree = random_tree(arena, t);
        uint64_t seed = ~t;
        int inside = 0;
        for (int i = 0; i < SAMPLES; i++) {
            double p[3];
            for (int k = 0; k < 3; k++)
                p[k] = random_number(&seed, -side / 2, side / 2);
            inside += in_tree(&tree, p);
        }
        double all = side * side * side, volume = solid_volume(&tree.solid), sampled = all * inside / SAMPLES;
        double part = volume / all, deviation = all * sqrt((part + 1.0 / SAMPLES) * (1 - part) / SAMPLES);
        if (fabs(volume - sampled) > 5 * deviation)
            fail_msg("tree %u: volume %g, sampled volume %g, deviation %g", (unsigned)t, volume, sampled, deviation);
        int64_t parts, euler = solid_euler(arena, &tree.solid, &parts);
        if (euler % 2 != 0 || euler > 2 * parts)
            fail_msg("tree %u: Euler characteristic %ld of %ld surfaces", (unsigned)t, (long)euler, (long)parts);
        handles += parts - euler / 2;
        sha256_add(&hash, (const char *)tree.solid.points, tree.solid.point_count * sizeof *tree.solid.points);
        sha256_add(&hash, (const char *)tree.solid.faces, tree.solid.face_count * sizeof *tree.solid.faces);
    }
    assert_int_equal(handles, 50);
    char digits[SHA256_DIGITS + 1] = {0};
    sha256_end(&hash, digits);
    assert_string_equal(digits, "b4d09f9737e421be686273d985b194539af7e52e3d6905cc24c8bec62e712dea");
}

TEST_GROUP(solid) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_overlapping_boxes, setup, teardown),
        cmocka_unit_test_setup_teardown(test_coplanar_and_touching_boxes, setup, teardown),
        cmocka_unit_test_setup_teardown(test_nested_and_separate_solids, setup, teardown),
        cmocka_unit_test_setup_teardown(test_drilled_box_has_handles, setup, teardown),
        cmocka_unit_test_setup_teardown(test_operations_keep_only_their_results, setup, teardown),
        cmocka_unit_test_setup_teardown(test_identical_spheres, setup, teardown),
        cmocka_unit_test_setup_teardown(test_trim_keeps_lower_side, setup, teardown),
        cmocka_unit_test_setup_teardown(test_open_mesh_is_not_closed, setup, teardown),
        cmocka_unit_test_setup_teardown(test_random_trees, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
