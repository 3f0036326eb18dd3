// display_list_export.c: exports a picture as an array of numbers, for hosts with their own renderer; see petri-draw.h.
#include "draw/display_list.h"
#include "draw/outline.h"
#include "draw/painter.h"
#include "draw/picture.h"

#include <math.h>

static const char other_node[] = "the picture of another node";
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
} DisplayListExport;

static void add(DisplayListExport *numbers, const double *values, uint32_t count) {
    double *to = DISPLAY_ADD(numbers->arena, numbers->out, count);
    for (uint32_t i = 0; i < count; i++)
        to[i] = values[i];
}

#define ADD(...) add(numbers, (const double[]){__VA_ARGS__}, sizeof((const double[]){__VA_ARGS__}) / sizeof(double))

static void add_text(DisplayListExport *numbers, Str text) {
    uint32_t count = 0;
    for (size_t at = 0; at < text.len; count++)
        utf8_next(text, &at);
    ADD(count);
    for (size_t at = 0; at < text.len;)
        ADD(utf8_next(text, &at));
}

static void add_unsupported(DisplayListExport *numbers, const char *what) {
    ADD(PETRI_DRAW_UNSUPPORTED);
    add_text(numbers, str_from(what));
}

static void add_matrix(DisplayListExport *numbers, const DisplayMatrix *m) {
    ADD(m->xx, m->yx, m->xy, m->yy, m->x0, m->y0);
}

static void add_path(DisplayListExport *numbers, const DisplayPath *path) {
    const DisplayList *list = numbers->list;
    uint32_t count_at = numbers->out.count;
    ADD(0);
    for (uint32_t run = path->first; run != DISPLAY_NONE;) {
        bool last = run == path->last;
        uint32_t start = list->runs.at[run].start, end = last ? path->end : list->runs.at[run].end;
        add(numbers, list->numbers.at + start, end - start);
        run = last ? DISPLAY_NONE : list->runs.at[run].next;
    }
    numbers->out.at[count_at] = numbers->out.count - count_at - 1;
}

// Adds the picture of another node. Returns false if it does not exist.
static bool add_pixels(DisplayListExport *numbers, Str id) {
    PetriPainter *painter = numbers->painter;
    Texture *texture = painter ? render_graph_find(painter->render_graph, id) : NULL;
    if (!texture || !texture_download(painter->gl, texture))
        return false;
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
    return true;
}

static void add_pattern(DisplayListExport *numbers, const DisplaySource *source, double alpha) {
    const DisplayImage *image = &numbers->list->images.at[source->image];
    uint32_t start = numbers->out.count;
    ADD(PETRI_DRAW_PATTERN);
    add_matrix(numbers, &source->matrix);
    ADD(alpha);
    if (image->file.len > 0) {
        ADD(0, 0);
        add_text(numbers, image->file);
    } else if (!add_pixels(numbers, image->id)) {
        numbers->out.count = start;
        ADD(PETRI_DRAW_COLOR, 0, 0, 0, 0);
        if (!numbers->painter)
            add_unsupported(numbers, other_node);
    }
}

static void add_gradient(DisplayListExport *numbers, const DisplaySource *source, double alpha) {
    if (source->kind == SOURCE_LINEAR) {
        ADD(PETRI_DRAW_LINEAR, source->ends[0], source->ends[1], source->ends[2], source->ends[3]);
    } else {
        ADD(PETRI_DRAW_RADIAL);
        add_matrix(numbers, &source->matrix);
    }
    ADD(alpha, source->stop_count);
    for (uint32_t i = 0; i < source->stop_count; i++) {
        const DisplayStop *stop = &numbers->list->stops.at[source->first_stop + i];
        ADD(stop->offset, stop->color[0], stop->color[1], stop->color[2], stop->color[3]);
    }
}

// The recursion is bounded because display_list_build_source limits the depth of blends.
static void add_source(DisplayListExport *numbers, const DisplaySource *source, double alpha) {
    const double *c = source->color;
    switch (source->kind) {
    case SOURCE_COLOR:
        ADD(PETRI_DRAW_COLOR, c[0], c[1], c[2], c[3]);
        break;
    case SOURCE_LINEAR:
    case SOURCE_RADIAL:
        add_gradient(numbers, source, alpha);
        break;
    case SOURCE_PATTERN:
        add_pattern(numbers, source, alpha);
        break;
    case SOURCE_BLEND:
        ADD(PETRI_DRAW_BLEND, isnan(source->ratio) ? -1 : source->ratio, source->mode, alpha);
        add_source(numbers, &numbers->list->sources.at[source->first_stop], 1);
        add_source(numbers, &numbers->list->sources.at[source->stop_count], 1);
        break;
    case SOURCE_NOISE:
        ADD(PETRI_DRAW_NOISE, source->ends[0], source->ends[1], source->ends[2], source->ends[3], source->ratio,
            source->stop_count, source->mode, alpha);
        break;
    }
}

static void add_filter(DisplayListExport *numbers, uint32_t number);

