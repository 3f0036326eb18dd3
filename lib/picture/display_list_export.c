// display_list_export.c: exports a picture as an array of numbers, for hosts with their own renderer; see petri-draw.h.
//
// The structs of operands and the functions that write them are made from the same list of commands, so they always
// match. A matrix or paint is written only if it differs from the last one. A host restores both at the end of a layer,
// so both are then written again.
#include "picture/display_list.h"
#include "picture/outline.h"
#include "picture/painter.h"
#include "picture/picture.h"

#include <math.h>
#include <string.h>

enum { PIXELS_FLAG = 2 };               // index of the number that is 1 if there are filters or noise
enum { MAX_EFFECT_ELEMENTS = 2000000 }; // maximum number of path elements that the effects of a picture may create

typedef struct DisplayListExport {
    const CanvasPicture *picture; // the picture to export; NULL: only one canvas is exported
    PetriPainter *painter;        // provides the pictures of other nodes; NULL: such pictures are not available
    Arena *arena;
    DISPLAY_ARRAY(double) out;
    const DisplayList *list;
    uint32_t matrix;          // index of the matrix written last; DISPLAY_NONE: none
    uint32_t paint;           // index of the paint written last; DISPLAY_NONE: none
    uint32_t effect_elements; // path elements created by effects so far
    double scale;             // of the automatic picture: pixels per unit
    double color[4];          // of the automatic picture: the current colour; NaN: none
    double line;              // of the automatic picture: the current line width; 0: none
} DisplayListExport;

static void add(DisplayListExport *numbers, const double *values, uint32_t count) {
    if (numbers->out.room - numbers->out.count < count) // checked here, because most calls add a single number
        numbers->out.at = display_list_grow(numbers->arena, numbers->out.at, numbers->out.count, &numbers->out.room,
                                            count, sizeof *values);
    double *to = numbers->out.at + numbers->out.count;
    numbers->out.count += count;
    for (uint32_t i = 0; i < count; i++)
        to[i] = values[i];
}

#define ADD(...) add(numbers, (const double[]){__VA_ARGS__}, sizeof((const double[]){__VA_ARGS__}) / sizeof(double))

typedef struct NumberList {
    const double *at;
    uint32_t count;
} NumberList;

typedef struct StopList {
    const DisplayStop *at;
    uint32_t count;
} StopList;

// A path from one of three sources; the others are NULL.
typedef struct AnyPath {
    const DisplayPath *path;
    const Outline *outline;
    NumberList elements;
} AnyPath;

// The operands of each command.
#define COMMAND(name, operands)                                                                                        \
    typedef struct name##Operands {                                                                                    \
        double kind;                                                                                                   \
        operands                                                                                                       \
    } name##Operands;
#define NUMBER(name) double name;
#define NUMBERS(name, count) const double *name;
#define MATRIX(name) const DisplayMatrix *name;
#define COLOUR(name) const double *name;
#define STOPS(name) StopList name;
#define LIST(name) NumberList name;
#define STRING(name) Str name;
#define PATH(name) AnyPath name;
#define PIXELS(name) Texture *name;
#define FILTER(name) uint32_t name;
#define PAINT(name) const DisplaySource *name;
#include "picture/display_list_rows.h"

static void add_string(DisplayListExport *numbers, Str text) {
    uint32_t count = 0;
    for (size_t at = 0; at < text.len; count++)
        utf8_next(text, &at);
    ADD(count);
    for (size_t at = 0; at < text.len;)
        ADD(utf8_next(text, &at));
}

static void add_matrix(DisplayListExport *numbers, const DisplayMatrix *m) {
    ADD(m->xx, m->yx, m->xy, m->yy, m->x0, m->y0);
}

static void add_list(DisplayListExport *numbers, NumberList list) {
    ADD(list.count);
    add(numbers, list.at, list.count);
}

// Adds numbers, preceded by their count, that are written between begin_list and end_list.
static uint32_t begin_list(DisplayListExport *numbers) {
    ADD(0);
    return numbers->out.count;
}

