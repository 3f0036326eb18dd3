// sources.c: nodes among drawing nodes that give those after them their colours (spec canvas.md 5); and images.
#include "draw/build.h"
#include "draw/texture.h"

#include <math.h>
#include <string.h>

// Colours of stops count as encoded, with bytes.
void build_stop_color(const Build *build, const double color[4], double out[4]) {
    for (int k = 0; k < 4; k++) {
        double byte = floor(255 * fmin(fmax(color[k], 0), 1) + 0.5);
        out[k] = build->list->linear && k < 3 ? (double)texture_decode((unsigned)byte) : byte / 255;
    }
}

static void add_stops(Build *build, const Look *look, const DrawNode *gradient, ListSource *source) {
    uint32_t count = gradient->child_count;
    double before = -INFINITY;
    source->first_stop = build->list->stops.count;
    source->stop_count = count;
    for (uint32_t i = 0; i < count; i++) {
        const DrawNode *node = gradient->children[i];
        ListStop *stop = LIST_ADD(build->arena, build->list->stops, 1);
        const AttrValue *color = draw_attr(node, ATTR_COLOR);
        build_stop_color(build, color ? color->as.numbers : look->color, stop->color);
        double offset = draw_number(node, ATTR_OFFSET);
        stop->offset = fmax(isnan(offset) ? (count > 1 ? (double)i / (count - 1) : 0) : offset, before);
        before = stop->offset;
    }
}

static uint32_t add_source(Build *build, ListSource source) {
    *LIST_ADD(build->arena, build->list->sources, 1) = source;
    return build->list->sources.count - 1;
}

static uint32_t make_gradient(Build *build, const Look *look, const DrawNode *node) {
    double start[2], end[2], middle[2], radius[2];
    if (node->child_count == 0)
        return LIST_NONE;
    ListSource source = {.kind = SOURCE_LINEAR};
    if (draw_pair(node, ATTR_START, start) && draw_pair(node, ATTR_END, end)) {
        memcpy(source.ends, start, sizeof start);
        memcpy(source.ends + 2, end, sizeof end);
    } else if (draw_pair(node, ATTR_RADIUS, radius)) {
        draw_pair(node, ATTR_POINT, middle);
        source.kind = SOURCE_RADIAL;
        source.matrix = (ListMatrix){1, 0, 0, 1, middle[0], middle[1]};
        build_transform(&source.matrix, node, false);
        source.matrix = list_multiply(source.matrix, (ListMatrix){radius[0], 0, 0, radius[1], 0, 0});
        if (!list_invertible(&source.matrix))
            return LIST_NONE;
    } else {
        return LIST_NONE;
    }
    add_stops(build, look, node, &source);
    return add_source(build, source);
}

static uint32_t make_pattern(Build *build, const DrawNode *node) {
    ListSource source = {.kind = SOURCE_PATTERN, .matrix = {1, 0, 0, 1, 0, 0}, .image = build_image(build, node)};
    build_transform(&source.matrix, node, true);
    return source.image != LIST_NONE && list_invertible(&source.matrix) ? add_source(build, source) : LIST_NONE;
}

static uint32_t make_blend(Build *build, const Look *look, const DrawNode *node) {
    if (node->child_count == 1)
        return build_source(build, look, node->children[0]);
    if (node->child_count != 2)
        return LIST_NONE;
    ListSource source = {.kind = SOURCE_BLEND,
                         .first_stop = build_source(build, look, node->children[0]),
                         .stop_count = build_source(build, look, node->children[1]),
                         .ratio = draw_number(node, ATTR_RATIO),
                         .mode = draw_word(node, ATTR_MODE)};
    if (source.first_stop == LIST_NONE || source.stop_count == LIST_NONE)
        return LIST_NONE;
    source.ratio = isnan(source.ratio) ? source.ratio : fmin(fmax(source.ratio, 0), 1);
    return add_source(build, source);
}

static uint32_t make_noise(Build *build, const DrawNode *node) {
    enum { MOST_OCTAVES = 255, MOST_TILE = 1 << 20 };
    ListSource source = {.kind = SOURCE_NOISE,
                         .ratio = draw_number(node, ATTR_SEED),
                         .mode = draw_word(node, ATTR_TYPE),
                         .stop_count = (uint32_t)fmin(fmax(draw_number(node, ATTR_OCTAVES), 0), MOST_OCTAVES)};
    double tile[2];
    if (!draw_pair(node, ATTR_FREQUENCY, source.ends))
        return LIST_NONE;
    draw_pair(node, ATTR_SIZE, tile);
    for (int k = 0; k < 2; k++)
        source.ends[2 + k] = fmin(floor(tile[k]), MOST_TILE);
    return add_source(build, source);
}

// Nodes are at most NODE_MAX_HEIGHT deep, but the stack may be small.
uint32_t build_source(Build *build, const Look *look, const DrawNode *node) {
    enum { DEEPEST = 100 };
    uint32_t made = LIST_NONE;
    if (build->depth >= DEEPEST)
        return LIST_NONE;
    build->depth++;
    if (node->kind == KIND_GRADIENT) {
        made = make_gradient(build, look, node);
    } else if (node->kind == KIND_COLOR) {
        ListSource source = {.kind = SOURCE_COLOR};
        const AttrValue *color = draw_attr(node, ATTR_COLOR);
        memcpy(source.color, color ? color->as.numbers : look->color, sizeof source.color);
        made = add_source(build, source);
    } else if (node->kind == KIND_PATTERN) {
        made = make_pattern(build, node);
    } else if (node->kind == KIND_BLEND) {
        made = make_blend(build, look, node);
    } else if (node->kind == KIND_CANVAS_NOISE) {
        made = make_noise(build, node);
    }
    build->depth--;
    return made;
}

uint32_t build_image(Build *build, const DrawNode *node) {
    static const struct {
        AttrName name;
        ListFit fit;
    } boxes[] = {{ATTR_FILL, FIT_FILL}, {ATTR_FIT, FIT_INSIDE}, {ATTR_SIZE, FIT_SIZE}};
    const AttrValue *file = draw_attr(node, ATTR_FILENAME), *id = draw_attr(node, ATTR_IMAGE_ID);
    ListImage image = {.fit = FIT_NONE, .kind = (NodeKind)node->kind, .place = node->place};
    if (file && file->as.text.len > 0)
        image.file = file->as.text;
    else if (id && id->as.text.len > 0)
        image.id = id->as.text;
    else
        return LIST_NONE;
    draw_pair(node, ATTR_POINT, image.point);
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0] && image.fit == FIT_NONE; i++)
        if (schema_row((NodeKind)node->kind, boxes[i].name) && draw_pair(node, boxes[i].name, image.size))
            image.fit = boxes[i].fit;
    *LIST_ADD(build->arena, build->list->images, 1) = image;
    return build->list->images.count - 1;
}