static void add_paint(DisplayListExport *numbers, const DisplayPaint *paint) {
    const DisplayEffect *effect = paint->effect == DISPLAY_NONE ? NULL : &numbers->list->effects.at[paint->effect];
    const double *c = paint->color;
    if (paint->source == DISPLAY_NONE)
        ADD(PETRI_DRAW_COLOR, c[0], c[1], c[2], c[3]);
    else
        add_source(numbers, &numbers->list->sources.at[paint->source], fmin(fmax(c[3], 0), 1));
    ADD(PETRI_DRAW_STROKE_STYLE, paint->stroke_width, paint->join, paint->cap, paint->composite, paint->antialias);
    ADD(effect && effect->kind == EFFECT_DASH ? effect->count : 0, effect ? effect->amounts[0] : 0);
    if (effect && effect->kind == EFFECT_DASH)
        add(numbers, numbers->list->numbers.at + effect->numbers, effect->count);
    if (paint->filter != DISPLAY_NONE) {
        ADD(PETRI_DRAW_FILTER);
        add_filter(numbers, paint->filter);
    }
}

static void add_blend(DisplayListExport *numbers, const DisplayFilter *filter) {
    if (filter->numbers == DISPLAY_NONE) {
        ADD(filter->mode);
    } else {
        ADD(-1);
        add(numbers, numbers->list->numbers.at + filter->numbers, 4);
    }
}

// Writes a filter and its inputs. A kind of filter is written as its value in DisplayFilterKind.
static void add_filter(DisplayListExport *numbers, uint32_t number) {
    if (number == DISPLAY_NONE) {
        ADD(PETRI_FILTER_SOURCE);
        return;
    }
    const DisplayFilter *filter = &numbers->list->filters.at[number];
    ADD(filter->kind);
    switch (filter->kind) {
    case FILTER_SHADOW:
        ADD(filter->radius[0], filter->radius[1], filter->offset[0], filter->offset[1]);
        add(numbers, filter->color, 4);
        ADD(filter->only);
        break;
    case FILTER_BLUR:
    case FILTER_DILATE:
    case FILTER_ERODE:
        ADD(filter->radius[0], filter->radius[1]);
        break;
    case FILTER_OFFSET:
        ADD(filter->offset[0], filter->offset[1]);
        break;
    case FILTER_COLOUR_MATRIX:
        add(numbers, numbers->list->numbers.at + filter->numbers, 20);
        break;
    case FILTER_PAINT: {
        DisplayPaint paint = numbers->list->paints.at[filter->paint];
        paint.filter = paint.effect = DISPLAY_NONE;
        add_paint(numbers, &paint);
        return;
    }
    case FILTER_BLEND:
        add_blend(numbers, filter);
        break;
    case FILTER_SOURCE:
        return;
    }
    add_filter(numbers, filter->inputs[0]);
    if (filter->kind == FILTER_BLEND)
        add_filter(numbers, filter->inputs[1]);
}

static void add_text_command(DisplayListExport *numbers, const DisplayCommand *command) {
    const DisplayText *text = &numbers->list->texts.at[command->item];
    if (outline_has_effect(numbers->list, &numbers->list->paints.at[command->paint]))
        add_unsupported(numbers, "a path effect on text");
    ADD(PETRI_DRAW_TEXT, command->fill, command->stroke, text->point[0], text->point[1], text->size, text->weight,
        text->width, text->slant, text->center);
    add_text(numbers, str_from(text->family ? text->family : ""));
    add_text(numbers, text->text);
}

static void add_image(DisplayListExport *numbers, const DisplayImage *image) {
    uint32_t start = numbers->out.count;
    ADD(image->file.len > 0 ? PETRI_DRAW_IMAGE : PETRI_DRAW_PIXELS, image->point[0], image->point[1], image->size[0],
        image->size[1], image->fit);
    if (image->file.len > 0) {
        add_text(numbers, image->file);
    } else if (!add_pixels(numbers, image->id)) {
        numbers->out.count = start;
        if (!numbers->painter)
            add_unsupported(numbers, other_node);
    }
}

static void add_outline(DisplayListExport *numbers, const Outline *outline) {
    uint32_t count_at = numbers->out.count;
    ADD(0);
    for (uint32_t i = 0; i < outline->elements.count; i++) {
        const OutlineElement *element = &outline->elements.at[i];
        const OutlinePoint *p = element->points;
        if (element->kind == PATH_CUBIC)
            ADD(PETRI_PATH_CUBIC, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y);
        else if (element->kind == PATH_CLOSE)
            ADD(PETRI_PATH_CLOSE);
        else
            ADD(element->kind, p[0].x, p[0].y);
    }
    numbers->out.at[count_at] = numbers->out.count - count_at - 1;
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
        ADD(PETRI_DRAW_PATH, fill, stroke, command->path.fill_type);
        add_outline(numbers, &outline);
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
    ADD(PETRI_DRAW_PATH, command->fill, command->stroke, command->path.fill_type);
    add_path(numbers, &command->path);
}

