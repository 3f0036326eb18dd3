// display_list_filters.c: translates filter and path effect nodes, which apply to the siblings after them (spec
// canvas.md 6, 7).
#include "gl/colour_formulas.h"
#include "maths/maths.h"
#include "picture/display_list_build.h"

#include <math.h>
#include <string.h>

// Maximum depth of nested filters or effects. It is less than NODE_MAX_HEIGHT, because the stack can be small.
enum { MAX_DEPTH = 100 };

static uint32_t add_numbers(DisplayListBuild *build, uint32_t count, const double *numbers) {
    double *at = DISPLAY_ADD(build->arena, build->list->numbers, count);
    memcpy(at, numbers, count * sizeof *numbers);
    return build->list->numbers.count - count;
}

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

static bool read_matrix(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter) {
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
    filter->numbers = add_numbers(build, 20, m[0]);
    return true;
}

static bool read_blend(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter) {
    const AttrValue *all = draw_attr(node, ATTR_COEFFICIENTS), *ratio = draw_attr(node, ATTR_RATIO);
    double r = ratio ? fmin(fmax(ratio->as.numbers[0], 0), 1) : 0;
    if (all || ratio)
        filter->numbers = add_numbers(build, 4, all ? all->as.numbers : (const double[]){0, 1 - r, r, 0});
    filter->mode = filter->numbers == DISPLAY_NONE ? draw_word(node, ATTR_MODE) : -1;
    return true;
}

static bool read_nothing(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter) {
    (void)build, (void)node, (void)filter;
    return true;
}

static bool read_radius(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter) {
    (void)build;
    return draw_pair(node, ATTR_RADIUS, filter->radius);
}

static bool read_offset(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter) {
    (void)build;
    return draw_pair(node, ATTR_OFFSET, filter->offset);
}

static bool read_shadow(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter) {
    const AttrValue *color = draw_attr(node, ATTR_COLOR);
    read_offset(build, node, filter);
    filter->only = draw_flag(node, ATTR_SHADOW_ONLY);
    display_list_build_stop_color(build, color ? color->as.numbers : filter->colour, filter->colour);
    return read_radius(build, node, filter);
}

static bool read_paint(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter) {
    GraphicsState own = *build->state;
    display_list_build_read_state(&own, node);
    filter->paint = display_list_build_paint(build, &own);
    return true;
}

// A filter and the function that reads its attributes, which returns false if a required attribute is missing.
typedef struct FilterRow {
    DisplayFilterKind kind;
    uint32_t inputs; // number of filters inside it: at most 1, or exactly 2
    bool (*read)(DisplayListBuild *build, const DrawNode *node, DisplayFilter *filter);
} FilterRow;

static const FilterRow filter_rows[KIND_COUNT] = {
#define FILTER(id, name, reader, children, inputs, help) [KIND_FILTER_##id] = {FILTER_##id, inputs, read_##reader},
#include "schema/schema_list.h"
};

uint32_t display_list_build_filter(DisplayListBuild *build, const DrawNode *node) {
    const FilterRow *row = &filter_rows[node->kind];
    DisplayFilter filter = {.kind = row->kind,
                            .colour = {0, 0, 0, 1},
                            .numbers = DISPLAY_NONE,
                            .inputs = {DISPLAY_NONE, DISPLAY_NONE},
                            .place = node->origin};
    if (node->child_count > row->inputs || (row->inputs == 2 && node->child_count < 2) || build->depth >= MAX_DEPTH ||
        !row->read(build, node, &filter))
        return DISPLAY_NONE;
    build->depth++;
    for (uint32_t i = 0; i < node->child_count; i++) {
        filter.inputs[i] = display_list_build_filter(build, node->children[i]);
        if (filter.inputs[i] == DISPLAY_NONE) {
            build->depth--;
            return DISPLAY_NONE;
        }
    }
    build->depth--;
    *DISPLAY_ADD(build->arena, build->list->filters, 1) = filter;
    return build->list->filters.count - 1;
}

static bool read_dash(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect) {
    const AttrValue *intervals = draw_attr(node, ATTR_INTERVALS);
    double sum = 0;
    if (!intervals || intervals->count < 2 || intervals->count % 2)
        return false;
    for (uint32_t i = 0; i < intervals->count; i++) {
        if (intervals->as.list[i] < 0)
            return false;
        sum += intervals->as.list[i];
    }
    effect->numbers = add_numbers(build, intervals->count, intervals->as.list);
    effect->count = intervals->count;
    effect->amounts[0] = draw_number(node, ATTR_OFFSET);
    return sum > 0 && isfinite(sum);
}

static bool read_round_corners(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect) {
    (void)build;
    effect->amounts[0] = draw_number(node, ATTR_RADIUS);
    return effect->amounts[0] > 0;
}

static bool read_jitter(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect) {
    (void)build;
    effect->amounts[0] = draw_number(node, ATTR_LENGTH);
    effect->amounts[1] = draw_number(node, ATTR_DEVIATION);
    effect->seed = draw_number(node, ATTR_SEED);
    return effect->amounts[0] > 0 && draw_attr(node, ATTR_DEVIATION);
}

// Reads the row-major matrix of a path effect. If the node has no matrix, creates one that scales, then rotates, then
// translates points.
static bool read_path_matrix(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect) {
    const AttrValue *all = draw_attr(node, ATTR_MATRIX);
    double scale[2], move[2], angle = draw_number(node, ATTR_ROTATE);
    angle = (angle - floor(angle)) * 6.283185307179586;
    double c = maths_cos(angle), s = maths_sin(angle);
    if (!draw_pair(node, ATTR_SCALE, scale))
        scale[0] = scale[1] = 1;
    draw_pair(node, ATTR_TRANSLATE, move);
    const double own[9] = {c * scale[0], -s * scale[1], move[0], s * scale[0], c * scale[1], move[1], 0, 0, 1};
    effect->numbers = add_numbers(build, 9, all ? all->as.list : own);
    return true;
}

static bool read_sum(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect) {
    (void)build, (void)node, (void)effect;
    return true;
}

// A path effect and the function that reads its attributes, which returns false if a required attribute is missing.
typedef struct EffectRow {
    DisplayEffectKind kind;
    bool (*read)(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect);
} EffectRow;

static const EffectRow effect_rows[KIND_COUNT] = {
#define EFFECT(id, name, help) [KIND_##id] = {EFFECT_##id, read_##name},
#include "schema/schema_list.h"
};

uint32_t display_list_build_effect(DisplayListBuild *build, const DrawNode *node) {
    const EffectRow *row = &effect_rows[node->kind];
    DisplayEffect effect = {.kind = row->kind, .inner = DISPLAY_NONE, .place = node->origin};
    uint32_t count = node->child_count;
    bool sum = row->kind == EFFECT_SUM;
    if ((sum ? count < 2 : count > 1) || build->depth >= MAX_DEPTH || !row->read(build, node, &effect))
        return DISPLAY_NONE;
    double *inner = arena_alloc_array(build->arena, count, sizeof *inner);
    bool good = true;
    build->depth++;
    for (uint32_t i = 0; i < count && good; i++) {
        effect.inner = display_list_build_effect(build, node->children[i]);
        inner[i] = effect.inner;
        good = effect.inner != DISPLAY_NONE;
    }
    build->depth--;
    if (!good)
        return DISPLAY_NONE;
    if (sum) {
        effect.inner = DISPLAY_NONE;
        effect.numbers = add_numbers(build, count, inner);
        effect.count = count;
    }
    *DISPLAY_ADD(build->arena, build->list->effects, 1) = effect;
    return build->list->effects.count - 1;
}