static void end_list(DisplayListExport *numbers, uint32_t start) {
    numbers->out.at[start - 1] = numbers->out.count - start;
}

static void add_stops(DisplayListExport *numbers, StopList stops) {
    ADD(stops.count);
    for (uint32_t i = 0; i < stops.count; i++) {
        ADD(stops.at[i].offset);
        add(numbers, stops.at[i].color, 4);
    }
}

static void add_path_runs(DisplayListExport *numbers, const DisplayPath *path) {
    const DisplayList *list = numbers->list;
    for (uint32_t run = path->first; run != DISPLAY_NONE;) {
        bool last = run == path->last;
        uint32_t start = list->runs.at[run].start, end = last ? path->end : list->runs.at[run].end;
        add(numbers, list->numbers.at + start, end - start);
        run = last ? DISPLAY_NONE : list->runs.at[run].next;
    }
}

static void add_outline(DisplayListExport *numbers, const Outline *outline) {
    for (uint32_t i = 0; i < outline->elements.count; i++) {
        const OutlineElement *element = &outline->elements.at[i];
        ADD(element->kind);
        add(numbers, &element->points[0].x, display_path_sizes[element->kind]);
    }
}

static void add_path(DisplayListExport *numbers, const AnyPath *path) {
    uint32_t start = begin_list(numbers);
    if (path->path)
        add_path_runs(numbers, path->path);
    else if (path->outline)
        add_outline(numbers, path->outline);
    else
        add(numbers, path->elements.at, path->elements.count);
    end_list(numbers, start);
}

// Adds the pixels of a picture. NULL means an empty picture.
static void add_pixels(DisplayListExport *numbers, Texture *texture) {
    if (!texture) {
        ADD(0, 0);
        return;
    }
    uint32_t *row = arena_alloc_array(numbers->arena, (size_t)texture->width, sizeof *row);
    ADD(texture->width, texture->height);
    for (int y = 0; y < texture->height; y++) {
        if (numbers->list->linear)
            texture_linear_row(texture, y, row);
        else
            texture_row(texture, y, false, row);
        double *to = DISPLAY_ADD(numbers->arena, numbers->out, (uint32_t)texture->width);
        for (int x = 0; x < texture->width; x++)
            to[x] = row[x];
    }
}

static void add_source(DisplayListExport *numbers, const DisplaySource *source, double alpha);
static void add_filter_list(DisplayListExport *numbers, uint32_t number);

// Write a command and its operands.
#define COMMAND(name, operands)                                                                                        \
    static inline void write_##name(DisplayListExport *numbers, const name##Operands *o) {                             \
        ADD(o->kind);                                                                                                  \
        operands                                                                                                       \
    }
#define NUMBER(name) ADD(o->name);
#define NUMBERS(name, count) add(numbers, o->name, count);
#define MATRIX(name) add_matrix(numbers, o->name);
#define COLOUR(name) add(numbers, o->name, 4);
#define STOPS(name) add_stops(numbers, o->name);
#define LIST(name) add_list(numbers, o->name);
#define STRING(name) add_string(numbers, o->name);
#define PATH(name) add_path(numbers, &o->name);
#define PIXELS(name) add_pixels(numbers, o->name);
#define FILTER(name) add_filter_list(numbers, o->name);
#define PAINT(name) add_source(numbers, o->name, 1);
#include "picture/display_list_rows.h"

#define WRITE(name, ...) write_##name(numbers, &(name##Operands){.kind = PETRI_DRAW_##name, __VA_ARGS__})

static void add_unsupported(DisplayListExport *numbers, const char *what) {
    WRITE(UNSUPPORTED, .name = str_from(what));
}

static void report_other_node(DisplayListExport *numbers) {
    if (!numbers->painter)
        add_unsupported(numbers, "the picture of another node");
}

