// source.c: translates composite modes and paint sources of a display list to Cairo patterns.
#include "cairo/canvas.h"
#include "picture/noise.h"

#include <math.h>

static cairo_pattern_t *make_pattern(Canvas *canvas, const double *at);

static cairo_pattern_t *add_stops(cairo_pattern_t *pattern, DisplayStops stops, double alpha) {
    cairo_pattern_set_extend(pattern, CAIRO_EXTEND_PAD);
    for (uint32_t i = 0; i < stops.count; i++) {
        const DisplayStop *stop = &stops.at[i];
        cairo_pattern_add_color_stop_rgba(pattern, stop->offset, stop->color[0], stop->color[1], stop->color[2],
                                          stop->color[3] * alpha);
    }
    return pattern;
}

static void set_inverse(cairo_pattern_t *pattern, const DisplayMatrix *m) {
    cairo_matrix_t matrix = {m->xx, m->yx, m->xy, m->yy, m->x0, m->y0};
    cairo_matrix_invert(&matrix);
    cairo_pattern_set_matrix(pattern, &matrix);
}

static double clamp_unit(double x) {
    return x > 0 ? x < 1 ? x : 1 : 0;
}

// Creates a pattern of one colour. Premultiplied channels are rounded to the nearest byte, because Cairo would round
// down.
static cairo_pattern_t *make_color(const double color[4], double alpha) {
    double a = (int)(255 * clamp_unit(color[3]) * alpha + 0.5) / 255.0, c[3];
    for (int k = 0; k < 3; k++)
        c[k] = a > 0 ? (int)(255 * a * clamp_unit(color[k]) + 0.5) / (255 * a) : 0;
    return cairo_pattern_create_rgba(c[0], c[1], c[2], a);
}

static cairo_pattern_t *make_image(Canvas *canvas, const PATTERNOperands *source) {
    DrawImage image = draw_image_at(canvas, source->at, &source->file);
    cairo_surface_t *surface = draw_find_image(canvas, &image);
    if (!surface)
        return cairo_pattern_create_rgba(0, 0, 0, 0);
    cairo_pattern_t *pattern = cairo_pattern_create_for_surface(surface);
    cairo_surface_destroy(surface);
    cairo_pattern_set_extend(pattern, CAIRO_EXTEND_REPEAT);
    cairo_pattern_set_filter(pattern, CAIRO_FILTER_NEAREST);
    set_inverse(pattern, source->matrix);
    return pattern;
}

// Paints the area of the clip with a pattern, and destroys the pattern.
static void paint_with(Canvas *canvas, cairo_pattern_t *pattern, cairo_operator_t how, double alpha) {
    cairo_set_operator(canvas->cr, how);
    cairo_set_source(canvas->cr, pattern);
    cairo_paint_with_alpha(canvas->cr, alpha);
    cairo_pattern_destroy(pattern);
}

static cairo_pattern_t *make_blend(Canvas *canvas, const BLENDOperands *source) {
    bool mixed = source->ratio >= 0;
    cairo_push_group(canvas->cr);
    paint_with(canvas, make_pattern(canvas, source->first), CAIRO_OPERATOR_OVER, mixed ? 1 - source->ratio : 1);
    paint_with(canvas, make_pattern(canvas, source->second),
               mixed ? CAIRO_OPERATOR_ADD : draw_operator((int)source->mode), mixed ? source->ratio : 1);
    return cairo_pop_group(canvas->cr);
}

static cairo_pattern_t *fade_pattern(Canvas *canvas, cairo_pattern_t *pattern, double alpha) {
    if (alpha >= 1)
        return pattern;
    cairo_push_group(canvas->cr);
    paint_with(canvas, pattern, CAIRO_OPERATOR_OVER, alpha);
    return cairo_pop_group(canvas->cr);
}

// Returns a pattern of noise that covers the clip.
static cairo_pattern_t *make_noise(Canvas *canvas, const NOISEOperands *source) {
    cairo_t *cr = canvas->cr;
    cairo_matrix_t units, to_units, to_pixels;
    double x1, y1, x2, y2;
    cairo_get_matrix(cr, &units);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_clip_extents(cr, &x1, &y1, &x2, &y2);
    cairo_restore(cr);
    double left = floor(x1), top = floor(y1), width = fmax(ceil(x2) - left, 1), height = fmax(ceil(y2) - top, 1);
    double work = width * height * (10 + 100.0 * source->octaves);
    if (!draw_charge(canvas, NULL, work, "noise is left out"))
        return cairo_pattern_create_rgba(0, 0, 0, 0);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, (int)width, (int)height);
    to_units = units;
    cairo_matrix_invert(&to_units);
    if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS)
        noise_fill(source,
                   &(DisplayMatrix){to_units.xx, to_units.yx, to_units.xy, to_units.yy, to_units.x0, to_units.y0},
                   (int)left, (int)top, source->alpha, (uint32_t *)(void *)cairo_image_surface_get_data(surface),
                   (int)width, (int)height);
    cairo_surface_mark_dirty(surface);
    cairo_pattern_t *pattern = cairo_pattern_create_for_surface(surface);
    cairo_surface_destroy(surface);
    cairo_matrix_init_translate(&to_pixels, -left, -top);
    cairo_matrix_multiply(&to_pixels, &units, &to_pixels);
    cairo_pattern_set_matrix(pattern, &to_pixels);
    cairo_pattern_set_filter(pattern, CAIRO_FILTER_NEAREST);
    return pattern;
}

// Returns a pattern for the paint at a position of the list.
static cairo_pattern_t *make_pattern(Canvas *canvas, const double *at) {
    DisplayRow row;
    cairo_pattern_t *pattern;
    display_list_read(at, &row);
    switch (row.kind) {
    case PETRI_DRAW_COLOR:
        return make_color(row.COLOR.colour, 1);
    case PETRI_DRAW_SOLID:
        return make_color(row.SOLID.colour, row.SOLID.alpha);
    case PETRI_DRAW_LINEAR:
        pattern =
            cairo_pattern_create_linear(row.LINEAR.start[0], row.LINEAR.start[1], row.LINEAR.end[0], row.LINEAR.end[1]);
        return add_stops(pattern, row.LINEAR.stops, row.LINEAR.alpha);
    case PETRI_DRAW_RADIAL:
        pattern = cairo_pattern_create_radial(row.RADIAL.inner[0], row.RADIAL.inner[1], row.RADIAL.inner[2], 0, 0, 1);
        set_inverse(pattern, row.RADIAL.matrix);
        return add_stops(pattern, row.RADIAL.stops, row.RADIAL.alpha);
    case PETRI_DRAW_PATTERN:
        return fade_pattern(canvas, make_image(canvas, &row.PATTERN), row.PATTERN.alpha);
    case PETRI_DRAW_BLEND:
        return fade_pattern(canvas, make_blend(canvas, &row.BLEND), row.BLEND.alpha);
    default:
        return make_noise(canvas, &row.NOISE);
    }
}

void draw_set_source(Canvas *canvas, const DisplayPaint *paint) {
    cairo_pattern_t *pattern = make_pattern(canvas, paint->source);
    cairo_set_source(canvas->cr, pattern);
    cairo_pattern_destroy(pattern);
}

cairo_operator_t draw_operator(int composite) {
    static const cairo_operator_t operators[] = {
#define COMPOSITE(id, operator, mode, text) operator,
#include "schema/composite_list.h"
    };
    return operators[composite];
}
