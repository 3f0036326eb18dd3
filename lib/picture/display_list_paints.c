// display_list_paints.c: translates paint source nodes, which colour the siblings after them (spec canvas.md 5), and
// images.
#include "picture/display_list_build.h"
#include "picture/texture.h"

#include <math.h>
#include <string.h>

void display_list_build_stop_color(const DisplayListBuild *build, const double color[4], double out[4]) {
    for (int k = 0; k < 4; k++) {
        double byte = floor(255 * fmin(fmax(color[k], 0), 1) + 0.5);
        out[k] = build->list->linear && k < 3 ? (double)texture_decode((unsigned)byte) : byte / 255;
    }
}

static void add_stops(DisplayListBuild *build, const DrawNode *gradient, DisplaySource *source) {
    uint32_t count = gradient->child_count;
    double before = -INFINITY;
    source->first_stop = build->list->stops.count;
    source->stop_count = count;
    for (uint32_t i = 0; i < count; i++) {
        const DrawNode *node = gradient->children[i];
        DisplayStop *stop = DISPLAY_ADD(build->arena, build->list->stops, 1);
        const AttrValue *color = draw_attr(node, ATTR_COLOR);
        display_list_build_stop_color(build, color ? color->as.numbers : build->state->color, stop->color);
        double offset = draw_number(node, ATTR_OFFSET);
        stop->offset = fmax(isnan(offset) ? (count > 1 ? (double)i / (count - 1) : 0) : offset, before);
        before = stop->offset;
    }
}

static uint32_t add_source(DisplayListBuild *build, DisplaySource source) {
    *DISPLAY_ADD(build->arena, build->list->sources, 1) = source;
    return build->list->sources.count - 1;
}

static uint32_t make_gradient(DisplayListBuild *build, const DrawNode *node) {
    double start[2], end[2], middle[2], radius[2];
    if (node->child_count == 0)
        return DISPLAY_NONE;
    DisplaySource source = {.kind = SOURCE_LINEAR};
    if (draw_pair(node, ATTR_START, start) && draw_pair(node, ATTR_END, end)) {
        memcpy(source.ends, start, sizeof start);
        memcpy(source.ends + 2, end, sizeof end);
    } else if (draw_pair(node, ATTR_RADIUS, radius)) {
        draw_pair(node, ATTR_POINT, middle);
        source.kind = SOURCE_RADIAL;
        source.matrix = (DisplayMatrix){1, 0, 0, 1, middle[0], middle[1]};
        display_list_build_transform(&source.matrix, node, false);
        source.matrix = display_matrix_multiply(source.matrix, (DisplayMatrix){radius[0], 0, 0, radius[1], 0, 0});
        if (!display_matrix_is_invertible(&source.matrix))
            return DISPLAY_NONE;
    } else {
        return DISPLAY_NONE;
    }
    add_stops(build, node, &source);
    return add_source(build, source);
}

static uint32_t make_color(DisplayListBuild *build, const DrawNode *node) {
    DisplaySource source = {.kind = SOURCE_COLOR};
    const AttrValue *color = draw_attr(node, ATTR_COLOR);
    memcpy(source.color, color ? color->as.numbers : build->state->color, sizeof source.color);
    return add_source(build, source);
}

static uint32_t make_pattern(DisplayListBuild *build, const DrawNode *node) {
    DisplaySource source = {
        .kind = SOURCE_PATTERN, .matrix = {1, 0, 0, 1, 0, 0}, .image = display_list_build_image(build, node)};
    display_list_build_transform(&source.matrix, node, true);
    return source.image != DISPLAY_NONE && display_matrix_is_invertible(&source.matrix) ? add_source(build, source)
                                                                                        : DISPLAY_NONE;
}

static uint32_t make_blend(DisplayListBuild *build, const DrawNode *node) {
    if (node->child_count == 1)
        return display_list_build_source(build, node->children[0]);
    if (node->child_count != 2)
        return DISPLAY_NONE;
    DisplaySource source = {.kind = SOURCE_BLEND,
                            .first_stop = display_list_build_source(build, node->children[0]),
                            .stop_count = display_list_build_source(build, node->children[1]),
                            .ratio = draw_number(node, ATTR_RATIO),
                            .mode = draw_word(node, ATTR_MODE)};
    if (source.first_stop == DISPLAY_NONE || source.stop_count == DISPLAY_NONE)
        return DISPLAY_NONE;
    source.ratio = isnan(source.ratio) ? source.ratio : fmin(fmax(source.ratio, 0), 1);
    return add_source(build, source);
}

