// cost.c: estimates the time of drawing operations, which is charged before they run. The figures were measured
// with Cairo on a machine from 2024. They are accurate to within a factor of two or three, which is enough to
// distinguish seconds from minutes.
#include "cairo/canvas.h"

#include <math.h>

// Returns the time in nanoseconds that painting one pixel takes.
static double cost_of_pixel(const DisplayPaint *paint) {
    double color = display_paint_is_plain(paint) ? 0 : 5;
    int mode = (int)paint->style.mode;
    if (mode == COMPOSITE_OVER)
        return color + 0.5;
    if (mode == COMPOSITE_MODULATE)
        return color + 9;
    return color + (mode >= COMPOSITE_HUE ? 20 : mode >= COMPOSITE_MULTIPLY ? 8 : 2);
}

static bool charge_pixels(Canvas *canvas, const DisplayPaint *paint, double pixels, double more) {
    return canvas->vector || draw_charge(canvas, NULL, pixels * cost_of_pixel(paint) + more, draw_omitted);
}

// Estimates the number of painted pixels. A narrow and slanted path fills only a small part of its bounding box. The
// estimate for a fill is therefore the area of the path. It is raised to a quarter of the box if necessary, because
// parts of opposite orientation cancel. The estimate for a stroke is its length times its width.
static double pixels_of(const Canvas *canvas, const DisplayPaint *paint, bool fill, bool stroke) {
    const PathSize *size = &canvas->size;
    double width = stroke ? paint->style.width * draw_scale_of(canvas->cr) : 0;
    double across = fmin(size->right + width / 2, canvas->columns) - fmax(size->left - width / 2, 0);
    double down = fmin(size->bottom + width / 2, canvas->rows) - fmax(size->top - width / 2, 0);
    if (!(across > 0 && down > 0))
        return 0;
    double box = across * down;
    return (fill ? fmin(box, fmax(fabs(size->area) / 2, box / 4)) : 0) +
           (stroke ? fmin(box, size->length * (width + 1)) : 0);
}

bool draw_charge_path(Canvas *canvas, const DisplayPaint *paint, bool fill, bool stroke) {
    static const double EACH_PATH = 3000, EACH_ROW = 130;
    // The cost of the rows that edges cross, plus the worst-case cost of intersections between edges.
    double edges = canvas->path_work * (EACH_ROW + 1e-3 * canvas->path_work);
    return charge_pixels(canvas, paint, pixels_of(canvas, paint, fill, stroke), EACH_PATH + edges);
}

bool draw_charge_box(Canvas *canvas, const DisplayPaint *paint, double width, double height, double count) {
    double scale = draw_scale_of(canvas->cr);
    double pixels = fmin(fabs(width * height) * scale * scale, canvas->columns * canvas->rows);
    return charge_pixels(canvas, paint, count * pixels, 0);
}
