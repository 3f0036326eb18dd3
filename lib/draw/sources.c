// sources.c: nodes among drawing nodes that change how those after them are painted: sources, filters, path effects
// (spec canvas.md 5 to 7); and images.
#include "draw/build.h"
#include "draw/texture.h"

#include <math.h>
#include <string.h>

// Colours of stops count as encoded, with bytes.
static void take_stop_color(const Build *build, const double color[4], double out[4]) {
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
        take_stop_color(build, color ? color->as.numbers : look->color, stop->color);
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

static uint32_t make_source(Build *build, const Look *look, const DrawNode *node);

static uint32_t make_pattern(Build *build, const DrawNode *node) {
    ListSource source = {.kind = SOURCE_PATTERN, .matrix = {1, 0, 0, 1, 0, 0}, .image = build_image(build, node)};
    build_transform(&source.matrix, node, true);
    return source.image != LIST_NONE && list_invertible(&source.matrix) ? add_source(build, source) : LIST_NONE;
}

static uint32_t make_blend(Build *build, const Look *look, const DrawNode *node) {
    if (node->child_count == 1)
        return make_source(build, look, node->children[0]);
    if (node->child_count != 2)
        return LIST_NONE;
    ListSource source = {.kind = SOURCE_BLEND,
                         .first_stop = make_source(build, look, node->children[0]),
                         .stop_count = make_source(build, look, node->children[1]),
                         .ratio = draw_number(node, ATTR_RATIO),
                         .mode = draw_word(node, ATTR_MODE)};
    if (source.first_stop == LIST_NONE || source.stop_count == LIST_NONE)
        return LIST_NONE;
    source.ratio = isnan(source.ratio) ? source.ratio : fmin(fmax(source.ratio, 0), 1);
    return add_source(build, source);
}

// Nodes are at most NODE_MAX_HEIGHT deep, but the stack may be small.
static uint32_t make_source(Build *build, const Look *look, const DrawNode *node) {
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
    }
    build->depth--;
    return made;
}

static uint32_t make_filter(Build *build, const DrawNode *node) {
    enum { DEEPEST = 100 };
    ListFilter filter = {.kind = node->kind == KIND_CANVAS_BLUR ? FILTER_BLUR
                                 : node->kind == KIND_SHADOW    ? FILTER_SHADOW
                                                                : FILTER_OFFSET,
                         .input = LIST_NONE,
                         .color = {0, 0, 0, 1}};
    bool good = filter.kind == FILTER_OFFSET ? draw_pair(node, ATTR_OFFSET, filter.offset)
                                             : draw_pair(node, ATTR_RADIUS, filter.radius);
    if (!good || node->child_count > 1 || build->depth >= DEEPEST)
        return LIST_NONE;
    if (filter.kind == FILTER_SHADOW) {
        const AttrValue *color = draw_attr(node, ATTR_COLOR);
        draw_pair(node, ATTR_OFFSET, filter.offset);
        filter.only = draw_flag(node, ATTR_SHADOW_ONLY);
        take_stop_color(build, color ? color->as.numbers : filter.color, filter.color);
    }
    build->depth++;
    if (node->child_count == 1)
        filter.input = make_filter(build, node->children[0]);
    build->depth--;
    if (node->child_count == 1 && filter.input == LIST_NONE)
        return LIST_NONE;
    *LIST_ADD(build->arena, build->list->filters, 1) = filter;
    return build->list->filters.count - 1;
}

static void take_dash(Build *build, Look *look, const DrawNode *node) {
    const AttrValue *intervals = draw_attr(node, ATTR_INTERVALS);
    double sum = 0;
    look->dash_count = 0;
    if (!intervals || intervals->count < 2 || intervals->count % 2)
        return;
    for (uint32_t i = 0; i < intervals->count; i++) {
        if (intervals->as.list[i] < 0)
            return;
        sum += intervals->as.list[i];
    }
    if (!(sum > 0) || !isfinite(sum))
        return;
    double *numbers = LIST_ADD(build->arena, build->list->numbers, intervals->count);
    memcpy(numbers, intervals->as.list, intervals->count * sizeof *numbers);
    look->dashes = build->list->numbers.count - intervals->count;
    look->dash_count = intervals->count;
    look->dash_offset = draw_number(node, ATTR_OFFSET);
}

void build_paint_node(Build *build, Look *look, const DrawNode *node) {
    switch ((NodeKind)node->kind) {
    case KIND_CANVAS_BLUR:
    case KIND_SHADOW:
    case KIND_CANVAS_OFFSET:
        look->filter = make_filter(build, node);
        break;
    case KIND_DASH:
        take_dash(build, look, node);
        break;
    default:
        look->source = make_source(build, look, node);
    }
}

uint32_t build_image(Build *build, const DrawNode *node) {
    static const struct {
        AttrName name;
        ListFit fit;
    } boxes[] = {{ATTR_FILL, FIT_FILL}, {ATTR_FIT, FIT_INSIDE}, {ATTR_SIZE, FIT_SIZE}};
    const AttrValue *file = draw_attr(node, ATTR_FILENAME), *id = draw_attr(node, ATTR_IMAGE_ID);
    ListImage image = {.fit = FIT_NONE};
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
