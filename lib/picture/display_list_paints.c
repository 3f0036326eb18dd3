// display_list_paints.c: translates paint source nodes, which colour the siblings after them (spec canvas.md 5), and
// images.
#include "maths/maths.h"
#include "picture/display_list_build.h"

#include <math.h>
#include <string.h>

void display_list_build_stop_color(const DisplayListBuild *build, const double color[4], double out[4]) {
    for (int k = 0; k < 4; k++) {
        double byte = floor(255 * fmin(fmax(color[k], 0), 1) + 0.5);
        out[k] = build->list->linear && k < 3 ? (double)texture_decode((unsigned)byte) : byte / 255;
    }
}

static DisplayStops make_stops(DisplayListBuild *build, const DrawNode *gradient) {
    uint32_t count = gradient->child_count;
    double before = -INFINITY;
    DisplayStop *stops = arena_alloc_array(build->arena, count, sizeof *stops);
    for (uint32_t i = 0; i < count; i++) {
        const DrawNode *node = gradient->children[i];
        const AttrValue *color = draw_attr(node, ATTR_COLOR);
        display_list_build_stop_color(build, color ? color->as.numbers : build->state->color, stops[i].color);
        double offset = draw_number(node, ATTR_OFFSET);
        stops[i].offset = fmax(isnan(offset) ? (count > 1 ? (double)i / (count - 1) : 0) : offset, before);
        before = stops[i].offset;
    }
    return (DisplayStops){stops, count};
}

static bool add_gradient(DisplayListBuild *build, const DrawNode *node, double alpha) {
    double start[2], end[2], middle[2], radius[2];
    if (node->child_count == 0)
        return false;
    if (draw_pair(node, ATTR_START, start) && draw_pair(node, ATTR_END, end)) {
        DISPLAY_WRITE(build->list, LINEAR, .start = start, .end = end, .alpha = alpha,
                      .stops = make_stops(build, node));
        return true;
    }
    if (!draw_pair(node, ATTR_RADIUS, radius))
        return false;
    draw_pair(node, ATTR_POINT, middle);
    DisplayMatrix matrix = {1, 0, 0, 1, middle[0], middle[1]};
    display_list_build_transform(&matrix, node, false);
    matrix = display_matrix_multiply(matrix, (DisplayMatrix){radius[0], 0, 0, radius[1], 0, 0});
    if (!display_matrix_is_invertible(&matrix))
        return false;
    DISPLAY_WRITE(build->list, RADIAL, .matrix = &matrix, .inner = (const double[3]){0}, .alpha = alpha,
                  .stops = make_stops(build, node));
    return true;
}

static bool add_color(DisplayListBuild *build, const DrawNode *node, double alpha) {
    const AttrValue *color = draw_attr(node, ATTR_COLOR);
    DISPLAY_WRITE(build->list, SOLID, .colour = color ? color->as.numbers : build->state->color, .alpha = alpha);
    return true;
}

// The file of an image, or the id of the node whose picture it is. Both are empty if the node has neither.
typedef struct ImageName {
    Str file;
    Str id;
} ImageName;

static ImageName image_name(const DrawNode *node) {
    const AttrValue *file = draw_attr(node, ATTR_FILENAME), *id = draw_attr(node, ATTR_IMAGE_ID);
    if (file && file->as.text.len > 0)
        return (ImageName){.file = file->as.text};
    return (ImageName){.id = id ? id->as.text : (Str){0}};
}

// Finds the pixels of another node for a host. Returns false if there are none.
static bool find_pixels(DisplayListBuild *build, Str id, Texture **pixels) {
    const DisplayHost *host = build->host;
    *pixels = host && host->find_pixels ? host->find_pixels(host->context, id) : NULL;
    return !host || *pixels;
}

static void report_other_node(DisplayListBuild *build, Str id) {
    if (id.len > 0 && build->host && !build->host->find_pixels)
        DISPLAY_WRITE(build->list, UNSUPPORTED, .name = {.text = STR("the picture of another node")});
}

static bool add_pattern(DisplayListBuild *build, const DrawNode *node, double alpha) {
    ImageName name = image_name(node);
    DisplayMatrix matrix = {1, 0, 0, 1, 0, 0};
    Texture *pixels = NULL;
    display_list_build_transform(&matrix, node, true);
    if ((name.file.len == 0 && name.id.len == 0) || !display_matrix_is_invertible(&matrix))
        return false;
    display_list_add_note(build->list, node->origin, name.id);
    if (name.file.len > 0 || find_pixels(build, name.id, &pixels))
        DISPLAY_WRITE(build->list, PATTERN, .matrix = &matrix, .alpha = alpha, .pixels = pixels,
                      .file = {.text = name.file});
    else
        DISPLAY_WRITE(build->list, COLOR, .colour = (const double[4]){0});
    report_other_node(build, name.id);
    return true;
}

static bool add_blend(DisplayListBuild *build, const DrawNode *node, double alpha) {
    if (node->child_count == 1)
        return display_list_build_source(build, node->children[0], alpha);
    if (node->child_count != 2)
        return false;
    double ratio = draw_number(node, ATTR_RATIO);
    DISPLAY_WRITE(build->list, BLEND, .ratio = isnan(ratio) ? -1 : fmin(fmax(ratio, 0), 1),
                  .mode = draw_word(node, ATTR_MODE), .alpha = alpha);
    return display_list_build_source(build, node->children[0], 1) &&
           display_list_build_source(build, node->children[1], 1);
}

