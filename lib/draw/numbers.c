// numbers.c: a picture as one array of numbers, for hosts that draw by themselves; see petri-draw.h.
#include "draw/painter.h"
#include "draw/picture.h"

#include "draw/list.h"
#include "draw/outline.h"

#include <math.h>

static const char other_node[] = "the picture of another node";
enum { MOST_CHANGED = 2000000 }; // pieces of a picture's paths that effects make

typedef struct Numbers {
    const CanvasPicture *picture; // or NULL, of a canvas
    PetriPainter *painter;        // that has the pictures of other nodes; or NULL
    Arena *arena;
    LIST_ARRAY(double) out;
    const List *list;
    uint32_t matrix; // that was written last
    uint32_t paint;
    uint32_t changed; // pieces that effects have made
} Numbers;

static void add(Numbers *numbers, const double *values, uint32_t count) {
    double *to = LIST_ADD(numbers->arena, numbers->out, count);
    for (uint32_t i = 0; i < count; i++)
        to[i] = values[i];
}

#define ADD(...) add(numbers, (const double[]){__VA_ARGS__}, sizeof((const double[]){__VA_ARGS__}) / sizeof(double))

static void add_text(Numbers *numbers, Str text) {
    uint32_t count = 0;
    for (size_t at = 0; at < text.len; count++)
        utf8_next(text, &at);
    ADD(count);
    for (size_t at = 0; at < text.len;)
        ADD(utf8_next(text, &at));
}

static void add_undrawn(Numbers *numbers, const char *what) {
    ADD(PETRI_DRAW_UNDRAWN);
    add_text(numbers, str_from(what));
}

static void add_matrix(Numbers *numbers, const ListMatrix *m) {
    ADD(m->xx, m->yx, m->xy, m->yy, m->x0, m->y0);
}

static void add_path(Numbers *numbers, const ListPath *path) {
    const List *list = numbers->list;
    uint32_t count_at = numbers->out.count;
    ADD(0);
    for (uint32_t run = path->first; run != LIST_NONE;) {
        bool last = run == path->last;
        uint32_t start = list->runs.at[run].start, end = last ? path->end : list->runs.at[run].end;
        add(numbers, list->numbers.at + start, end - start);
        run = last ? LIST_NONE : list->runs.at[run].next;
    }
    numbers->out.at[count_at] = numbers->out.count - count_at - 1;
}

// The picture of another node; false if that is not there.
static bool add_pixels(Numbers *numbers, Str id) {
    PetriPainter *painter = numbers->painter;
    Texture *texture = painter ? pictures_find(painter->pictures, id) : NULL;
    if (!texture || !texture_fetch(painter->gl, texture))
        return false;
    uint32_t *row = arena_alloc_array(numbers->arena, (size_t)texture->width, sizeof *row);
    ADD(texture->width, texture->height);
    for (int y = 0; y < texture->height; y++) {
        if (numbers->list->linear)
            texture_linear_row(texture, y, row);
        else
            texture_row(texture, y, false, row);
        double *to = LIST_ADD(numbers->arena, numbers->out, (uint32_t)texture->width);
        for (int x = 0; x < texture->width; x++)
            to[x] = row[x];
    }
    return true;
}

static void add_pattern(Numbers *numbers, const ListSource *source, double alpha) {
    const ListImage *image = &numbers->list->images.at[source->image];
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
            add_undrawn(numbers, other_node);
    }
}

static void add_gradient(Numbers *numbers, const ListSource *source, double alpha) {
    if (source->kind == SOURCE_LINEAR) {
        ADD(PETRI_DRAW_LINEAR, source->ends[0], source->ends[1], source->ends[2], source->ends[3]);
    } else {
        ADD(PETRI_DRAW_RADIAL);
        add_matrix(numbers, &source->matrix);
    }
    ADD(alpha, source->stop_count);
    for (uint32_t i = 0; i < source->stop_count; i++) {
        const ListStop *stop = &numbers->list->stops.at[source->first_stop + i];
        ADD(stop->offset, stop->color[0], stop->color[1], stop->color[2], stop->color[3]);
    }
}

