// display_list_filters.c: translates filter and path effect nodes, which apply to the siblings after them (spec
// canvas.md 6, 7).
#include "draw/display_list_build.h"
#include "maths/maths.h"

#include <math.h>
#include <string.h>

// Maximum depth of nested filters or effects. It is less than NODE_MAX_HEIGHT, because the stack can be small.
enum { MAX_DEPTH = 100 };

static uint32_t add_numbers(DisplayListBuild *build, uint32_t count, const double *numbers) {
    double *at = DISPLAY_ADD(build->arena, build->list->numbers, count);
    memcpy(at, numbers, count * sizeof *numbers);
    return build->list->numbers.count - count;
}

static bool has_attr(const DrawNode *node, AttrName name) {
    return draw_attr(node, name);
}

// Sets a colour matrix from brightness, contrast and saturation.
static void set_adjustment(const DrawNode *node, double m[4][5]) {
    static const double luminance[3] = {0.2126, 0.7152, 0.0722};
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

static uint32_t make_matrix(DisplayListBuild *build, const DrawNode *node) {
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
    return add_numbers(build, 20, m[0]);
}

static uint32_t make_coefficients(DisplayListBuild *build, const DrawNode *node) {
    const AttrValue *all = draw_attr(node, ATTR_COEFFICIENTS), *ratio = draw_attr(node, ATTR_RATIO);
    double r = ratio ? fmin(fmax(ratio->as.numbers[0], 0), 1) : 0;
    return all     ? add_numbers(build, 4, all->as.numbers)
           : ratio ? add_numbers(build, 4, (const double[]){0, 1 - r, r, 0})
                   : DISPLAY_NONE;
}

static DisplayFilterKind filter_kind(NodeKind kind) {
    switch (kind) {
    case KIND_CANVAS_BLUR:
        return FILTER_BLUR;
    case KIND_SHADOW:
        return FILTER_SHADOW;
    case KIND_CANVAS_OFFSET:
        return FILTER_OFFSET;
    case KIND_DILATE:
        return FILTER_DILATE;
    case KIND_ERODE:
        return FILTER_ERODE;
    case KIND_FILTER_MATRIX:
        return FILTER_COLOUR_MATRIX;
    case KIND_FILTER_PAINT:
        return FILTER_PAINT;
    case KIND_FILTER_BLEND:
        return FILTER_BLEND;
    default:
        return FILTER_SOURCE;
    }
}

// Reads the attributes of a filter, without its inputs. Returns false if a required attribute is missing.
static bool read_filter(DisplayListBuild *build, const GraphicsState *state, const DrawNode *node,
                        DisplayFilter *filter) {
    const AttrValue *color;
    switch (filter->kind) {
    case FILTER_OFFSET:
        return draw_pair(node, ATTR_OFFSET, filter->offset);
    case FILTER_SHADOW:
        color = draw_attr(node, ATTR_COLOR);
        draw_pair(node, ATTR_OFFSET, filter->offset);
        filter->only = draw_flag(node, ATTR_SHADOW_ONLY);
        display_list_build_stop_color(build, color ? color->as.numbers : filter->color, filter->color);
        return draw_pair(node, ATTR_RADIUS, filter->radius);
    case FILTER_COLOUR_MATRIX:
        filter->numbers = make_matrix(build, node);
        return true;
    case FILTER_PAINT: {
        GraphicsState own = *state;
        display_list_build_read_state(&own, node);
        filter->paint = display_list_build_paint(build, &own);
        return true;
    }
    case FILTER_BLEND:
        filter->numbers = make_coefficients(build, node);
        filter->mode = draw_word(node, ATTR_MODE);
        return true;
    case FILTER_SOURCE:
        return true;
    default:
        return draw_pair(node, ATTR_RADIUS, filter->radius);
    }
}

static uint32_t make_filter(DisplayListBuild *build, const GraphicsState *state, const DrawNode *node) {
    DisplayFilter filter = {.kind = filter_kind((NodeKind)node->kind),
                            .color = {0, 0, 0, 1},
                            .numbers = DISPLAY_NONE,
                            .inputs = {DISPLAY_NONE, DISPLAY_NONE},
                            .place = node->origin};
    uint32_t min = filter.kind == FILTER_BLEND ? 2 : 0, max = filter.kind == FILTER_BLEND ? 2 : 1;
    if (node->child_count < min || node->child_count > max || build->depth >= MAX_DEPTH ||
        !read_filter(build, state, node, &filter))
        return DISPLAY_NONE;
    build->depth++;
    for (uint32_t i = 0; i < node->child_count; i++) {
        filter.inputs[i] = make_filter(build, state, node->children[i]);
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

// Reads the row-major matrix of a path effect. If the node has no matrix, creates one that scales, then rotates, then
// translates points.
static void read_path_matrix(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect) {
    const AttrValue *all = draw_attr(node, ATTR_MATRIX);
    double scale[2], move[2], angle = draw_number(node, ATTR_ROTATE);
    angle = (angle - floor(angle)) * 6.283185307179586;
    double c = maths_cos(angle), s = maths_sin(angle);
    if (!draw_pair(node, ATTR_SCALE, scale))
        scale[0] = scale[1] = 1;
    draw_pair(node, ATTR_TRANSLATE, move);
    const double own[9] = {c * scale[0], -s * scale[1], move[0], s * scale[0], c * scale[1], move[1], 0, 0, 1};
    effect->numbers = add_numbers(build, 9, all ? all->as.list : own);
}

static bool read_effect(DisplayListBuild *build, const DrawNode *node, DisplayEffect *effect) {
    switch ((NodeKind)node->kind) {
    case KIND_DASH:
        effect->kind = EFFECT_DASH;
        return read_dash(build, node, effect);
    case KIND_ROUND_CORNERS:
        effect->kind = EFFECT_ROUND;
        effect->amounts[0] = draw_number(node, ATTR_RADIUS);
        return effect->amounts[0] > 0;
    case KIND_JITTER:
        effect->kind = EFFECT_JITTER;
        effect->amounts[0] = draw_number(node, ATTR_LENGTH);
        effect->amounts[1] = draw_number(node, ATTR_DEVIATION);
        effect->seed = draw_number(node, ATTR_SEED);
        return effect->amounts[0] > 0 && has_attr(node, ATTR_DEVIATION);
    case KIND_PATH_MATRIX:
        effect->kind = EFFECT_MATRIX;
        read_path_matrix(build, node, effect);
        return true;
    default:
        effect->kind = EFFECT_SUM;
        return true;
    }
}

static uint32_t make_effect(DisplayListBuild *build, const DrawNode *node) {
    DisplayEffect effect = {.inner = DISPLAY_NONE, .place = node->origin};
    uint32_t count = node->child_count;
    bool sum = node->kind == KIND_SUM;
    if ((sum ? count < 2 : count > 1) || build->depth >= MAX_DEPTH || !read_effect(build, node, &effect))
        return DISPLAY_NONE;
    double *inner = arena_alloc_array(build->arena, count, sizeof *inner);
    bool good = true;
    build->depth++;
    for (uint32_t i = 0; i < count && good; i++) {
        effect.inner = make_effect(build, node->children[i]);
        inner[i] = effect.inner;
        good = effect.inner != DISPLAY_NONE;
    }
    build->depth--;
    if (!good)
        return DISPLAY_NONE;
    if (sum) {
        effect.numbers = add_numbers(build, count, inner);
        effect.count = count;
    }
    *DISPLAY_ADD(build->arena, build->list->effects, 1) = effect;
    return build->list->effects.count - 1;
}

void display_list_build_paint_node(DisplayListBuild *build, GraphicsState *state, const DrawNode *node) {
    switch (schema_kinds[node->kind].place) {
    case PLACE_FILTER:
        state->filter = make_filter(build, state, node);
        break;
    case PLACE_EFFECT:
        state->effect = make_effect(build, node);
        break;
    default:
        state->source = display_list_build_source(build, state, node);
    }
}
