// paint.c: paints the shapes of commands, with all composite modes.
#include "cairo/hdr_composite.h"
#include "picture/blend.h"

#include <math.h>
#include <string.h>

// Returns true for modes that change pixels outside the shape, unless Cairo itself restricts them to the shape.
// Modulate is one of them, for which Cairo has no operator.
static bool is_unbounded(int composite) {
    return !blend_is_bounded((CompositeMode)composite) && composite != COMPOSITE_CLEAR && composite != COMPOSITE_SRC;
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
static void draw_through_mask(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    draw_set_source(canvas, paint); // set before the mask is created, because setting it can abort the drawing
    cairo_save(cr);
    draw_clip_to_box(canvas, shape, paint);
    cairo_pattern_t *mask = draw_make_mask(canvas, shape, paint);
    bool separate = is_unbounded((int)paint->style.mode) && !canvas->vector;
    cairo_set_operator(cr, draw_operator((int)paint->style.mode));
    if (separate) {
        cairo_pattern_t *all = combine_all(canvas, cairo_get_group_target(cr), (int)paint->style.mode);
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
    return paint->style.mode == COMPOSITE_OVER && display_paint_is_plain(paint) && display_paint_alpha(paint) >= 1;
}

void draw_current_path(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    if (!draw_is_drawable(canvas))
        return;
    if (canvas->hdr_target.pixels) {
        hdr_draw_path(canvas, shape, paint);
        return;
    }
    if (!draw_charge_path(canvas, paint, shape->fill != 0, shape->stroke != 0))
        return;
    bool odd = is_unbounded((int)paint->style.mode), both = shape->fill != 0 && shape->stroke != 0;
    // The segments of a long stroke overlap, which is visible unless the paint is solid.
    bool in_segments = shape->stroke != 0 && draw_strokes_in_segments(canvas);
    if (odd || (int)shape->rule > FILL_EVEN_ODD || ((both || in_segments) && !is_solid(paint))) {
        draw_through_mask(canvas, shape, paint);
        return;
    }
    draw_set_source(canvas, paint);
    cairo_set_operator(cr, draw_operator((int)paint->style.mode));
    draw_fill_and_stroke(canvas, shape, paint);
}