// Returns the picture of another node, or NULL if there is none.
static Texture *find_pixels(DisplayListExport *numbers, Str id) {
    PetriPainter *painter = numbers->painter;
    Texture *texture = painter ? render_graph_find(painter->render_graph, id) : NULL;
    return texture && texture_download(painter->gl, texture) ? texture : NULL;
}

static void add_pattern(DisplayListExport *numbers, const DisplaySource *source, double alpha) {
    const DisplayImage *image = &numbers->list->images.at[source->image];
    Texture *pixels = image->file.len > 0 ? NULL : find_pixels(numbers, image->id);
    if (image->file.len > 0 || pixels)
        WRITE(PATTERN, .matrix = &source->matrix, .alpha = alpha, .pixels = pixels, .file = image->file);
    else
        WRITE(COLOR, .colour = (const double[4]){0});
    if (image->file.len == 0)
        report_other_node(numbers);
}

// The recursion is bounded because display_list_build_source limits the depth of blends.
static void add_source(DisplayListExport *numbers, const DisplaySource *source, double alpha) {
    const DisplayList *list = numbers->list;
    StopList stops = {NULL, 0};
    if (source->kind == SOURCE_LINEAR || source->kind == SOURCE_RADIAL)
        stops = (StopList){list->stops.at + source->first_stop, source->stop_count};
    switch (source->kind) {
    case SOURCE_COLOR:
        WRITE(COLOR, .colour = source->color);
        break;
    case SOURCE_LINEAR:
        WRITE(LINEAR, .start = source->ends, .end = source->ends + 2, .alpha = alpha, .stops = stops);
        break;
    case SOURCE_RADIAL:
        WRITE(RADIAL, .matrix = &source->matrix, .inner = (const double[3]){0}, .alpha = alpha, .stops = stops);
        break;
    case SOURCE_PATTERN:
        add_pattern(numbers, source, alpha);
        break;
    case SOURCE_BLEND:
        WRITE(BLEND, .ratio = isnan(source->ratio) ? -1 : source->ratio, .mode = source->mode, .alpha = alpha,
              .first = &list->sources.at[source->first_stop], .second = &list->sources.at[source->stop_count]);
        break;
    case SOURCE_NOISE:
        WRITE(NOISE, .frequency = source->ends, .tile = source->ends + 2, .seed = source->ratio,
              .octaves = source->stop_count, .type = source->mode, .alpha = alpha);
        numbers->out.at[PIXELS_FLAG] = true;
        break;
    }
}

static void add_paint(DisplayListExport *numbers, const DisplayPaint *paint) {
    const DisplayEffect *effect = paint->effect == DISPLAY_NONE ? NULL : &numbers->list->effects.at[paint->effect];
    NumberList dashes = {0};
    if (effect && effect->kind == EFFECT_DASH)
        dashes = (NumberList){numbers->list->numbers.at + effect->numbers, effect->count};
    if (paint->source == DISPLAY_NONE)
        WRITE(COLOR, .colour = paint->color);
    else
        add_source(numbers, &numbers->list->sources.at[paint->source], fmin(fmax(paint->color[3], 0), 1));
    WRITE(STROKE_STYLE, .width = paint->stroke_width, .join = paint->join, .cap = paint->cap, .mode = paint->composite,
          .antialias = paint->antialias, .dash_offset = effect ? effect->amounts[0] : 0, .dashes = dashes);
    if (paint->filter != DISPLAY_NONE)
        WRITE(FILTER, .filter = paint->filter);
}

// Adds the commands of a filter's paint.
static void add_filter_paint(DisplayListExport *numbers, const DisplayFilter *filter) {
    DisplayPaint paint = numbers->list->paints.at[filter->paint];
    paint.filter = paint.effect = DISPLAY_NONE;
    uint32_t start = begin_list(numbers);
    add_paint(numbers, &paint);
    end_list(numbers, start);
}

