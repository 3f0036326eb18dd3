// path_effects.c: applies path effects to paths before Cairo draws them (spec canvas.md 7, outline.h).
#include "draw/draw.h"
#include "draw/outline.h"

#include <math.h>

bool draw_has_effect(const Canvas *canvas, const DisplayPaint *paint) {
    return outline_has_effect(canvas->list, paint);
}

static void read_cairo_path(Outline *out, const cairo_path_t *path) {
    for (int i = 0; i < path->num_data; i += path->data[i].header.length) {
        static const PathElement kinds[] = {PATH_MOVE, PATH_LINE, PATH_CUBIC, PATH_CLOSE};
        const cairo_path_data_t *data = &path->data[i];
        OutlineElement *element = DISPLAY_ADD(out->arena, out->elements, 1);
        *element = (OutlineElement){.kind = kinds[data->header.type]};
        for (int k = 1; k < data->header.length; k++)
            element->points[k - 1] = (OutlinePoint){data[k].point.x, data[k].point.y};
    }
}

typedef struct Task {
    Canvas *canvas;
    uint32_t effect;
    const cairo_path_t *path;
    bool lines;
} Task;

static void apply_protected(void *context) {
    const Task *task = context;
    Canvas *canvas = task->canvas;
    const DisplayList *list = canvas->list;
    Outline from = {.arena = &canvas->painter->arena, .fine = 2 / fmax(draw_scale_of(canvas->cr), 1e-6)};
    read_cairo_path(&from, task->path);
    Outline outline = outline_apply(list, task->effect, from, task->lines);
    if (task->effect != DISPLAY_NONE && !draw_charge(canvas, NULL, 800.0 * outline.elements.count, draw_omitted))
        return; // nothing is drawn, because drawing the result would cost about as much again
    for (uint32_t i = 0; i < outline.elements.count; i++) {
        const OutlineElement *element = &outline.elements.at[i];
        double numbers[6];
        for (int k = 0; k < 3; k++) {
            numbers[2 * k] = element->points[k].x;
            numbers[2 * k + 1] = element->points[k].y;
        }
        draw_add_element(canvas, element->kind, numbers);
    }
}

bool draw_apply_effect(Canvas *canvas, const DisplayPaint *paint, const cairo_path_t *path, bool lines) {
    const DisplayEffect *effect = &canvas->list->effects.at[paint->effect];
    Arena *arena = &canvas->painter->arena;
    // Cairo itself draws dashes that are the outermost effect of a stroke.
    Task task = {canvas, effect->kind == EFFECT_DASH ? effect->inner : paint->effect, path, lines};
    ArenaMark mark = arena_mark(arena);
    draw_forget_path(canvas);
    if (!draw_charge(canvas, &effect->place, 0, "the path is drawn without the effect"))
        task.effect = DISPLAY_NONE;
    bool done = arena_protect(&arena, 1, apply_protected, &task) == ARENA_OK;
    arena_rewind(arena, mark);
    return done;
}
