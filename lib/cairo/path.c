// path.c: translates paths of a display list to Cairo.
#include "cairo/canvas.h"
#include "picture/outline.h"

#include <math.h>
#include <string.h>

// Cairo's coordinates have 24 bits before the binary point. Larger values would overflow and wrap around.
static const double MAX_COORDINATE = 4e6;

static double clamp_coordinate(double x) {
    return x > MAX_COORDINATE ? MAX_COORDINATE : x > -MAX_COORDINATE ? x : -MAX_COORDINATE; // NaN becomes the minimum
}

static void measure_point(Canvas *canvas, double x, double y) {
    PathSize *size = &canvas->size;
    if (size->starts) {
        size->starts = false;
        size->first_x = size->last_x = x;
        size->first_y = size->last_y = y;
    }
    double rows = fmin(fabs(y - size->last_y), canvas->rows), columns = fmin(fabs(x - size->last_x), canvas->columns);
    // The cost of filling is roughly proportional to the number of rows that the edges cross.
    canvas->path_work += 1 + rows;
    size->length += rows + columns;
    size->area += size->last_x * y - x * size->last_y;
    size->left = fmin(size->left, x);
    size->right = fmax(size->right, x);
    size->top = fmin(size->top, y);
    size->bottom = fmax(size->bottom, y);
    size->last_x = x;
    size->last_y = y;
}

void draw_clamp_point(Canvas *canvas, double *x, double *y) {
    double device_x = *x, device_y = *y;
    cairo_user_to_device(canvas->cr, &device_x, &device_y);
    measure_point(canvas, device_x, device_y);
    if (fabs(device_x) <= MAX_COORDINATE && fabs(device_y) <= MAX_COORDINATE)
        return;
    *x = clamp_coordinate(device_x);
    *y = clamp_coordinate(device_y);
    canvas->size.last_x = *x;
    canvas->size.last_y = *y;
    cairo_device_to_user(canvas->cr, x, y);
}

// Starts a subpath. Filling closes the previous one, so that its last edge is counted.
static void move_to(Canvas *canvas, double x, double y) {
    PathSize *size = &canvas->size;
    if (!size->starts)
        measure_point(canvas, size->first_x, size->first_y);
    size->starts = true;
    draw_clamp_point(canvas, &x, &y);
    cairo_move_to(canvas->cr, x, y);
}

static void line_to(Canvas *canvas, double x, double y) {
    draw_clamp_point(canvas, &x, &y);
    cairo_line_to(canvas->cr, x, y);
}

static void curve_to(Canvas *canvas, double x1, double y1, double x2, double y2, double x, double y) {
    draw_clamp_point(canvas, &x1, &y1);
    draw_clamp_point(canvas, &x2, &y2);
    draw_clamp_point(canvas, &x, &y);
    cairo_curve_to(canvas->cr, x1, y1, x2, y2, x, y);
}

// A quadratic curve equals a cubic one whose control points are two thirds of the way to the single control point.
static void quadratic_to(Canvas *canvas, double cx, double cy, double x, double y) {
    double x0 = cx, y0 = cy;
    if (cairo_has_current_point(canvas->cr))
        cairo_get_current_point(canvas->cr, &x0, &y0);
    else
        move_to(canvas, cx, cy);
    curve_to(canvas, x0 + (cx - x0) * 2 / 3, y0 + (cy - y0) * 2 / 3, x + (cx - x) * 2 / 3, y + (cy - y) * 2 / 3, x, y);
}

static void draw_ellipse(Canvas *canvas, double x, double y, double rx, double ry, double start, double sweep,
                         bool join) {
    double begin[2], curves[ARCS_MAX][6];
    int count = arcs_of_ellipse((const double[]){x, y, rx, ry, start, sweep}, draw_scale_of(canvas->cr), begin, curves);
    if (join)
        line_to(canvas, begin[0], begin[1]); // if the path is empty, Cairo begins it at this point
    else
        move_to(canvas, begin[0], begin[1]);
    for (int i = 0; i < count; i++)
        curve_to(canvas, curves[i][0], curves[i][1], curves[i][2], curves[i][3], curves[i][4], curves[i][5]);
}

static void arc_to(Canvas *canvas, const double *n) {
    double from[2], curves[ARCS_MAX][6];
    cairo_get_current_point(canvas->cr, &from[0], &from[1]);
    int count = arcs_to_point(from, n, curves);
    if (count == 0)
        line_to(canvas, n[5], n[6]);
    for (int i = 0; i < count; i++)
        curve_to(canvas, curves[i][0], curves[i][1], curves[i][2], curves[i][3], curves[i][4], curves[i][5]);
}

void draw_add_element(Canvas *canvas, PathElement kind, const double *n) {
    switch (kind) {
    case PATH_MOVE:
        move_to(canvas, n[0], n[1]);
        break;
    case PATH_LINE:
        line_to(canvas, n[0], n[1]);
        break;
    case PATH_QUADRATIC:
        quadratic_to(canvas, n[0], n[1], n[2], n[3]);
        break;
    case PATH_CUBIC:
        curve_to(canvas, n[0], n[1], n[2], n[3], n[4], n[5]);
        break;
    case PATH_ARC:
    case PATH_ARC_ON:
        draw_ellipse(canvas, n[0], n[1], n[2], n[3], n[4], n[5], kind == PATH_ARC_ON);
        break;
    case PATH_ARC_TO:
        arc_to(canvas, n);
        break;
    case PATH_CLOSE:
        cairo_close_path(canvas->cr);
        break;
    }
}

void draw_add_elements(Canvas *canvas, DisplayNumbers path) {
    for (uint32_t i = 0; i < path.count;) {
        PathElement kind = (PathElement)path.at[i];
        draw_add_element(canvas, kind, path.at + i + 1);
        i += 1u + display_path_sizes[kind];
    }
}

static bool is_current_path(const Canvas *canvas, DisplayNumbers path) {
    const DisplayNumbers *current = &canvas->path;
    return current->at && current->count == path.count &&
           memcmp(&canvas->path_matrix, &canvas->matrix, sizeof canvas->matrix) == 0 &&
           memcmp(current->at, path.at, path.count * sizeof *path.at) == 0;
}

void draw_set_path(Canvas *canvas, DisplayNumbers path) {
    if (is_current_path(canvas, path))
        return;
    draw_forget_path(canvas);
    canvas->path = path;
    canvas->path_matrix = canvas->matrix;
    draw_add_elements(canvas, path);
}