// Writes a filter and its inputs. The names of operands are those of DisplayFilter's fields.
static void add_filter(DisplayListExport *numbers, uint32_t number) {
    static const double none[20] = {0};
    if (number == DISPLAY_NONE) {
        ADD(PETRI_FILTER_SOURCE);
        return;
    }
    const DisplayFilter *filter = &numbers->list->filters.at[number];
    const double *table = filter->numbers == DISPLAY_NONE ? none : numbers->list->numbers.at + filter->numbers;
    const uint32_t *inputs = filter->inputs;
    ADD(filter->kind);
    switch (filter->kind) {
#define FILTER_KIND(name, operands)                                                                                    \
    case FILTER_##name:                                                                                                \
        operands break;
#define NUMBER(name) ADD(filter->name);
#define PAIR(name) add(numbers, filter->name, 2);
#define NUMBERS(name, count) add(numbers, table, count);
#define COLOUR(name) add(numbers, filter->name, 4);
#define INPUT(name) add_filter(numbers, *inputs++);
#define COMMANDS(name) add_filter_paint(numbers, filter);
#include "picture/display_list_rows.h"
    }
}

static void add_filter_list(DisplayListExport *numbers, uint32_t number) {
    uint32_t start = begin_list(numbers);
    add_filter(numbers, number);
    end_list(numbers, start);
    numbers->out.at[PIXELS_FLAG] = true;
}

static void add_text(DisplayListExport *numbers, const DisplayCommand *command) {
    const DisplayText *text = &numbers->list->texts.at[command->item];
    if (outline_has_effect(numbers->list, &numbers->list->paints.at[command->paint]))
        add_unsupported(numbers, "a path effect on text");
    WRITE(TEXT, .fill = command->fill, .stroke = command->stroke, .point = text->point, .size = text->size,
          .weight = text->weight, .width = text->width, .slant = text->slant, .centred = text->center,
          .family = str_from(text->family ? text->family : ""), .text = text->text);
}

static void add_image(DisplayListExport *numbers, const DisplayImage *image) {
    if (image->file.len > 0) {
        WRITE(IMAGE, .point = image->point, .size = image->size, .fit = image->fit, .file = image->file);
        return;
    }
    Texture *pixels = find_pixels(numbers, image->id);
    if (pixels)
        WRITE(PIXELS, .point = image->point, .size = image->size, .fit = image->fit, .pixels = pixels);
    report_other_node(numbers);
}

// Adds the path that results from a path effect. If the paths for filling and stroking differ, adds two commands.
static void add_path_with_effect(DisplayListExport *numbers, const DisplayCommand *command, const DisplayPaint *paint) {
    const DisplayList *list = numbers->list;
    const DisplayMatrix *m = &list->matrices.at[command->matrix];
    const DisplayEffect *effect = &list->effects.at[paint->effect];
    uint32_t number =
        effect->kind == EFFECT_DASH ? effect->inner : paint->effect; // the host itself draws the outermost dashes
    Outline from = {.arena = numbers->arena, .fine = 2 / fmax(sqrt(fabs(m->xx * m->yy - m->xy * m->yx)), 1e-6)};
    outline_add_path(&from, list, &command->path);
    bool separate = outline_has_dashes(list, number) && command->fill && command->stroke;
    for (int part = 0; part < 1 + separate; part++) {
        bool fill = command->fill && part == 0, stroke = command->stroke && part == separate;
        Outline outline = outline_apply(list, number, from, !fill);
        WRITE(PATH, .fill = fill, .stroke = stroke, .rule = command->path.fill_type, .path.outline = &outline);
        numbers->effect_elements += outline.elements.count;
    }
    if (numbers->effect_elements > MAX_EFFECT_ELEMENTS)
        add_unsupported(numbers, "path effects with more than two million path elements");
}

static void add_path_command(DisplayListExport *numbers, const DisplayCommand *command) {
    const DisplayPaint *paint = &numbers->list->paints.at[command->paint];
    if (numbers->effect_elements <= MAX_EFFECT_ELEMENTS && outline_has_effect(numbers->list, paint)) {
        add_path_with_effect(numbers, command, paint);
        return;
    }
    WRITE(PATH, .fill = command->fill, .stroke = command->stroke, .rule = command->path.fill_type,
          .path.path = &command->path);
}