static uint32_t make_noise(DisplayListBuild *build, const DrawNode *node) {
    enum { MAX_OCTAVES = 255, MAX_TILE = 1 << 20 };
    DisplaySource source = {.kind = SOURCE_NOISE,
                            .ratio = draw_number(node, ATTR_SEED),
                            .mode = draw_word(node, ATTR_TYPE),
                            .stop_count = (uint32_t)fmin(fmax(draw_number(node, ATTR_OCTAVES), 0), MAX_OCTAVES)};
    double tile[2];
    if (!draw_pair(node, ATTR_FREQUENCY, source.ends))
        return DISPLAY_NONE;
    draw_pair(node, ATTR_SIZE, tile);
    for (int k = 0; k < 2; k++)
        source.ends[2 + k] = fmin(floor(tile[k]), MAX_TILE);
    return add_source(build, source);
}

static uint32_t (*const sources[KIND_COUNT])(DisplayListBuild *build, const DrawNode *node) = {
#define SOURCE(id, name, children, help) [KIND_##id] = make_##name,
#include "schema/schema_list.h"
};

// The depth of nested sources is limited to less than NODE_MAX_HEIGHT, because the function is recursive and the stack
// can be small.
uint32_t display_list_build_source(DisplayListBuild *build, const DrawNode *node) {
    enum { MAX_DEPTH = 100 };
    if (build->depth >= MAX_DEPTH)
        return DISPLAY_NONE;
    build->depth++;
    uint32_t number = sources[node->kind](build, node);
    build->depth--;
    return number;
}

uint32_t display_list_build_image(DisplayListBuild *build, const DrawNode *node) {
    static const struct {
        AttrName name;
        DisplayFit fit;
    } boxes[] = {{ATTR_FILL, FIT_FILL}, {ATTR_FIT, FIT_INSIDE}, {ATTR_SIZE, FIT_SIZE}};
    const AttrValue *file = draw_attr(node, ATTR_FILENAME), *id = draw_attr(node, ATTR_IMAGE_ID);
    DisplayImage image = {.fit = FIT_NONE, .kind = (NodeKind)node->kind, .place = node->origin};
    if (file && file->as.text.len > 0)
        image.file = file->as.text;
    else if (id && id->as.text.len > 0)
        image.id = id->as.text;
    else
        return DISPLAY_NONE;
    draw_pair(node, ATTR_POINT, image.point);
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0] && image.fit == FIT_NONE; i++)
        if (schema_row((NodeKind)node->kind, boxes[i].name) && draw_pair(node, boxes[i].name, image.size))
            image.fit = boxes[i].fit;
    *DISPLAY_ADD(build->arena, build->list->images, 1) = image;
    return build->list->images.count - 1;
}

bool display_list_build_read_state(GraphicsState *state, const DrawNode *node) {
    bool changed = false;
    for (uint32_t i = 0; i < node->attr_count; i++) {
        if (schema_rows[node->attrs[i].row].field == FIELD_NOWHERE)
            continue;
        changed = true;
        schema_store(&node->attrs[i], state);
        if (node->attrs[i].name == ATTR_COLOR)
            state->source = DISPLAY_NONE;
    }
    return changed;
}

uint32_t display_list_build_paint(DisplayListBuild *build, const GraphicsState *state) {
    DisplayPaint *paint = DISPLAY_ADD(build->arena, build->list->paints, 1);
    *paint = (DisplayPaint){.color = {state->color[0], state->color[1], state->color[2], state->color[3]},
                            .stroke_width = state->stroke_width,
                            .source = state->source,
                            .filter = state->filter,
                            .effect = state->effect,
                            .join = state->join,
                            .cap = state->cap,
                            .composite = state->composite,
                            .antialias = state->antialias};
    return build->list->paints.count - 1;
}
