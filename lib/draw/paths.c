// paths.c: nodes that add to the path.
#include "draw/draw.h"
#include "maths/maths.h"

#include <math.h>

static const double TURN = 6.283185307179586;

// Cairo reckons with 24 bits before the point; beyond that lines would jump to the other side.
static const double FARTHEST = 4e6;

static double within(double x) {
    return x > FARTHEST ? FARTHEST : x > -FARTHEST ? x : -FARTHEST; // nan too goes far away
}

void draw_tame(Canvas *canvas, double *x, double *y) {
    double device_x = *x, device_y = *y;
    cairo_user_to_device(canvas->cr, &device_x, &device_y);
    // What filling costs is about the number of rows that the edges cross.
    canvas->path_work += 1 + fmin(fabs(device_y - canvas->last_y), canvas->rows);
    canvas->last_y = device_y;
    if (fabs(device_x) <= FARTHEST && fabs(device_y) <= FARTHEST)
        return;
    *x = within(device_x);
    *y = within(device_y);
    canvas->last_y = *y;
    cairo_device_to_user(canvas->cr, x, y);
}

static void move_to(Canvas *canvas, double x, double y) {
    draw_tame(canvas, &x, &y);
    cairo_move_to(canvas->cr, x, y);
}

static void line_to(Canvas *canvas, double x, double y) {
    draw_tame(canvas, &x, &y);
    cairo_line_to(canvas->cr, x, y);
}

static void curve_to(Canvas *canvas, double x1, double y1, double x2, double y2, double x, double y) {
    draw_tame(canvas, &x1, &y1);
    draw_tame(canvas, &x2, &y2);
    draw_tame(canvas, &x, &y);
    cairo_curve_to(canvas->cr, x1, y1, x2, y2, x, y);
}

// One control point is as good as two that lie two thirds of the way to it.
static void quadratic_to(Canvas *canvas, double cx, double cy, double x, double y) {
    double x0 = cx, y0 = cy;
    if (cairo_has_current_point(canvas->cr))
        cairo_get_current_point(canvas->cr, &x0, &y0);
    else
        move_to(canvas, cx, cy);
    curve_to(canvas, x0 + (cx - x0) * 2 / 3, y0 + (cy - y0) * 2 / 3, x + (cx - x) * 2 / 3, y + (cy - y) * 2 / 3, x, y);
}

// A part of an ellipse as Bézier curves, each of at most a quarter or, where the difference would show, an eighth of
// it.
void draw_ellipse_path(Canvas *canvas, double x, double y, double rx, double ry, double start, double sweep,
                       bool join) {
    double turns = fmin(fmax(sweep, -1), 1);
    double largest = fmax(rx, ry) * draw_scale_of(canvas->cr);
    int pieces = (int)ceil(fabs(turns) * (largest < 64 ? 4 : 8));
    double from = (start - floor(start)) * TURN, step = turns * TURN / (pieces ? pieces : 1);
    double handle = 4.0 / 3 * maths_tan(step / 4);
    double c = maths_cos(from), s = maths_sin(from);
    if (join)
        line_to(canvas, x + rx * c, y + ry * s); // begins the path if there is none
    else
        move_to(canvas, x + rx * c, y + ry * s);
    for (int i = 1; i <= pieces; i++) {
        double c2 = maths_cos(from + i * step), s2 = maths_sin(from + i * step);
        curve_to(canvas, x + rx * (c - handle * s), y + ry * (s + handle * c), x + rx * (c2 + handle * s2),
                 y + ry * (s2 - handle * c2), x + rx * c2, y + ry * s2);
        c = c2;
        s = s2;
    }
}

static void add_curve(Canvas *canvas, const DrawNode *node) {
    double p[2], c1[2], c2[2];
    if (!draw_pair(node, ATTR_POINT, p))
        return;
    bool first = draw_pair(node, ATTR_C1, c1), second = draw_pair(node, ATTR_C2, c2);
    if (first && second) {
        if (!cairo_has_current_point(canvas->cr))
            move_to(canvas, c1[0], c1[1]);
        curve_to(canvas, c1[0], c1[1], c2[0], c2[1], p[0], p[1]);
    } else if (first || second) {
        const double *c = first ? c1 : c2;
        quadratic_to(canvas, c[0], c[1], p[0], p[1]);
    } else {
        line_to(canvas, p[0], p[1]);
    }
}

static void add_arc(Canvas *canvas, const DrawNode *node) {
    double p[2], r[2];
    draw_pair(node, ATTR_POINT, p);
    if (!draw_pair(node, ATTR_RADIUS, r))
        return;
    double start = draw_number(node, ATTR_START), sweep = draw_number(node, ATTR_SWEEP);
    double end = draw_number(node, ATTR_END);
    if (isnan(end))
        end = start + sweep;
    draw_ellipse_path(canvas, p[0], p[1], r[0], r[1], start, end - start, true);
}