static void add_command(DisplayListExport *numbers, const DisplayCommand *command) {
    if (command->kind < DISPLAY_SAVE && command->matrix != numbers->matrix) {
        WRITE(MATRIX, .matrix = &numbers->list->matrices.at[command->matrix]);
        numbers->matrix = command->matrix;
    }
    if (command->kind < DISPLAY_SAVE && command->paint != numbers->paint) {
        add_paint(numbers, &numbers->list->paints.at[command->paint]);
        numbers->paint = command->paint;
    }
    switch (command->kind) {
    case DISPLAY_DRAW:
        add_path_command(numbers, command);
        break;
    case DISPLAY_TEXT:
        add_text(numbers, command);
        break;
    case DISPLAY_IMAGE:
        add_image(numbers, &numbers->list->images.at[command->item]);
        break;
    case DISPLAY_CLIP:
    case DISPLAY_MASK: {
        bool outside = (command->kind == DISPLAY_MASK) != (command->path.fill_type > FILL_EVEN_ODD);
        WRITE(CLIP, .outside = outside, .even_odd = command->path.fill_type & 1, .path.path = &command->path);
        break;
    }
    case DISPLAY_SAVE:
        WRITE(SAVE, );
        break;
    case DISPLAY_RESTORE: // the host also restores its matrix and paint
        numbers->matrix = numbers->paint = DISPLAY_NONE;
        WRITE(RESTORE, );
        break;
    case DISPLAY_LAYER:
        numbers->matrix = numbers->paint = DISPLAY_NONE;
        WRITE(LAYER, );
        break;
    case DISPLAY_LAYER_END:
        numbers->matrix = numbers->paint = DISPLAY_NONE;
        WRITE(LAYER_END, .alpha = command->alpha);
        break;
    }
}

static void clip_shapes(void *context, const double *box) {
    static const DisplayMatrix identity = {1, 0, 0, 1, 0, 0};
    DisplayListExport *numbers = context;
    if (!box) {
        WRITE(RESTORE, );
        return;
    }
    double right = box[0] + box[2], bottom = box[1] + box[3];
    const double path[] = {PATH_MOVE, box[0], box[1],    PATH_LINE, right,  box[1],    PATH_LINE,
                           right,     bottom, PATH_LINE, box[0],    bottom, PATH_CLOSE};
    WRITE(SAVE, );
    WRITE(MATRIX, .matrix = &identity);
    WRITE(CLIP, .path.elements = {path, sizeof path / sizeof *path});
    numbers->color[0] = NAN;
    numbers->line = 0;
}

// Adds a shape of the automatic picture, and the attributes in which it differs from the previous one.
static void add_shape(void *context, const AutoShape *shape) {
    DisplayListExport *numbers = context;
    const AutoGradient *gradient = shape->gradient;
    if (gradient) {
        const double *from = gradient->inner, *to = gradient->outer;
        const double start[] = {(from[0] - to[0]) / to[2], (from[1] - to[1]) / to[2], from[2] / to[2]};
        WRITE(RADIAL, .matrix = &(DisplayMatrix){to[2], 0, 0, to[2], to[0], to[1]}, .inner = start, .alpha = 1,
              .stops = {gradient->stops, 3});
        numbers->color[0] = NAN;
    } else if (memcmp(shape->color, numbers->color, sizeof numbers->color) != 0) {
        WRITE(COLOR, .colour = shape->color);
        memcpy(numbers->color, shape->color, sizeof numbers->color);
    }
    if (shape->line > 0 && shape->line != numbers->line) {
        WRITE(STROKE_STYLE, .width = shape->line, .mode = COMPOSITE_OVER, .antialias = true);
        numbers->line = shape->line;
    }
    WRITE(PATH, .fill = shape->line == 0, .stroke = shape->line > 0, .path.elements = {shape->path, shape->length});
}