// Blends of blends are no deeper than scripts can nest them.
static void add_source(Numbers *numbers, const ListSource *source, double alpha) {
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

static void add_filter(Numbers *numbers, uint32_t number);

static void add_paint(Numbers *numbers, const ListPaint *paint) {
    const ListEffect *effect = paint->effect == LIST_NONE ? NULL : &numbers->list->effects.at[paint->effect];
    const double *c = paint->color;
    if (paint->source == LIST_NONE)
        ADD(PETRI_DRAW_COLOR, c[0], c[1], c[2], c[3]);
    else
        add_source(numbers, &numbers->list->sources.at[paint->source], fmin(fmax(c[3], 0), 1));
    ADD(PETRI_DRAW_LINE, paint->stroke_width, paint->join, paint->cap, paint->composite, paint->antialias);
    ADD(effect && effect->kind == EFFECT_DASH ? effect->count : 0, effect ? effect->amounts[0] : 0);
    if (effect && effect->kind == EFFECT_DASH)
        add(numbers, numbers->list->numbers.at + effect->numbers, effect->count);
    if (paint->filter != LIST_NONE) {
        ADD(PETRI_DRAW_FILTER);
        add_filter(numbers, paint->filter);
    }
}

static void add_blend(Numbers *numbers, const ListFilter *filter) {
    if (filter->numbers == LIST_NONE) {
        ADD(filter->mode);
    } else {
        ADD(-1);
        add(numbers, numbers->list->numbers.at + filter->numbers, 4);
    }
}

// Kinds are those of ListFilterKind.
static void add_filter(Numbers *numbers, uint32_t number) {
    if (number == LIST_NONE) {
        ADD(PETRI_FILTER_DRAWN);
        return;
    }
    const ListFilter *filter = &numbers->list->filters.at[number];
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
    case FILTER_MATRIX:
        add(numbers, numbers->list->numbers.at + filter->numbers, 20);
        break;
    case FILTER_PAINT: {
        ListPaint paint = numbers->list->paints.at[filter->paint];
        paint.filter = paint.effect = LIST_NONE;
        add_paint(numbers, &paint);
        return;
    }
    case FILTER_BLEND:
        add_blend(numbers, filter);
        break;
    case FILTER_DRAWN:
        return;
    }
    add_filter(numbers, filter->inputs[0]);
    if (filter->kind == FILTER_BLEND)
        add_filter(numbers, filter->inputs[1]);
}

static void add_letters(Numbers *numbers, const ListCommand *command) {
    const ListText *text = &numbers->list->texts.at[command->item];
    if (outline_has_effect(numbers->list, &numbers->list->paints.at[command->paint]))
        add_undrawn(numbers, "a path effect on text");
    ADD(PETRI_DRAW_TEXT, command->fill, command->stroke, text->point[0], text->point[1], text->size, text->weight,
        text->width, text->slant, text->center);
    add_text(numbers, str_from(text->family ? text->family : ""));
    add_text(numbers, text->text);
}

static void add_image(Numbers *numbers, const ListImage *image) {
    uint32_t start = numbers->out.count;
    ADD(image->file.len > 0 ? PETRI_DRAW_IMAGE : PETRI_DRAW_PIXELS, image->point[0], image->point[1], image->size[0],
        image->size[1], image->fit);
    if (image->file.len > 0) {
        add_text(numbers, image->file);
    } else if (!add_pixels(numbers, image->id)) {
        numbers->out.count = start;
        if (!numbers->painter)
            add_undrawn(numbers, other_node);
    }
}

