// test_canvas_read.c: tests of the translation from nodes to drawing commands: types, keywords and diagnostics.
// tests/pictures checks the appearance.
#include "canvas/read.h"
#include "nodes.h"
#include "schema.h"

static const Symbol *name(Fixture *f, const char *text) {
    return symbol_intern(&f->symbols, str_from(text));
}

static Value numbers(Fixture *f, uint32_t count, const double *x) {
    return value_numbers_view(arena_copy(&f->arena, x, count * sizeof *x), count);
}
#define NUMBERS(f, ...) numbers(f, sizeof((double[]){__VA_ARGS__}) / sizeof(double), (const double[]){__VA_ARGS__})

// Reads a canvas that contains one node with one attribute. Returns NULL if the node was left out.
static const DrawNode *read_one(Fixture *f, const char *kind, const char *attribute, Value v) {
    const Node *inner =
        node_set_attrs(&f->arena, node_new(&f->arena, name(f, kind)), &(Attr){name(f, attribute), v}, 1);
    const Node *canvas = node_append(&f->arena, node_new(&f->arena, name(f, "canvas")), value_node(&f->arena, inner));
    const Node *window = node_append(&f->arena, node_new(&f->arena, name(f, "window")), value_node(&f->arena, canvas));
    f->reported[0] = 0;
    const DrawNode *read = canvas_read(&f->schema, &f->arena, window);
    assert_int_equal(read->child_count, 1);
    return read->children[0]->child_count ? read->children[0]->children[0] : NULL;
}

static void test_attributes_have_types(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    double pair[2];
    const DrawNode *node = read_one(&f, "ellipse", "radius", value_number(3));
    assert_true(draw_pair(node, ATTR_RADIUS, pair) && pair[0] == 3 && pair[1] == 3);
    node = read_one(&f, "paint", "color", NUMBERS(&f, 0.1, 0.2, 0.3));
    assert_true(draw_attr(node, ATTR_COLOR)->as.numbers[2] == 0.3 && draw_attr(node, ATTR_COLOR)->as.numbers[3] == 1);
    node = read_one(&f, "line", "points", NUMBERS(&f, 1, 2, 3, 4));
    assert_int_equal(draw_attr(node, ATTR_POINTS)->count, 4);
    node = read_one(&f, "line", "points", NUMBERS(&f, 1, 2, 3));
    assert_int_equal(draw_attr(node, ATTR_POINTS)->count, 2);
    node = read_one(&f, "rect", "size", NUMBERS(&f, -3, 4));
    assert_true(draw_pair(node, ATTR_SIZE, pair) && pair[0] == -3 && pair[1] == 4);
    node = read_one(&f, "paint", "composite", value_number(symbol_number(STR("lighter"))));
    assert_int_equal(draw_attr(node, ATTR_COMPOSITE)->as.word, COMPOSITE_ADD);
    node = read_one(&f, "paint", "stroke_cap", value_string(&f.arena, STR("square")));
    assert_int_equal(draw_attr(node, ATTR_STROKE_CAP)->as.word, CAP_SQUARE);
    node = read_one(&f, "font", "weight", value_number(symbol_number(STR("bold"))));
    assert_true(draw_number(node, ATTR_FONT_WEIGHT) == 700);
    node = read_one(&f, "text", "text", NUMBERS(&f, 1, 2.5));
    assert_string_equal(draw_attr(node, ATTR_TEXT)->as.text.bytes, "12.5");
    assert_string_equal(f.reported, "");
    end(&f);
}

static void test_bad_attributes_are_reported(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    static const struct {
        const char *kind, *attribute;
        uint32_t count;
        double x[4];
        bool kept; // true if the node was read
        const char *reported;
    } rows[] = {
        {"ellipse",
         "radius",
         1,
         {-1},
         false,
         "!ellipse radius should be one number or two, each 0 or more, not -1 [bad-attribute]\n"},
        {"rect", "size", 3, {1, 2, 3}, true, "!rect size should be one number or two, not 1;2;3 [bad-attribute]\n"},
        {"paint",
         "color",
         2,
         {1, 1},
         true,
         "!paint color should be grey, r;g;b or r;g;b;a, each from 0 to 1, not 1;1 [bad-attribute]\n"},
        {"line", "points", 2, {1, INFINITY}, false, "!line points should be x;y;x;y…, not 1;inf [bad-attribute]\n"},
        {"group", "rotate", 1, {INFINITY}, false, "!group rotate should be number, not inf [bad-attribute]\n"},
        {"group",
         "rotat",
         1,
         {1},
         true,
         "!group unknown attribute 'rotat'; did you mean 'rotate'? [unknown-attribute]\n"},
        {"group", "size", 1, {1}, true, "!group unknown attribute 'size' [unknown-attribute]\n"},
        {"grup",
         "rotate",
         1,
         {1},
         false,
         "!canvas '!grup' is not supported; ignored; did you mean '!group'? [unknown-node]\n"},
        {"stop",
         "offset",
         1,
         {1},
         false,
         "!canvas '!stop' has no effect here; ignored; it belongs in '!gradient' [misplaced-node]\n"},
        {"canvas",
         "size",
         1,
         {1},
         false,
         "!canvas '!canvas' has no effect here; ignored; it belongs in '!window' [misplaced-node]\n"},
        {"font",
         "weight",
         1,
         {5000},
         true,
         "!font weight should be 0 to 1000, or a word such as :bold, not 5000 [bad-attribute]\n"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const DrawNode *node = read_one(&f, rows[i].kind, rows[i].attribute, numbers(&f, rows[i].count, rows[i].x));
        assert_text(rows[i].reported, f.reported, rows[i].reported);
        assert_int_equal(node != NULL, rows[i].kept);
        assert_true(!node || node->attr_count == 0);
    }
    end(&f);
}

// The lint reports colours that look like bytes (up to 255), but not bright HDR colours.
static void test_lint_reports_byte_colours(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    static const char reported[] = "!paint color=0;255;0 is brighter than white (1;1;1); if components go up to 255, "
                                   "divide them: (r;g;b)/255 [colour-range]\n";
    for (int lint = 0; lint <= 1; lint++) {
        f.schema.lint = lint;
        assert_non_null(read_one(&f, "paint", "color", NUMBERS(&f, 0, 255, 0)));
        assert_string_equal(f.reported, lint ? reported : "");
        assert_non_null(read_one(&f, "paint", "color", NUMBERS(&f, 4.5, 3, 1)));
        assert_string_equal(f.reported, "");
        assert_non_null(read_one(&f, "paint", "color", NUMBERS(&f, 1, 1, 1, 1)));
        assert_string_equal(f.reported, "");
    }
    end(&f);
}

// A node that Flitter draws but petri does not is not reported as a misspelled petri node.
static void test_unsupported_nodes(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    assert_null(read_one(&f, "video", "size", value_number(1)));
    assert_string_equal(f.reported, "!canvas '!video' is not supported; ignored [unsupported-node]\n");
    assert_null(read_one(&f, "canvaz", "size", value_number(1)));
    assert_string_equal(f.reported,
                        "!canvas '!canvaz' is not supported; ignored; did you mean '!canvas'? [unknown-node]\n");
    end(&f);
}

TEST_GROUP(canvas_read) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_attributes_have_types),
        cmocka_unit_test(test_bad_attributes_are_reported),
        cmocka_unit_test(test_lint_reports_byte_colours),
        cmocka_unit_test(test_unsupported_nodes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