static void add_command(DisplayListExport *numbers, const DisplayCommand *command) {
    if (command->kind < DISPLAY_SAVE && command->matrix != numbers->matrix) {
        ADD(PETRI_DRAW_MATRIX);
        add_matrix(numbers, &numbers->list->matrices.at[command->matrix]);
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
        add_text_command(numbers, command);
        break;
    case DISPLAY_IMAGE:
        add_image(numbers, &numbers->list->images.at[command->item]);
        break;
    case DISPLAY_CLIP:
    case DISPLAY_MASK: {
        bool outside = (command->kind == DISPLAY_MASK) != (command->path.fill_type > FILL_EVEN_ODD);
        ADD(PETRI_DRAW_CLIP, outside, command->path.fill_type & 1);
        add_path(numbers, &command->path);
        break;
    }
    case DISPLAY_SAVE:
        ADD(PETRI_DRAW_SAVE);
        break;
    case DISPLAY_RESTORE: // the host also restores its matrix and paint
        numbers->matrix = numbers->paint = DISPLAY_NONE;
        ADD(PETRI_DRAW_RESTORE);
        break;
    case DISPLAY_LAYER:
        numbers->matrix = numbers->paint = DISPLAY_NONE;
        ADD(PETRI_DRAW_LAYER);
        break;
    case DISPLAY_LAYER_END:
        numbers->matrix = numbers->paint = DISPLAY_NONE;
        ADD(PETRI_DRAW_LAYER_END, command->alpha);
        break;
    }
}

static void add_system(DisplayListExport *numbers, const AutoSystem *system) {
    ADD(system->dimensions, system->charged, system->frame.middle[0], system->frame.middle[1], system->frame.middle[2],
        system->frame.half, system->body_count);
    for (uint32_t i = 0; i < system->body_count; i++) {
        const AutoBody *body = &system->bodies[i];
        ADD(body->position[0], body->position[1], body->position[2], body->radius, body->shade, body->anchor);
    }
    ADD(system->link_count);
    for (uint32_t i = 0; i < system->link_count; i++)
        ADD(system->links[i].from, system->links[i].to);
    ADD(system->barrier_count);
    for (uint32_t i = 0; i < system->barrier_count; i++) {
        add(numbers, system->barriers[i].position, 3);
        add(numbers, system->barriers[i].normal, 3);
    }
    ADD(system->scale_count);
    for (uint32_t i = 0; i < system->scale_count; i++)
        ADD(system->scale[i].x1, system->scale[i].y1, system->scale[i].x2, system->scale[i].y2);
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
    numbers->list = display_list_build(numbers->arena, canvas, &sizes);
    for (uint32_t i = 0; i < numbers->list->commands.count; i++)
        add_command(numbers, &numbers->list->commands.at[i]);
}

static void export_picture(void *context) {
    DisplayListExport *numbers = context;
    const CanvasPicture *canvases = numbers->picture;
    ADD(canvases->width, canvases->height);
    if (canvases->automatic) {
        ADD(PETRI_DRAW_PARTICLES, canvases->automatic->count);
        for (uint32_t i = 0; i < canvases->automatic->count; i++)
            add_system(numbers, &canvases->automatic->systems[i]);
        return;
    }
    const DrawNode *canvas = find_canvas(numbers, canvases->window, 0);
    if (canvas)
        add_canvas(numbers, canvas);
}

const double *draw_canvas_display_list(PetriPainter *painter, const DrawNode *canvas, double width, double height,
                                       size_t *count) {
    DisplayListExport made = {
        .painter = painter, .arena = &painter->arena, .matrix = DISPLAY_NONE, .paint = DISPLAY_NONE};
    DisplayListExport *numbers = &made;
    ADD(width, height);
    add_canvas(numbers, canvas);
    *count = made.out.count;
    return made.out.at;
}

const double *draw_picture_display_list(Arena *arena, const CanvasPicture *picture, size_t *count) {
    DisplayListExport made = {.picture = picture, .arena = arena, .matrix = DISPLAY_NONE, .paint = DISPLAY_NONE};
    export_picture(&made);
    *count = made.out.count;
    return made.out.at;
}

bool petri_picture_is_display_list(const PetriPicture *picture) {
    return picture && (!picture->picture.window || (picture->picture.direct && !picture->picture.needs_history));
}

PetriStatus petri_picture_display_list(PetriPicture *picture, const double **numbers, size_t *count) {
    if (!picture || !numbers || !count)
        return PETRI_INVALID;
    DisplayListExport made = {
        .picture = &picture->picture, .arena = &picture->arena, .matrix = DISPLAY_NONE, .paint = DISPLAY_NONE};
    Arena *arenas[] = {&picture->arena};
    bool done = arena_protect(arenas, 1, export_picture, &made) == ARENA_OK;
    *numbers = done ? made.out.at : NULL;
    *count = done ? made.out.count : 0;
    return done ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}
