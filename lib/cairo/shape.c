// shape.c: the shape of a command: its path, changed by a path effect (spec canvas.md 7), filled and stroked with the
// current source and operator.
#include "cairo/canvas.h"
#include "picture/outline.h"

#include <math.h>
#include <string.h>

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
    const double *effect; // NULL: none
    const cairo_path_t *path;
    bool lines;
} Task;

static void apply_protected(void *context) {
    const Task *task = context;
    Canvas *canvas = task->canvas;
    Outline from = {.arena = &canvas->painter->arena, .fine = 2 / fmax(draw_scale_of(canvas->cr), 1e-6)};
    read_cairo_path(&from, task->path);
    Outline outline = task->effect ? outline_apply(task->effect, from, task->lines) : from;
    if (task->effect && !draw_charge(canvas, NULL, 800.0 * outline.elements.count, draw_omitted))
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

// Applies the paint's effect to a path and makes the result the current path. If `lines` is true, the result is for
// stroking, otherwise for filling. Returns false if out of memory.
static bool apply_effect(Canvas *canvas, const DisplayPaint *paint, const cairo_path_t *path, bool lines) {
    Arena *arena = &canvas->painter->arena;
    Origin place = display_list_note(canvas->list, paint->effect.at).place;
    Task task = {canvas, paint->effect.at, path, lines};
    ArenaMark mark = arena_mark(arena);
    draw_forget_path(canvas);
    if (!draw_charge(canvas, &place, 0, "the path is drawn without the effect"))
        task.effect = NULL;
    bool done = arena_protect(&arena, 1, apply_protected, &task) == ARENA_OK;
    arena_rewind(arena, mark);
    return done;
}

void draw_set_edges(Canvas *canvas, bool antialias, int fill_type) {
    bool even_odd = fill_type == FILL_EVEN_ODD || fill_type == FILL_INVERSE_EVEN_ODD;
    cairo_set_antialias(canvas->cr, antialias ? CAIRO_ANTIALIAS_DEFAULT : CAIRO_ANTIALIAS_NONE);
    cairo_set_fill_rule(canvas->cr, even_odd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
}

// The time to fill a path grows with the number of rows that its edges cross, and faster if edges cross each other. A
// path of a million points all over the picture would take hours.
static const double SMOOTH_WORK = 1e6; // maximum path_work with antialiasing; a path at this limit takes about a second
static const double MAX_WORK = 1e7; // maximum path_work without antialiasing; a path at this limit takes a few seconds

bool draw_strokes_in_segments(const Canvas *canvas) {
    return canvas->path_work > SMOOTH_WORK;
}

bool draw_is_drawable(Canvas *canvas) {
    if (canvas->path_work > MAX_WORK && !canvas->failed) {
        draw_report(canvas, NULL, DIAG_ERROR, "path-limit",
                    "the picture cannot be drawn: a path has too many points that are far apart");
        canvas->failed = true;
    }
    return !canvas->failed;
}

static void set_stroke_style(Canvas *canvas, const DisplayPaint *paint) {
    static const cairo_line_join_t joins[] = {CAIRO_LINE_JOIN_MITER, CAIRO_LINE_JOIN_ROUND, CAIRO_LINE_JOIN_BEVEL};
    static const cairo_line_cap_t caps[] = {CAIRO_LINE_CAP_BUTT, CAIRO_LINE_CAP_ROUND, CAIRO_LINE_CAP_SQUARE};
    const STROKE_STYLEOperands *style = &paint->style;
    cairo_set_line_join(canvas->cr, joins[(int)style->join]);
    cairo_set_miter_limit(canvas->cr, 4);
    cairo_set_line_cap(canvas->cr, caps[(int)style->cap]);
    cairo_set_dash(canvas->cr, style->dashes.at, (int)style->dashes.count, style->dash_offset);
}

static void stroke_path(Canvas *canvas, const DisplayPaint *paint) {
    enum { MAX_WIDTH = 100000 }; // in pixels; wider lines look the same and could exceed Cairo's range of coordinates
    cairo_t *cr = canvas->cr;
    double scale = draw_scale_of(cr);
    if (paint->style.width > 0) {
        cairo_set_line_width(cr, fmin(paint->style.width, MAX_WIDTH / scale));
        cairo_stroke_preserve(cr);
        return;
    }
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_line_width(cr, 1);
    cairo_stroke_preserve(cr);
    cairo_restore(cr);
}

// Strokes a long path in segments, which is much faster than stroking it at once. Each segment starts with the last
// line of the previous one, so that the joins between segments are drawn.
static void stroke_in_segments(Canvas *canvas, const DisplayPaint *paint) {
    enum { SEGMENT = 16 };
    cairo_t *cr = canvas->cr;
    cairo_path_t *path = cairo_copy_path_flat(cr);
    double points[SEGMENT + 1][2], first[2] = {0, 0};
    int count = 0;
    for (int i = 0; i < path->num_data; i += path->data[i].header.length) {
        const cairo_path_data_t *data = &path->data[i];
        bool moves = data->header.type == CAIRO_PATH_MOVE_TO, closes = data->header.type == CAIRO_PATH_CLOSE_PATH;
        bool last = i + data->header.length >= path->num_data;
        double x = closes ? first[0] : data[1].point.x, y = closes ? first[1] : data[1].point.y;
        if (!moves) {
            points[count][0] = x;
            points[count++][1] = y;
        }
        if (moves || count == SEGMENT + 1 || last) {
            cairo_new_path(cr);
            for (int k = 0; k < count; k++)
                cairo_line_to(cr, points[k][0], points[k][1]);
            stroke_path(canvas, paint);
            int tail = moves || count < 2 ? 0 : 2;
            for (int k = 0; k < tail; k++)
                memcpy(points[k], points[count - tail + k], sizeof points[k]);
            count = tail;
        }
        if (moves) {
            first[0] = points[0][0] = x;
            first[1] = points[0][1] = y;
            count = 1;
        }
    }
    cairo_path_destroy(path);
}

static void fill_part(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    draw_set_edges(canvas, paint->style.antialias != 0 && canvas->path_work <= SMOOTH_WORK, (int)shape->rule);
    cairo_fill_preserve(canvas->cr);
}

static void stroke_part(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    draw_set_edges(canvas, paint->style.antialias != 0, (int)shape->rule);
    set_stroke_style(canvas, paint);
    if (canvas->path_work > SMOOTH_WORK && !canvas->vector && cairo_get_dash_count(canvas->cr) == 0) {
        stroke_in_segments(canvas, paint);
        canvas->path.at = NULL; // the current path is now only the last segment
    } else {
        stroke_path(canvas, paint);
    }
}

// Applies a path effect, then fills and strokes the result. The effect can produce different paths for filling and
// stroking.
static void draw_with_effect(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    cairo_path_t *path = cairo_copy_path(canvas->cr);
    bool lacking = false;
    for (int lines = 0; lines < 2; lines++) {
        if (!((lines ? shape->stroke : shape->fill) != 0))
            continue;
        if (!apply_effect(canvas, paint, path, lines)) {
            lacking = true;
            draw_forget_path(canvas);
            cairo_append_path(canvas->cr, path);
        }
        if (draw_is_drawable(canvas))
            (lines ? stroke_part : fill_part)(canvas, shape, paint);
    }
    cairo_path_destroy(path);
    draw_forget_path(canvas);
    Origin place = display_list_note(canvas->list, paint->effect.at).place;
    draw_report_degraded(canvas, &place, "the path effect", lacking);
}

void draw_fill_and_stroke(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    if (paint->effect.count > 0) {
        draw_with_effect(canvas, shape, paint);
        return;
    }
    if (shape->fill != 0)
        fill_part(canvas, shape, paint);
    if (shape->stroke != 0)
        stroke_part(canvas, shape, paint);
}

bool draw_find_box(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint, double box[4]) {
    cairo_t *cr = canvas->cr;
    cairo_matrix_t matrix;
    if ((int)shape->rule > FILL_EVEN_ODD || paint->effect.count > 0)
        return false;
    cairo_get_matrix(cr, &matrix);
    double wide =
        fmax(fmax(fabs(matrix.xx) + fabs(matrix.xy), fabs(matrix.yx) + fabs(matrix.yy)) * paint->style.width, 1);
    double border = shape->stroke != 0 ? 2 * wide + 2 : 2; // miters reach two line widths, because the miter limit is 4
    cairo_identity_matrix(cr);
    cairo_path_extents(cr, &box[0], &box[1], &box[2], &box[3]);
    cairo_set_matrix(cr, &matrix);
    for (int k = 0; k < 2; k++) {
        box[k] = floor(box[k] - border);
        box[2 + k] = ceil(box[2 + k] + border);
    }
    return true;
}

void draw_clip_to_box(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    double box[4];
    if (!draw_find_box(canvas, shape, paint, box))
        return;
    cairo_path_t *path = cairo_copy_path(cr);
    cairo_matrix_t matrix;
    cairo_get_matrix(cr, &matrix);
    cairo_identity_matrix(cr);
    cairo_new_path(cr);
    cairo_rectangle(cr, box[0], box[1], box[2] - box[0], box[3] - box[1]);
    cairo_clip(cr);
    cairo_set_matrix(cr, &matrix);
    cairo_append_path(cr, path);
    cairo_path_destroy(path);
}

cairo_pattern_t *draw_make_mask(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    cairo_push_group_with_content(cr, CAIRO_CONTENT_ALPHA);
    cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
    cairo_set_source_rgba(cr, 0, 0, 0, 1);
    if ((int)shape->rule > FILL_EVEN_ODD && shape->fill != 0) {
        cairo_paint(cr);
        cairo_set_operator(cr, CAIRO_OPERATOR_DEST_OUT);
    }
    draw_fill_and_stroke(canvas, shape, paint);
    return cairo_pop_group(cr);
}
