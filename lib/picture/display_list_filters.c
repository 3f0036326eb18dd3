// display_list_filters.c: translates filter and path effect nodes, which apply to the siblings after them (spec
// canvas.md 6, 7).
#include "gl/colour_formulas.h"
#include "maths/maths.h"
#include "picture/display_list_build.h"

#include <math.h>
#include <string.h>

// Maximum depth of nested filters or effects. It is less than NODE_MAX_HEIGHT, because the stack can be small.
enum { MAX_DEPTH = 100 };

// Sets a colour matrix from brightness, contrast and saturation.
static void set_adjustment(const DrawNode *node, double m[4][5]) {
    static const double luminance[3] = {LUMINANCE_WEIGHTS};
    double contrast = draw_number(node, ATTR_CONTRAST), saturation = draw_number(node, ATTR_SATURATION);
    for (int row = 0; row < 3; row++) {
        for (int k = 0; k < 3; k++)
            m[row][k] = contrast * (saturation * (row == k) + (1 - saturation) * luminance[k]);
        m[row][4] = draw_number(node, ATTR_BRIGHTNESS) + (1 - contrast) / 2;
    }
}

static bool set_rows(const DrawNode *node, double m[4][5]) {
    static const AttrName rows[4] = {ATTR_RED, ATTR_GREEN, ATTR_BLUE, ATTR_ALPHA};
    bool any = false;
    for (int row = 0; row < 4; row++) {
        const AttrValue *attr = draw_attr(node, rows[row]);
        any |= attr != NULL;
        if (attr)
            memcpy(m[row], attr->as.list, sizeof m[row]);
    }
    return any;
}

// These functions write a filter or effect without those inside it. They return false if a required attribute is
// missing. `kind` is that of the filter.
static bool write_matrix(DisplayListBuild *build, const DrawNode *node, int kind) {
    double m[4][5] = {{1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}, {0, 0, 1, 0, 0}, {0, 0, 0, 1, 0}};
    const AttrValue *all = draw_attr(node, ATTR_MATRIX), *scale = draw_attr(node, ATTR_SCALE),
                    *offset = draw_attr(node, ATTR_OFFSET);
    if (all) {
        memcpy(m, all->as.list, sizeof m);
    } else if (!set_rows(node, m)) {
        bool plain = scale || offset;
        for (int k = 0; k < 3 && plain; k++) {
            m[k][k] = scale ? scale->as.numbers[k] : 1;
            m[k][4] = offset ? offset->as.numbers[k] : 0;
        }
        if (!plain)
            set_adjustment(node, m);
    }
    DISPLAY_WRITE_ROW(build->list, FILTER_COLOUR_MATRIX, .kind = kind, .elements = m[0]);
    return true;
}

static bool write_blend(DisplayListBuild *build, const DrawNode *node, int kind) {
    const AttrValue *all = draw_attr(node, ATTR_COEFFICIENTS), *ratio = draw_attr(node, ATTR_RATIO);
    double r = ratio ? fmin(fmax(ratio->as.numbers[0], 0), 1) : 0;
    const double mixed[4] = {0, ratio ? 1 - r : 0, r, 0};
    DISPLAY_WRITE_ROW(build->list, FILTER_BLEND, .kind = kind, .mode = all || ratio ? -1 : draw_word(node, ATTR_MODE),
                      .factors = all ? all->as.numbers : mixed);
    return true;
}

static bool write_nothing(DisplayListBuild *build, const DrawNode *node, int kind) {
    (void)node;
    DISPLAY_WRITE_ROW(build->list, FILTER_SOURCE, .kind = kind);
    return true;
}

static bool write_radius(DisplayListBuild *build, const DrawNode *node, int kind) {
    double radius[2];
    bool good = draw_pair(node, ATTR_RADIUS, radius);
    DISPLAY_WRITE_ROW(build->list, FILTER_BLUR, .kind = kind, .radius = radius);
    return good;
}

static bool write_offset(DisplayListBuild *build, const DrawNode *node, int kind) {
    double offset[2];
    bool good = draw_pair(node, ATTR_OFFSET, offset);
    DISPLAY_WRITE_ROW(build->list, FILTER_OFFSET, .kind = kind, .offset = offset);
    return good;
}

static bool write_shadow(DisplayListBuild *build, const DrawNode *node, int kind) {
    static const double black[4] = {0, 0, 0, 1};
    const AttrValue *color = draw_attr(node, ATTR_COLOR);
    double radius[2], offset[2], colour[4];
    bool good = draw_pair(node, ATTR_RADIUS, radius);
    draw_pair(node, ATTR_OFFSET, offset);
    display_list_build_stop_color(build, color ? color->as.numbers : black, colour);
    DISPLAY_WRITE_ROW(build->list, FILTER_SHADOW, .kind = kind, .radius = radius, .offset = offset, .colour = colour,
                      .only = draw_flag(node, ATTR_SHADOW_ONLY));
    return good;
}