static void add_outline(Numbers *numbers, const Outline *outline) {
    uint32_t count_at = numbers->out.count;
    ADD(0);
    for (uint32_t i = 0; i < outline->pieces.count; i++) {
        const OutlinePiece *piece = &outline->pieces.at[i];
        const OutlinePoint *p = piece->points;
        if (piece->kind == PIECE_CURVE_3)
            ADD(PETRI_PIECE_CURVE_3, p[0].x, p[0].y, p[1].x, p[1].y, p[2].x, p[2].y);
        else if (piece->kind == PIECE_CLOSE)
            ADD(PETRI_PIECE_CLOSE);
        else
            ADD(piece->kind, p[0].x, p[0].y);
    }
    numbers->out.at[count_at] = numbers->out.count - count_at - 1;
}

// What a path effect makes of a figure. Where lines are drawn otherwise than what they enclose, they are one of their
// own.
static void add_changed(Numbers *numbers, const ListCommand *command, const ListPaint *paint) {
    const List *list = numbers->list;
    const ListMatrix *m = &list->matrices.at[command->matrix];
    const ListEffect *effect = &list->effects.at[paint->effect];
    uint32_t number = effect->kind == EFFECT_DASH ? effect->inner : paint->effect; // the last dashes are the host's
    Outline from = {.arena = numbers->arena, .fine = 2 / fmax(sqrt(fabs(m->xx * m->yy - m->xy * m->yx)), 1e-6)};
    outline_take(&from, list, &command->path);
    bool apart = outline_has_dashes(list, number) && command->fill && command->stroke;
    for (int part = 0; part < 1 + apart; part++) {
        bool fill = command->fill && part == 0, stroke = command->stroke && part == apart;
        Outline outline = outline_apply(list, number, from, !fill);
        ADD(PETRI_DRAW_FIGURE, fill, stroke, command->path.fill_type);
        add_outline(numbers, &outline);
        numbers->changed += outline.pieces.count;
    }
    if (numbers->changed > MOST_CHANGED)
        add_undrawn(numbers, "path effects on more than two million pieces");
}

static void add_figure(Numbers *numbers, const ListCommand *command) {
    const ListPaint *paint = &numbers->list->paints.at[command->paint];
    if (numbers->changed <= MOST_CHANGED && outline_has_effect(numbers->list, paint)) {
        add_changed(numbers, command, paint);
        return;
    }
    ADD(PETRI_DRAW_FIGURE, command->fill, command->stroke, command->path.fill_type);
    add_path(numbers, &command->path);
}

static void add_command(Numbers *numbers, const ListCommand *command) {
    if (command->kind < LIST_SAVE && command->matrix != numbers->matrix) {
        ADD(PETRI_DRAW_MATRIX);
        add_matrix(numbers, &numbers->list->matrices.at[command->matrix]);
        numbers->matrix = command->matrix;
    }
    if (command->kind < LIST_SAVE && command->paint != numbers->paint) {
        add_paint(numbers, &numbers->list->paints.at[command->paint]);
        numbers->paint = command->paint;
    }
    switch (command->kind) {
    case LIST_DRAW:
        add_figure(numbers, command);
        break;
    case LIST_TEXT:
        add_letters(numbers, command);
        break;
    case LIST_IMAGE:
        add_image(numbers, &numbers->list->images.at[command->item]);
        break;
    case LIST_CLIP:
    case LIST_MASK: {
        bool outside = (command->kind == LIST_MASK) != (command->path.fill_type > FILL_EVEN_ODD);
        ADD(PETRI_DRAW_CLIP, outside, command->path.fill_type & 1);
        add_path(numbers, &command->path);
        break;
    }
    case LIST_SAVE:
        ADD(PETRI_DRAW_SAVE);
        break;
    case LIST_RESTORE: // brings matrix and paint back that were there
        numbers->matrix = numbers->paint = LIST_NONE;
        ADD(PETRI_DRAW_RESTORE);
        break;
    case LIST_LAYER:
        numbers->matrix = numbers->paint = LIST_NONE;
        ADD(PETRI_DRAW_LAYER);
        break;
    case LIST_LAYER_END:
        numbers->matrix = numbers->paint = LIST_NONE;
        ADD(PETRI_DRAW_LAYER_END, command->alpha);
        break;
    }
}

