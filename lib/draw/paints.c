// paints.c: colours, gradients, lines, ways to combine colours.
#include "draw/draw.h"

#include <math.h>
#include <string.h>

cairo_operator_t draw_operator(int composite) {
    static const cairo_operator_t operators[] = {
#define COMPOSITE(id, operator, text) operator,
#include "schema/composite_list.h"
    };
    return operators[composite];
}

// These change what lies outside of the shape as well, unless they are clipped to it.
static bool is_unbounded(int composite) {
    return composite == COMPOSITE_IN || composite == COMPOSITE_OUT || composite == COMPOSITE_DST_IN ||
           composite == COMPOSITE_DST_ATOP;
}

static void add_stops(cairo_pattern_t *pattern, const DrawNode *gradient) {
    uint32_t count = gradient->child_count;
    for (uint32_t i = 0; i < count; i++) {
        const DrawNode *stop = gradient->children[i];
        double even = count > 1 ? (double)i / (count - 1) : 0;
        const AttrValue *color = draw_attr(stop, ATTR_COLOR);
        double grey = schema_row(KIND_STOP, ATTR_COLOR)->fallback.value, offset = draw_number(stop, ATTR_OFFSET);
        const double *c = color ? color->as.numbers : (const double[4]){grey, grey, grey, 1};
        cairo_pattern_add_color_stop_rgba(pattern, isnan(offset) ? even : offset, c[0], c[1], c[2], c[3]);
    }
}

static void set_gradient(Canvas *canvas, const DrawNode *gradient) {
    double start[2], end[2], middle[2];
    draw_pair(gradient, ATTR_START, start);
    draw_pair(gradient, ATTR_POINT, middle);
    double radius = draw_number(gradient, ATTR_RADIUS); // nan: it has none
    cairo_pattern_t *pattern;
    if (radius >= 0) {
        pattern = cairo_pattern_create_radial(middle[0], middle[1], 0, middle[0], middle[1], radius);
    } else {
        draw_pair(gradient, ATTR_END, end);
        pattern = cairo_pattern_create_linear(start[0], start[1], end[0], end[1]);
    }
    add_stops(pattern, gradient);
    cairo_set_source(canvas->cr, pattern);
    cairo_pattern_destroy(pattern);
}

void draw_set_edges(Canvas *canvas, const Look *look) {
    cairo_set_antialias(canvas->cr, look->antialias ? CAIRO_ANTIALIAS_DEFAULT : CAIRO_ANTIALIAS_NONE);
    cairo_set_fill_rule(canvas->cr,
                        look->fill_type == FILL_EVEN_ODD ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
}

static void set_paint(Canvas *canvas, const Look *look) {
    cairo_t *cr = canvas->cr;
    if (look->source)
        set_gradient(canvas, look->source);
    else
        cairo_set_source_rgba(cr, look->color[0], look->color[1], look->color[2], look->color[3]);
    cairo_set_operator(cr, draw_operator(look->composite));
    draw_set_edges(canvas, look);
}

// Filling takes a time that grows with the rows that the edges cross, and faster where they cross each other: a path of
// a million points all over the picture would take hours.
static const double SMOOTH_WORK = 1e6; // about a second
static const double MOST_WORK = 1e7;   // some seconds without smooth edges

// Whether the path can be drawn in reasonable time; if not, the picture fails.
static bool is_drawable(Canvas *canvas) {
    if (canvas->path_work > MOST_WORK && !canvas->failed) {
        draw_fault(canvas, DIAG_ERROR, "path-limit",
                   "a path is too complex to be drawn: it has too many points that are too far apart");
        canvas->failed = true;
    }
    return !canvas->failed;
}

void draw_fill(Canvas *canvas, const Look *look) {
    cairo_t *cr = canvas->cr;
    if (!is_drawable(canvas))
        return;
    set_paint(canvas, look);
    if (canvas->path_work > SMOOTH_WORK)
        cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
    if (is_unbounded(look->composite)) {
        cairo_save(cr);
        cairo_clip_preserve(cr);
        cairo_paint(cr);
        cairo_restore(cr);
    } else {
        cairo_fill_preserve(cr);
    }
}

static void set_line(Canvas *canvas, const Look *look) {
    static const cairo_line_join_t joins[] = {CAIRO_LINE_JOIN_MITER, CAIRO_LINE_JOIN_ROUND, CAIRO_LINE_JOIN_BEVEL};
    static const cairo_line_cap_t caps[] = {CAIRO_LINE_CAP_BUTT, CAIRO_LINE_CAP_ROUND, CAIRO_LINE_CAP_SQUARE};
    cairo_set_line_join(canvas->cr, joins[look->join]);
    cairo_set_miter_limit(canvas->cr, 4); // as Flitter's canvas has it
    cairo_set_line_cap(canvas->cr, caps[look->cap]);
}

static void stroke_path(Canvas *canvas, const Look *look) {
    enum { WIDEST = 100000 }; // pixels: more cannot be seen, and Cairo's coordinates end somewhere
    cairo_t *cr = canvas->cr;
    double scale = draw_scale_of(cr);
    if (look->stroke_width > 0) {
        cairo_set_line_width(cr, fmin(look->stroke_width, WIDEST / scale));
        cairo_stroke_preserve(cr);
        return;
    }
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_line_width(cr, 1);
    cairo_stroke_preserve(cr);
    cairo_restore(cr);
}

// Strokes a long path in pieces, which is much faster than as a whole. Each piece begins with the end of the one
// before, so that the corners between them are drawn.
static void stroke_pieces(Canvas *canvas, const Look *look) {
    enum { PIECE = 16 };
    cairo_t *cr = canvas->cr;
    cairo_path_t *path = cairo_copy_path_flat(cr);
    double points[PIECE + 1][2], first[2] = {0, 0};
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
        if (moves || count == PIECE + 1 || last) {
            cairo_new_path(cr);
            for (int k = 0; k < count; k++)
                cairo_line_to(cr, points[k][0], points[k][1]);
            stroke_path(canvas, look);
            int kept = moves || count < 2 ? 0 : 2;
            for (int k = 0; k < kept; k++)
                memcpy(points[k], points[count - kept + k], sizeof points[k]);
            count = kept;
        }
        if (moves) {
            first[0] = points[0][0] = x;
            first[1] = points[0][1] = y;
            count = 1;
        }
    }
    cairo_path_destroy(path);
}

