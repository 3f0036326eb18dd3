// cairo_paint.c: filling and stroking with Cairo, with all composite modes.
#include "draw/hdr_composite.h"

#include <math.h>
#include <string.h>

cairo_operator_t draw_operator(int composite) {
    static const cairo_operator_t operators[] = {
#define COMPOSITE(id, operator, text, formula) operator,
#include "schema/composite_list.h"
    };
    return operators[composite];
}

// Returns true for operators that, in Cairo, also change pixels outside the shape. Petri restricts their effect to the
// shape.
static bool is_unbounded(int composite) {
    return composite == COMPOSITE_IN || composite == COMPOSITE_OUT || composite == COMPOSITE_DST_IN ||
           composite == COMPOSITE_DST_ATOP;
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

bool draw_is_drawable(Canvas *canvas) {
    if (canvas->path_work > MAX_WORK && !canvas->failed) {
        draw_report_canvas(canvas, DIAG_ERROR, "path-limit",
                           "the picture cannot be drawn: a path has too many points that are far apart");
        canvas->failed = true;
    }
    return !canvas->failed;
}

static void set_stroke_style(Canvas *canvas, const DisplayPaint *paint) {
    static const cairo_line_join_t joins[] = {CAIRO_LINE_JOIN_MITER, CAIRO_LINE_JOIN_ROUND, CAIRO_LINE_JOIN_BEVEL};
    static const cairo_line_cap_t caps[] = {CAIRO_LINE_CAP_BUTT, CAIRO_LINE_CAP_ROUND, CAIRO_LINE_CAP_SQUARE};
    cairo_set_line_join(canvas->cr, joins[paint->join]);
    cairo_set_miter_limit(canvas->cr, 4);
    cairo_set_line_cap(canvas->cr, caps[paint->cap]);
    const DisplayEffect *effect = paint->effect == DISPLAY_NONE ? NULL : &canvas->list->effects.at[paint->effect];
    if (effect && effect->kind == EFFECT_DASH)
        cairo_set_dash(canvas->cr, canvas->list->numbers.at + effect->numbers, (int)effect->count, effect->amounts[0]);
    else
        cairo_set_dash(canvas->cr, NULL, 0, 0);
}

static void stroke_path(Canvas *canvas, const DisplayPaint *paint) {
    enum { MAX_WIDTH = 100000 }; // in pixels; wider lines look the same and could exceed Cairo's range of coordinates
    cairo_t *cr = canvas->cr;
    double scale = draw_scale_of(cr);
    if (paint->stroke_width > 0) {
        cairo_set_line_width(cr, fmin(paint->stroke_width, MAX_WIDTH / scale));
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

static void fill_part(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    draw_set_edges(canvas, paint->antialias && canvas->path_work <= SMOOTH_WORK, command->path.fill_type);
    cairo_fill_preserve(canvas->cr);
}

static void stroke_part(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    draw_set_edges(canvas, paint->antialias, command->path.fill_type);
    set_stroke_style(canvas, paint);
    if (canvas->path_work > SMOOTH_WORK && !canvas->vector && cairo_get_dash_count(canvas->cr) == 0) {
        stroke_in_segments(canvas, paint);
        canvas->path_of = NULL; // the current path is now only the last segment
    } else {
        stroke_path(canvas, paint);
    }
}

// Applies a path effect, then fills and strokes the result. The effect can produce different paths for filling and
// stroking.
static void draw_with_effect(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    cairo_path_t *path = cairo_copy_path(canvas->cr);
    bool lacking = false;
    for (int lines = 0; lines < 2; lines++) {
        if (!(lines ? command->stroke : command->fill))
            continue;
        if (!draw_apply_effect(canvas, paint, path, lines)) {
            lacking = true;
            draw_forget_path(canvas);
            cairo_append_path(canvas->cr, path);
        }
        if (draw_is_drawable(canvas))
            (lines ? stroke_part : fill_part)(canvas, command, paint);
    }
    cairo_path_destroy(path);
    draw_forget_path(canvas);
    draw_report_degraded(canvas, &canvas->list->effects.at[paint->effect].place, "the path effect", lacking);
}

// Fills and strokes the current path with the current source and operator.
static void fill_and_stroke(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    if (draw_has_effect(canvas, paint)) {
        draw_with_effect(canvas, command, paint);
        return;
    }
    if (command->fill)
        fill_part(canvas, command, paint);
    if (command->stroke)
        stroke_part(canvas, command, paint);
}

bool draw_find_box(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint, double box[4]) {
    cairo_t *cr = canvas->cr;
    cairo_matrix_t matrix;
    if (command->path.fill_type > FILL_EVEN_ODD || draw_has_effect(canvas, paint))
        return false;
    cairo_get_matrix(cr, &matrix);
    double wide =
        fmax(fmax(fabs(matrix.xx) + fabs(matrix.xy), fabs(matrix.yx) + fabs(matrix.yy)) * paint->stroke_width, 1);
    double border = command->stroke ? 2 * wide + 2 : 2; // miters reach two line widths, because the miter limit is 4
    cairo_identity_matrix(cr);
    cairo_path_extents(cr, &box[0], &box[1], &box[2], &box[3]);
    cairo_set_matrix(cr, &matrix);
    for (int k = 0; k < 2; k++) {
        box[k] = floor(box[k] - border);
        box[2 + k] = ceil(box[2 + k] + border);
    }
    return true;
}

void draw_clip_to_box(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    double box[4];
    if (!draw_find_box(canvas, command, paint, box))
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

cairo_pattern_t *draw_make_mask(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    cairo_push_group_with_content(cr, CAIRO_CONTENT_ALPHA);
    cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
    cairo_set_source_rgba(cr, 0, 0, 0, 1);
    if (command->path.fill_type > FILL_EVEN_ODD && command->fill) {
        cairo_paint(cr);
        cairo_set_operator(cr, CAIRO_OPERATOR_DEST_OUT);
    }
    fill_and_stroke(canvas, command, paint);
    return cairo_pop_group(cr);
}

// Multiplies each pixel of d by the corresponding pixel of s. Returns false unless both are images of the same size.
static bool multiply_pixels(cairo_surface_t *d, cairo_surface_t *s) {
    if (cairo_surface_get_type(d) != CAIRO_SURFACE_TYPE_IMAGE ||
        cairo_surface_get_type(s) != CAIRO_SURFACE_TYPE_IMAGE ||
        cairo_image_surface_get_format(d) != CAIRO_FORMAT_ARGB32 ||
        cairo_image_surface_get_format(s) != CAIRO_FORMAT_ARGB32 ||
        cairo_image_surface_get_height(d) != cairo_image_surface_get_height(s) ||
        cairo_image_surface_get_stride(d) != cairo_image_surface_get_stride(s))
        return false;
    cairo_surface_flush(d);
    cairo_surface_flush(s);
    unsigned char *to = cairo_image_surface_get_data(d), *from = cairo_image_surface_get_data(s);
    size_t count = (size_t)cairo_image_surface_get_stride(d) * (size_t)cairo_image_surface_get_height(d);
    for (size_t i = 0; to && from && i < count; i++)
        to[i] = (unsigned char)((to[i] * from[i] + 127) / 255);
    cairo_surface_mark_dirty(d);
    return true;
}

// Composites the current source onto a copy of the whole target, and returns the result as a group.
static cairo_pattern_t *combine_all(Canvas *canvas, cairo_surface_t *below, int composite) {
    cairo_t *cr = canvas->cr;
    cairo_pattern_t *source = cairo_pattern_reference(cairo_get_source(cr)), *factor = NULL;
    if (composite == COMPOSITE_MODULATE) {
        cairo_push_group(cr);
        cairo_set_source(cr, source);
        cairo_set_operator(cr, CAIRO_OPERATOR_SOURCE);
        cairo_paint(cr);
        factor = cairo_pop_group(cr);
    }
    cairo_push_group(cr);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_operator(cr, CAIRO_OPERATOR_SOURCE);
    cairo_set_source_surface(cr, below, 0, 0);
    cairo_paint(cr);
    cairo_restore(cr);
    if (!factor) {
        cairo_set_source(cr, source);
        cairo_set_operator(cr, draw_operator(composite));
        cairo_paint(cr);
    }
    cairo_pattern_t *all = cairo_pop_group(cr);
    cairo_surface_t *d, *s;
    if (factor && cairo_pattern_get_surface(all, &d) == CAIRO_STATUS_SUCCESS &&
        cairo_pattern_get_surface(factor, &s) == CAIRO_STATUS_SUCCESS)
        multiply_pixels(d, s);
    if (factor)
        cairo_pattern_destroy(factor);
    cairo_pattern_destroy(source);
    return all;
}

// Renders the shape as a mask, and paints the source through it once.
static void draw_through_mask(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    draw_set_source(canvas, paint); // set before the mask is created, because setting it can abort the drawing
    cairo_save(cr);
    draw_clip_to_box(canvas, command, paint);
    cairo_pattern_t *mask = draw_make_mask(canvas, command, paint);
    bool separate = (is_unbounded(paint->composite) || paint->composite == COMPOSITE_MODULATE) && !canvas->vector;
    cairo_set_operator(cr, draw_operator(paint->composite));
    if (separate) {
        cairo_pattern_t *all = combine_all(canvas, cairo_get_group_target(cr), paint->composite);
        cairo_set_source(cr, all);
        cairo_pattern_destroy(all);
        cairo_set_operator(cr, CAIRO_OPERATOR_SOURCE);
    }
    cairo_mask(cr, mask);
    cairo_pattern_destroy(mask);
    cairo_restore(cr);
}

// Returns true if the paint is opaque, so that a fill followed by a stroke looks like one shape.
static bool is_solid(const DisplayPaint *paint) {
    return paint->composite == COMPOSITE_OVER && paint->source == DISPLAY_NONE && paint->color[3] >= 1;
}

void draw_current_path(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    if (!draw_is_drawable(canvas))
        return;
    if (canvas->hdr_target.pixels) {
        hdr_draw_path(canvas, command, paint);
        return;
    }
    if (!draw_charge_path(canvas, paint, command->fill, command->stroke))
        return;
    bool odd = is_unbounded(paint->composite) || paint->composite == COMPOSITE_MODULATE,
         both = command->fill && command->stroke;
    // The segments of a long stroke overlap, which is visible unless the paint is solid.
    bool in_segments = command->stroke && canvas->path_work > SMOOTH_WORK;
    if (odd || command->path.fill_type > FILL_EVEN_ODD || ((both || in_segments) && !is_solid(paint))) {
        draw_through_mask(canvas, command, paint);
        return;
    }
    draw_set_source(canvas, paint);
    cairo_set_operator(cr, draw_operator(paint->composite));
    fill_and_stroke(canvas, command, paint);
}