static bool write_paint(DisplayListBuild *build, const DrawNode *node, int kind) {
    GraphicsState own = *build->state;
    display_list_build_read_state(&own, node);
    DISPLAY_WRITE_ROW(build->list, FILTER_PAINT, .kind = kind);
    uint32_t start = display_list_open(build->list);
    display_list_build_colour(build, &own, NULL);
    display_list_close(build->list, start);
    return true;
}

typedef struct FilterRow {
    int kind;
    uint32_t inputs; // number of filters inside it: at most 1, or exactly 2
    bool (*write)(DisplayListBuild *build, const DrawNode *node, int kind);
} FilterRow;

static const FilterRow filter_rows[KIND_COUNT] = {
#define FILTER(id, name, writer, children, inputs, help)                                                               \
    [KIND_FILTER_##id] = {PETRI_FILTER_##id, inputs, write_##writer},
#include "schema/schema_list.h"
};

// Writes what is inside a filter or effect with `write`; if there is nothing, the number `source`.
static bool write_children(DisplayListBuild *build, const DrawNode *node, int source,
                           bool (*write)(DisplayListBuild *build, const DrawNode *node)) {
    bool good = build->depth < MAX_DEPTH;
    build->depth++;
    for (uint32_t i = 0; i < node->child_count && good; i++)
        good = write(build, node->children[i]);
    build->depth--;
    if (node->child_count == 0)
        display_list_add_number(build->list, source);
    return good;
}

bool display_list_build_filter(DisplayListBuild *build, const DrawNode *node) {
    const FilterRow *row = &filter_rows[node->kind];
    if (node->child_count > row->inputs || (row->inputs == 2 && node->child_count < 2))
        return false;
    display_list_add_note(build->list, node->origin, (Str){0});
    return row->write(build, node, row->kind) &&
           (row->inputs == 0 || write_children(build, node, PETRI_FILTER_SOURCE, display_list_build_filter));
}

static bool write_dash(DisplayListBuild *build, const DrawNode *node) {
    const AttrValue *intervals = draw_attr(node, ATTR_INTERVALS);
    double sum = 0;
    if (!intervals || intervals->count < 2 || intervals->count % 2)
        return false;
    for (uint32_t i = 0; i < intervals->count; i++) {
        if (intervals->as.list[i] < 0)
            return false;
        sum += intervals->as.list[i];
    }
    DISPLAY_WRITE_ROW(build->list, EFFECT_DASH, .kind = PETRI_EFFECT_DASH, .offset = draw_number(node, ATTR_OFFSET),
                      .dashes = {intervals->as.list, intervals->count});
    return sum > 0 && isfinite(sum);
}

static bool write_round_corners(DisplayListBuild *build, const DrawNode *node) {
    double radius = draw_number(node, ATTR_RADIUS);
    DISPLAY_WRITE_ROW(build->list, EFFECT_ROUND_CORNERS, .kind = PETRI_EFFECT_ROUND_CORNERS, .radius = radius);
    return radius > 0;
}

static bool write_jitter(DisplayListBuild *build, const DrawNode *node) {
    double length = draw_number(node, ATTR_LENGTH);
    DISPLAY_WRITE_ROW(build->list, EFFECT_JITTER, .kind = PETRI_EFFECT_JITTER, .length = length,
                      .deviation = draw_number(node, ATTR_DEVIATION), .seed = draw_number(node, ATTR_SEED));
    return length > 0 && draw_attr(node, ATTR_DEVIATION);
}

// Writes the row-major matrix of a path effect. If the node has no matrix, creates one that scales, then rotates, then
// translates points.
static bool write_path_matrix(DisplayListBuild *build, const DrawNode *node) {
    const AttrValue *all = draw_attr(node, ATTR_MATRIX);
    double scale[2], move[2], angle = draw_number(node, ATTR_ROTATE);
    angle = (angle - floor(angle)) * 6.283185307179586;
    double c = maths_cos(angle), s = maths_sin(angle);
    if (!draw_pair(node, ATTR_SCALE, scale))
        scale[0] = scale[1] = 1;
    draw_pair(node, ATTR_TRANSLATE, move);
    const double own[9] = {c * scale[0], -s * scale[1], move[0], s * scale[0], c * scale[1], move[1], 0, 0, 1};
    DISPLAY_WRITE_ROW(build->list, EFFECT_PATH_MATRIX, .kind = PETRI_EFFECT_PATH_MATRIX,
                      .matrix = all ? all->as.list : own);
    return true;
}

static bool write_sum(DisplayListBuild *build, const DrawNode *node) {
    DISPLAY_WRITE_ROW(build->list, EFFECT_SUM, .kind = PETRI_EFFECT_SUM, .inputs = node->child_count);
    return node->child_count >= 2;
}

static bool (*const effects[KIND_COUNT])(DisplayListBuild *build, const DrawNode *node) = {
#define EFFECT(id, name, help) [KIND_##id] = write_##name,
#include "schema/schema_list.h"
};

bool display_list_build_effect(DisplayListBuild *build, const DrawNode *node) {
    return (node->child_count <= 1 || node->kind == KIND_SUM) && effects[node->kind](build, node) &&
           write_children(build, node, PETRI_EFFECT_SOURCE, display_list_build_effect);
}