// Pieces overlap: they are drawn into a mask, through which the colour is then painted once.
static void stroke_long(Canvas *canvas, const Look *look) {
    cairo_t *cr = canvas->cr;
    KeptPath kept = draw_keep_path(canvas);
    if (kept.path)
        cairo_append_path(cr, kept.path);
    cairo_push_group_with_content(cr, CAIRO_CONTENT_ALPHA);
    cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
    cairo_set_source_rgba(cr, 0, 0, 0, 1);
    stroke_pieces(canvas, look);
    cairo_pattern_t *mask = cairo_pop_group(cr);
    set_paint(canvas, look);
    cairo_mask(cr, mask);
    cairo_pattern_destroy(mask);
    draw_put_back_path(canvas, kept);
}

// A line cannot be clipped to, so it becomes a mask for what is made of all that is there.
static void stroke_unbounded(Canvas *canvas, const Look *look) {
    cairo_t *cr = canvas->cr;
    cairo_surface_t *below = cairo_get_group_target(cr);
    cairo_push_group_with_content(cr, CAIRO_CONTENT_ALPHA);
    cairo_set_operator(cr, CAIRO_OPERATOR_OVER);
    cairo_set_source_rgba(cr, 0, 0, 0, 1);
    stroke_path(canvas, look);
    cairo_pattern_t *mask = cairo_pop_group(cr);
    cairo_push_group(cr);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_operator(cr, CAIRO_OPERATOR_SOURCE);
    cairo_set_source_surface(cr, below, 0, 0);
    cairo_paint(cr);
    cairo_restore(cr);
    set_paint(canvas, look);
    cairo_paint(cr);
    cairo_pop_group_to_source(cr);
    cairo_set_operator(cr, CAIRO_OPERATOR_SOURCE);
    cairo_mask(cr, mask);
    cairo_pattern_destroy(mask);
}

void draw_stroke(Canvas *canvas, const Look *look) {
    if (!is_drawable(canvas))
        return;
    set_paint(canvas, look);
    set_line(canvas, look);
    if (canvas->path_work > SMOOTH_WORK && !canvas->vector)
        stroke_long(canvas, look);
    else if (is_unbounded(look->composite) && !canvas->vector)
        stroke_unbounded(canvas, look);
    else
        stroke_path(canvas, look);
}

void draw_clip(Canvas *canvas, const Look *look) {
    if (!is_drawable(canvas))
        return;
    draw_set_edges(canvas, look);
    cairo_clip_preserve(canvas->cr);
}

void draw_paint(Canvas *canvas, int composite, double alpha) {
    cairo_set_operator(canvas->cr, draw_operator(composite));
    cairo_paint_with_alpha(canvas->cr, fmin(fmax(alpha, 0), 1));
}