static void add_automatic(DisplayListExport *numbers, const CanvasPicture *picture) {
    WRITE(BACKGROUND, .colour = (const double[]){AUTO_GROUND, 1});
    auto_draw(&(AutoTarget){.arena = numbers->arena,
                            .width = picture->width,
                            .height = picture->height,
                            .scale = numbers->scale,
                            .clip = clip_shapes,
                            .draw = add_shape,
                            .context = numbers},
              picture->automatic);
}

// Returns the first canvas in the tree of a node. Other nodes that produce a picture, such as effects or a second
// canvas, are reported as unsupported.
static const DrawNode *find_canvas(DisplayListExport *numbers, const DrawNode *node, int depth) {
    enum { MAX_DEPTH = 100 };
    if (node->kind == KIND_CANVAS || depth > MAX_DEPTH)
        return node->kind == KIND_CANVAS ? node : NULL;
    if (!(node->kind == KIND_WINDOW || node->kind == KIND_OFFSCREEN || node->kind == KIND_RECORD))
        add_unsupported(numbers, schema_kinds[node->kind].name);
    const DrawNode *found = NULL;
    for (uint32_t i = 0; i < node->child_count; i++) {
        const DrawNode *child = node->children[i];
        if (child->kind == KIND_POINTER || child->kind == KIND_KEY || child->kind == KIND_REFERENCE)
            continue;
        if (found)
            add_unsupported(numbers, schema_kinds[child->kind].name);
        else
            found = find_canvas(numbers, child, depth + 1);
    }
    return found;
}

static void add_canvas(DisplayListExport *numbers, const DrawNode *canvas) {
    DisplayListSizes sizes = {0};
    if (draw_flag(canvas, ATTR_LINEAR) && draw_number(canvas, ATTR_COLORBITS) > 8)
        add_unsupported(numbers, "HDR canvas (colorbits)");
    numbers->matrix = numbers->paint = DISPLAY_NONE;
    numbers->list = display_list_build(numbers->arena, canvas, &sizes);
    for (uint32_t i = 0; i < numbers->list->commands.count; i++)
        add_command(numbers, &numbers->list->commands.at[i]);
}

static void export_picture(void *context) {
    DisplayListExport *numbers = context;
    const CanvasPicture *canvases = numbers->picture;
    ADD(canvases->width, canvases->height, false);
    if (canvases->automatic) {
        add_automatic(numbers, canvases);
        return;
    }
    const DrawNode *canvas = find_canvas(numbers, canvases->window, 0);
    if (canvas)
        add_canvas(numbers, canvas);
}

const double *display_list_of_canvas(PetriPainter *painter, const DrawNode *canvas, double width, double height,
                                     size_t *count) {
    DisplayListExport export = {.painter = painter, .arena = &painter->arena};
    DisplayListExport *numbers = &export;
    ADD(width, height, false);
    add_canvas(numbers, canvas);
    *count = export.out.count;
    return export.out.at;
}

const double *display_list_of_picture(Arena *arena, const CanvasPicture *picture, double scale, size_t *count) {
    DisplayListExport export = {.picture = picture, .arena = arena, .scale = scale};
    export_picture(&export);
    *count = export.out.count;
    return export.out.at;
}

bool petri_picture_is_display_list(const PetriPicture *picture) {
    return picture && (!picture->picture.window || (picture->picture.direct && !picture->picture.needs_history));
}

PetriStatus petri_picture_display_list(PetriPicture *picture, const double **numbers, size_t *count) {
    if (!picture || !numbers || !count)
        return PETRI_INVALID;
    DisplayListExport export = {
        .picture = &picture->picture, .arena = &picture->arena, .scale = picture->width / picture->picture.width};
    Arena *arenas[] = {&picture->arena};
    bool done = arena_protect(arenas, 1, export_picture, &export) == ARENA_OK;
    *numbers = done ? export.out.at : NULL;
    *count = done ? export.out.count : 0;
    return done ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}
