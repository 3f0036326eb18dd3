// cost_model.c: what drawing is charged before it is done. The figures are Cairo's on one machine of 2024: right within
// a factor of two or three, which is enough to tell a minute from a second.
#include "draw/draw.h"

#include <math.h>

// Nanoseconds.
static double cost_of_pixel(const DisplayPaint *paint) {
    double color = paint->source == DISPLAY_NONE ? 0 : 5;
    if (paint->composite == COMPOSITE_OVER)
        return color + 0.5;
    if (paint->composite == COMPOSITE_MODULATE)
        return color + 9;
    return color + (paint->composite >= COMPOSITE_HUE ? 20 : paint->composite >= COMPOSITE_MULTIPLY ? 8 : 2);
}

static bool charge_pixels(Canvas *canvas, const DisplayPaint *paint, double pixels, double more) {
    return canvas->vector || draw_charge(canvas, NULL, pixels * cost_of_pixel(paint) + more, draw_omitted);
}

// A figure covers its box, or much less if it is narrow and slanting: then what its points enclose, which is nothing
// for figures that turn back on themselves. A line covers its length times its width.
static double pixels_of(const Canvas *canvas, const DisplayPaint *paint, bool fill, bool stroke) {
    const PathSize *size = &canvas->size;
    double width = stroke ? paint->stroke_width * draw_scale_of(canvas->cr) : 0;
    double across = fmin(size->right + width / 2, canvas->columns) - fmax(size->left - width / 2, 0);
    double down = fmin(size->bottom + width / 2, canvas->rows) - fmax(size->top - width / 2, 0);
    if (!(across > 0 && down > 0))
        return 0;
    double box = across * down;
    return (fill ? fmin(box, fmax(fabs(size->area) / 2, box / 4)) : 0) +
           (stroke ? fmin(box, size->length * (width + 1)) : 0);
}

bool draw_charge_path(Canvas *canvas, const DisplayPaint *paint, bool fill, bool stroke) {
    // Rows, and at worst crossings of edges with each other.
    double edges = canvas->path_work * (100 + 1e-3 * canvas->path_work);
    return charge_pixels(canvas, paint, pixels_of(canvas, paint, fill, stroke), edges);
}

bool draw_charge_box(Canvas *canvas, const DisplayPaint *paint, double width, double height, double count) {
    double scale = draw_scale_of(canvas->cr);
    double pixels = fmin(fabs(width * height) * scale * scale, canvas->columns * canvas->rows);
    return charge_pixels(canvas, paint, count * pixels, 0);
}