static void add_system(Numbers *numbers, const AutoSystem *system) {
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
}

// The first canvas below a node; what else there is, is told once.
static const DrawNode *find_canvas(Numbers *numbers, const DrawNode *node, int depth) {
    enum { DEEPEST = 100 };
    if (node->kind == KIND_CANVAS || depth > DEEPEST)
        return node->kind == KIND_CANVAS ? node : NULL;
    if (!(node->kind == KIND_WINDOW || node->kind == KIND_OFFSCREEN || node->kind == KIND_RECORD))
        add_undrawn(numbers, schema_kinds[node->kind].name);
    const DrawNode *found = NULL;
    for (uint32_t i = 0; i < node->child_count; i++) {
        const DrawNode *child = node->children[i];
        if (child->kind == KIND_POINTER || child->kind == KIND_KEY || child->kind == KIND_REFERENCE)
            continue;
        if (found)
            add_undrawn(numbers, schema_kinds[child->kind].name);
        else
            found = find_canvas(numbers, child, depth + 1);
    }
    return found;
}

static void add_canvas(Numbers *numbers, const DrawNode *canvas) {
    ListSizes sizes = {0};
    if (draw_flag(canvas, ATTR_LINEAR) && draw_number(canvas, ATTR_COLORBITS) > 8)
        add_undrawn(numbers, "light beyond 1 (colorbits)");
    numbers->list = list_build(numbers->arena, canvas, &sizes);
    for (uint32_t i = 0; i < numbers->list->commands.count; i++)
        add_command(numbers, &numbers->list->commands.at[i]);
}

static void make(void *context) {
    Numbers *numbers = context;
    const CanvasPicture *canvases = numbers->picture;
    ADD(canvases->width, canvases->height);
    if (canvases->automatic) {
        ADD(PETRI_DRAW_SYSTEMS, canvases->automatic->count);
        for (uint32_t i = 0; i < canvases->automatic->count; i++)
            add_system(numbers, &canvases->automatic->systems[i]);
        return;
    }
    const DrawNode *canvas = find_canvas(numbers, canvases->window, 0);
    if (canvas)
        add_canvas(numbers, canvas);
}

const double *draw_canvas_numbers(PetriPainter *painter, const DrawNode *canvas, double width, double height,
                                  size_t *count) {
    Numbers made = {.painter = painter, .arena = &painter->arena, .matrix = LIST_NONE, .paint = LIST_NONE};
    Numbers *numbers = &made;
    ADD(width, height);
    add_canvas(numbers, canvas);
    *count = made.out.count;
    return made.out.at;
}

const double *draw_picture_numbers(Arena *arena, const CanvasPicture *picture, size_t *count) {
    Numbers made = {.picture = picture, .arena = arena, .matrix = LIST_NONE, .paint = LIST_NONE};
    make(&made);
    *count = made.out.count;
    return made.out.at;
}

bool petri_picture_is_numbers(const PetriPicture *picture) {
    return picture && (!picture->picture.window || (picture->picture.direct && !picture->picture.looks_back));
}

PetriStatus petri_picture_numbers(PetriPicture *picture, const double **numbers, size_t *count) {
    if (!picture || !numbers || !count)
        return PETRI_INVALID;
    Numbers made = {.picture = &picture->picture, .arena = &picture->arena, .matrix = LIST_NONE, .paint = LIST_NONE};
    Arena *arenas[] = {&picture->arena};
    bool done = arena_protect(arenas, 1, make, &made) == ARENA_DONE;
    *numbers = done ? made.out.at : NULL;
    *count = done ? made.out.count : 0;
    return done ? PETRI_OK : PETRI_MEMORY;
}