static void add_rect(Canvas *canvas, const DrawNode *node) {
    double p[2], size[2], r[2];
    draw_pair(node, ATTR_POINT, p);
    if (!draw_pair(node, ATTR_SIZE, size))
        return;
    draw_pair(node, ATTR_RADIUS, r);
    double left = p[0], top = p[1], right = p[0] + size[0], bottom = p[1] + size[1];
    // Radii that do not fit shrink together: a large one makes half circles at the shorter sides.
    double part = fmin(1, fmin(size[0] / (2 * r[0]), size[1] / (2 * r[1])));
    double rx = r[0] * part, ry = r[1] * part;
    if (rx > 0 && ry > 0) {
        draw_ellipse_path(canvas, right - rx, top + ry, rx, ry, 0.75, 0.25, false);
        draw_ellipse_path(canvas, right - rx, bottom - ry, rx, ry, 0, 0.25, true);
        draw_ellipse_path(canvas, left + rx, bottom - ry, rx, ry, 0.25, 0.25, true);
        draw_ellipse_path(canvas, left + rx, top + ry, rx, ry, 0.5, 0.25, true);
    } else {
        move_to(canvas, left, top);
        line_to(canvas, right, top);
        line_to(canvas, right, bottom);
        line_to(canvas, left, bottom);
    }
    cairo_close_path(canvas->cr);
}

static void add_ellipse(Canvas *canvas, const DrawNode *node) {
    double p[2], r[2];
    draw_pair(node, ATTR_POINT, p);
    if (!draw_pair(node, ATTR_RADIUS, r))
        return;
    draw_ellipse_path(canvas, p[0], p[1], r[0], r[1], 0, 1, false);
    cairo_close_path(canvas->cr);
}

// A corner that is rounded: the curve leaves the line at `curve` of the half of the piece before it, and joins it as
// far behind.
static void add_corner(Canvas *canvas, const double *before, const double *at, const double *after, double curve,
                       bool first) {
    double part = curve / 2;
    double x1 = at[0] + (before[0] - at[0]) * part, y1 = at[1] + (before[1] - at[1]) * part;
    if (first)
        move_to(canvas, x1, y1);
    else
        line_to(canvas, x1, y1);
    quadratic_to(canvas, at[0], at[1], at[0] + (after[0] - at[0]) * part, at[1] + (after[1] - at[1]) * part);
}

static void add_line(Canvas *canvas, const DrawNode *node) {
    const AttrValue *attr = draw_attr(node, ATTR_POINTS);
    uint32_t count = attr ? attr->count / 2 : 0;
    if (count == 0)
        return;
    const double *points = attr->as.list;
    double curve = fmin(fmax(draw_number(node, ATTR_CURVE), 0), 1);
    bool close = draw_flag(node, ATTR_CLOSE) && count > 2;
    if (curve == 0 || count < 3) {
        for (uint32_t i = 0; i < count; i++)
            (i ? line_to : move_to)(canvas, points[2 * i], points[2 * i + 1]);
    } else {
        if (!close)
            move_to(canvas, points[0], points[1]);
        for (uint32_t i = close ? 0 : 1; i < count - !close; i++)
            add_corner(canvas, points + 2 * ((i + count - 1) % count), points + 2 * i, points + 2 * ((i + 1) % count),
                       curve, i == 0);
        if (!close)
            line_to(canvas, points[2 * count - 2], points[2 * count - 1]);
    }
    if (draw_flag(node, ATTR_CLOSE))
        cairo_close_path(canvas->cr);
}

bool draw_add_path(Canvas *canvas, const DrawNode *node) {
    double p[2];
    switch ((NodeKind)node->kind) {
    case KIND_MOVE_TO:
        if (draw_pair(node, ATTR_POINT, p))
            move_to(canvas, p[0], p[1]);
        return true;
    case KIND_LINE_TO:
        if (draw_pair(node, ATTR_POINT, p))
            line_to(canvas, p[0], p[1]);
        return true;
    case KIND_CURVE_TO:
        add_curve(canvas, node);
        return true;
    case KIND_ARC:
        add_arc(canvas, node);
        return true;
    case KIND_RECT:
        add_rect(canvas, node);
        return true;
    case KIND_ELLIPSE:
        add_ellipse(canvas, node);
        return true;
    case KIND_LINE:
        add_line(canvas, node);
        return true;
    case KIND_CLOSE:
        cairo_close_path(canvas->cr);
        return true;
    default:
        return false;
    }
}

KeptPath draw_keep_path(Canvas *canvas) {
    cairo_t *cr = canvas->cr;
    KeptPath kept = {cairo_has_current_point(cr) ? cairo_copy_path(cr) : NULL, canvas->path_work};
    cairo_new_path(cr);
    canvas->path_work = 0;
    return kept;
}

void draw_put_back_path(Canvas *canvas, KeptPath kept) {
    cairo_new_path(canvas->cr);
    canvas->path_work = kept.work;
    if (kept.path) {
        cairo_append_path(canvas->cr, kept.path);
        cairo_path_destroy(kept.path);
    }
}
