// paths.c: paths of a list, and parts of ellipses, become Cairo's.
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

// The arc of an ellipse from where the path ends to x, y, as SVG has it (its appendix on implementing arcs): on the
// unit circle, the middle is found from the chord.
static void arc_to(Canvas *canvas, const double *n) {
    double x0, y0, x = n[5], y = n[6], c = maths_cos(n[2] * TURN), s = maths_sin(n[2] * TURN);
    cairo_get_current_point(canvas->cr, &x0, &y0);
    double rx = n[0], ry = n[1], dx = (x - x0) / 2, dy = (y - y0) / 2;
    double a = (c * dx + s * dy) / rx, b = (c * dy - s * dx) / ry; // half the chord
    double half = maths_hypot(a, b);
    if (!(half > 0) || !isfinite(half)) { // no way to go, or no radius: then it is straight
        line_to(canvas, x, y);
        return;
    }
    double grow = fmax(half, 1), height = sqrt(fmax(grow * grow / (half * half) - 1, 0));
    double side = (n[3] != 0) == (n[4] != 0) ? -1 : 1;
    double mx = -b * height * side, my = a * height * side; // from the middle of the chord to that of the circle
    double from = maths_atan2(-b - my, -a - mx), to = maths_atan2(b - my, a - mx);
    double sweep = to - from + (n[4] != 0 && to < from ? TURN : n[4] == 0 && to > from ? -TURN : 0);
    int pieces = (int)ceil(fabs(sweep) / (TURN / 8));
    double step = sweep / (pieces ? pieces : 1), handle = 4.0 / 3 * maths_tan(step / 4);
    for (int i = 1; i <= pieces; i++) {
        double at = from + (i - 1) * step, next = from + i * step, p[3][2];
        double c1 = maths_cos(at), s1 = maths_sin(at), c2 = maths_cos(next), s2 = maths_sin(next);
        const double circle[3][2] = {
            {c1 - handle * s1, s1 + handle * c1}, {c2 + handle * s2, s2 - handle * c2}, {c2, s2}};
        for (int k = 0; k < 3; k++) {
            double u = (circle[k][0] * grow + mx) * rx, v = (circle[k][1] * grow + my) * ry;
            p[k][0] = (x0 + x) / 2 + c * u - s * v;
            p[k][1] = (y0 + y) / 2 + s * u + c * v;
        }
        curve_to(canvas, p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1]);
    }
}

void draw_add_piece(Canvas *canvas, ListPiece kind, const double *n) {
    switch (kind) {
    case PIECE_MOVE:
        move_to(canvas, n[0], n[1]);
        break;
    case PIECE_LINE:
        line_to(canvas, n[0], n[1]);
        break;
    case PIECE_CURVE_2:
        quadratic_to(canvas, n[0], n[1], n[2], n[3]);
        break;
    case PIECE_CURVE_3:
        curve_to(canvas, n[0], n[1], n[2], n[3], n[4], n[5]);
        break;
    case PIECE_ARC:
    case PIECE_ARC_ON:
        draw_ellipse_path(canvas, n[0], n[1], n[2], n[3], n[4], n[5], kind == PIECE_ARC_ON);
        break;
    case PIECE_ARC_TO:
        arc_to(canvas, n);
        break;
    case PIECE_CLOSE:
        cairo_close_path(canvas->cr);
        break;
    }
}

static bool is_set(const Canvas *canvas, const ListCommand *command) {
    const ListCommand *set = canvas->path_of;
    return set && set->path.first == command->path.first && set->path.last == command->path.last &&
           set->path.end == command->path.end && set->matrix == command->matrix;
}

void draw_set_path(Canvas *canvas, const ListCommand *command) {
    static const uint8_t counts[] = {2, 2, 4, 6, 6, 6, 7, 0};
    const List *list = canvas->list;
    if (is_set(canvas, command))
        return;
    draw_forget_path(canvas);
    canvas->path_of = command;
    for (uint32_t run = command->path.first; run != LIST_NONE;) {
        bool last = run == command->path.last;
        uint32_t end = last ? command->path.end : list->runs.at[run].end;
        for (uint32_t i = list->runs.at[run].start; i < end;) {
            ListPiece kind = (ListPiece)list->numbers.at[i];
            draw_add_piece(canvas, kind, list->numbers.at + i + 1);
            i += 1u + counts[kind];
        }
        run = last ? LIST_NONE : list->runs.at[run].next;
    }
}

void draw_forget_path(Canvas *canvas) {
    cairo_new_path(canvas->cr);
    canvas->path_work = 0;
    canvas->path_of = NULL;
}
