// paints.c: colours, gradients, lines, ways to combine colours.
#include "canvas/draw.h"

#include <math.h>

cairo_operator_t draw_operator(int composite) {
    static const cairo_operator_t operators[] = {
#define COMPOSITE(id, operator) operator,
#include "canvas/composite_list.h"
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
        const DrawAttr *color = draw_attr(stop, NAME_COLOR);
        static const double white[4] = {1, 1, 1, 1};
        const double *c = color ? color->as.numbers : white;
        cairo_pattern_add_color_stop_rgba(pattern, draw_number(stop, NAME_OFFSET, even), c[0], c[1], c[2], c[3]);
    }
}

static void set_gradient(Canvas *canvas, const DrawNode *gradient) {
    double start[2], end[2], middle[2];
    draw_pair(gradient, NAME_START, start);
    draw_pair(gradient, NAME_POINT, middle);
    double radius = draw_number(gradient, NAME_RADIUS, -1);
    cairo_pattern_t *pattern;
    if (radius >= 0) {
        pattern = cairo_pattern_create_radial(middle[0], middle[1], 0, middle[0], middle[1], radius);
    } else {
        draw_pair(gradient, NAME_END, end);
        pattern = cairo_pattern_create_linear(start[0], start[1], end[0], end[1]);
    }
    add_stops(pattern, gradient);
    cairo_set_source(canvas->cr, pattern);
    cairo_pattern_destroy(pattern);
}

static void set_paint(Canvas *canvas, const Look *look) {
    cairo_t *cr = canvas->cr;
    if (look->source)
        set_gradient(canvas, look->source);
    else
        cairo_set_source_rgba(cr, look->color[0], look->color[1], look->color[2], look->color[3]);
    cairo_set_operator(cr, draw_operator(look->composite));
    cairo_set_antialias(cr, look->antialias ? CAIRO_ANTIALIAS_DEFAULT : CAIRO_ANTIALIAS_NONE);
    cairo_set_fill_rule(cr, look->fill_type == FILL_EVEN_ODD ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
}

void draw_fill(Canvas *canvas, const Look *look) {
    cairo_t *cr = canvas->cr;
    set_paint(canvas, look);
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
    set_paint(canvas, look);
    set_line(canvas, look);
    if (is_unbounded(look->composite) && !canvas->vector)
        stroke_unbounded(canvas, look);
    else
        stroke_path(canvas, look);
}

void draw_clip(Canvas *canvas, const Look *look) {
    cairo_set_antialias(canvas->cr, look->antialias ? CAIRO_ANTIALIAS_DEFAULT : CAIRO_ANTIALIAS_NONE);
    cairo_set_fill_rule(canvas->cr,
                        look->fill_type == FILL_EVEN_ODD ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
    cairo_clip_preserve(canvas->cr);
}

void draw_paint(Canvas *canvas, int composite, double alpha) {
    cairo_set_operator(canvas->cr, draw_operator(composite));
    cairo_paint_with_alpha(canvas->cr, fmin(fmax(alpha, 0), 1));
}