static bool add_noise(DisplayListBuild *build, const DrawNode *node, double alpha) {
    enum { MAX_OCTAVES = 255, MAX_TILE = 1 << 20 };
    double frequency[2], tile[2];
    if (!draw_pair(node, ATTR_FREQUENCY, frequency))
        return false;
    draw_pair(node, ATTR_SIZE, tile);
    for (int k = 0; k < 2; k++)
        tile[k] = fmin(floor(tile[k]), MAX_TILE);
    DISPLAY_WRITE(build->list, NOISE, .frequency = frequency, .tile = tile, .seed = draw_number(node, ATTR_SEED),
                  .octaves = floor(fmin(fmax(draw_number(node, ATTR_OCTAVES), 0), MAX_OCTAVES)),
                  .type = draw_word(node, ATTR_TYPE), .alpha = alpha);
    build->list->numbers.at[DISPLAY_HEADER - 1] = true;
    return true;
}

static bool (*const sources[KIND_COUNT])(DisplayListBuild *build, const DrawNode *node, double alpha) = {
#define SOURCE(id, name, children, help) [KIND_##id] = add_##name,
#include "schema/schema_list.h"
};

// The depth of nested sources is limited to less than NODE_MAX_HEIGHT, because the function is recursive and the stack
// can be small.
bool display_list_build_source(DisplayListBuild *build, const DrawNode *node, double alpha) {
    enum { MAX_DEPTH = 100 };
    if (build->depth >= MAX_DEPTH)
        return false;
    build->depth++;
    bool good = sources[node->kind](build, node, alpha);
    build->depth--;
    return good;
}

bool display_list_build_has_image(const DrawNode *node) {
    ImageName name = image_name(node);
    return name.file.len > 0 || name.id.len > 0;
}

void display_list_build_image(DisplayListBuild *build, const DrawNode *node) {
    static const struct {
        AttrName name;
        DisplayFit fit;
    } boxes[] = {{ATTR_FILL, FIT_FILL}, {ATTR_FIT, FIT_INSIDE}, {ATTR_SIZE, FIT_SIZE}};
    ImageName name = image_name(node);
    double point[2], size[2] = {0, 0};
    DisplayFit fit = FIT_NONE;
    Texture *pixels;
    draw_pair(node, ATTR_POINT, point);
    for (size_t i = 0; i < sizeof boxes / sizeof boxes[0] && fit == FIT_NONE; i++)
        if (schema_row((NodeKind)node->kind, boxes[i].name) && draw_pair(node, boxes[i].name, size))
            fit = boxes[i].fit;
    display_list_add_note(build->list, node->origin, name.id);
    if (name.file.len > 0)
        DISPLAY_WRITE(build->list, IMAGE, .point = point, .size = size, .fit = fit, .file = {.text = name.file});
    else if (find_pixels(build, name.id, &pixels))
        DISPLAY_WRITE(build->list, PIXELS, .point = point, .size = size, .fit = fit, .pixels = pixels);
    report_other_node(build, name.id);
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

void display_list_build_colour(DisplayListBuild *build, const GraphicsState *state, const DrawNode *dash) {
    const AttrValue *intervals = dash ? draw_attr(dash, ATTR_INTERVALS) : NULL;
    if (state->source == DISPLAY_NONE) {
        DISPLAY_WRITE(build->list, COLOR, .colour = state->color);
    } else {
        const GraphicsState *outer = build->state;
        build->state = &build->settings.at[state->source].state;
        display_list_build_source(build, build->settings.at[state->source].node, fmin(fmax(state->color[3], 0), 1));
        build->state = outer;
    }
    DISPLAY_WRITE(build->list, STROKE_STYLE, .width = state->stroke_width, .join = state->join, .cap = state->cap,
                  .mode = state->composite, .antialias = state->antialias,
                  .dash_offset = dash ? draw_number(dash, ATTR_OFFSET) : 0,
                  .dashes = {intervals ? intervals->as.list : NULL, intervals ? intervals->count : 0});
}

void display_list_build_transform(DisplayMatrix *matrix, const DrawNode *node, bool after) {
    static const double TURN = 6.283185307179586;
    for (uint32_t i = 0; i < node->attr_count; i++) {
        const double *n = node->attrs[i].as.numbers;
        DisplayMatrix step = {1, 0, 0, 1, 0, 0};
        if (node->attrs[i].name == ATTR_TRANSLATE) {
            step.x0 = n[0];
            step.y0 = n[1];
        } else if (node->attrs[i].name == ATTR_SCALE) {
            step.xx = n[0];
            step.yy = n[1];
        } else if (node->attrs[i].name == ATTR_ROTATE) {
            double angle = (n[0] - floor(n[0])) * TURN;
            step.xx = step.yy = maths_cos(angle);
            step.yx = maths_sin(angle);
            step.xy = -step.yx;
        } else {
            continue;
        }
        *matrix = after ? display_matrix_multiply(step, *matrix) : display_matrix_multiply(*matrix, step);
    }
}
