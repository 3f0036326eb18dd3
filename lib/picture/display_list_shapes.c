// display_list_shapes.c: translates nodes that add to a path (spec canvas.md 3).
#include "maths/maths.h"
#include "picture/display_list_build.h"

#include <math.h>
#include <string.h>

static const double TURN = 6.283185307179586;

const DisplayPath display_list_build_no_path = {DISPLAY_NONE, DISPLAY_NONE, 0, FILL_WINDING};

// Adds an element to the last run of the path. If elements of other paths were added after this run, begins another
// run.
static void add_element(DisplayListBuild *build, DisplayPath *path, PathElement kind, const double *numbers) {
    uint32_t count = display_path_sizes[kind];
    bool continues = path->first != DISPLAY_NONE && path->end == build->paths.count;
    if (!continues) {
        DisplayRun *run = DISPLAY_ADD(build->arena, build->runs, 1);
        *run = (DisplayRun){.start = build->paths.count, .next = DISPLAY_NONE};
        uint32_t number = build->runs.count - 1;
        if (path->first == DISPLAY_NONE)
            path->first = number;
        else
            build->runs.at[path->last].next = number;
        path->last = number;
    }
    double *at = DISPLAY_ADD(build->arena, build->paths, count + 1);
    at[0] = kind;
    memcpy(at + 1, numbers, count * sizeof *numbers);
    path->end = build->runs.at[path->last].end = build->paths.count;
}

DisplayNumbers display_list_build_elements(DisplayListBuild *build, const DisplayPath *path) {
    if (path->first == DISPLAY_NONE)
        return (DisplayNumbers){NULL, 0};
    if (path->first == path->last) {
        uint32_t start = build->runs.at[path->first].start;
        return (DisplayNumbers){build->paths.at + start, path->end - start};
    }
    build->joined.count = 0;
    for (uint32_t run = path->first; run != DISPLAY_NONE;) {
        bool last = run == path->last;
        uint32_t start = build->runs.at[run].start, count = (last ? path->end : build->runs.at[run].end) - start;
        memcpy(DISPLAY_ADD(build->arena, build->joined, count), build->paths.at + start, count * sizeof(double));
        run = last ? DISPLAY_NONE : build->runs.at[run].next;
    }
    return (DisplayNumbers){build->joined.at, build->joined.count};
}

static void move_to(DisplayListBuild *build, DisplayPath *path, double x, double y) {
    add_element(build, path, PATH_MOVE, (const double[]){x, y});
}

// If the path is empty, starts it at 0;0. Must be called before a line or curve is added, because these start at the
// current point.
static void begin_path(DisplayListBuild *build, DisplayPath *path) {
    if (path->first == DISPLAY_NONE)
        move_to(build, path, 0, 0);
}

static void line_to(DisplayListBuild *build, DisplayPath *path, double x, double y) {
    add_element(build, path, PATH_LINE, (const double[]){x, y});
}

static void close_path(DisplayListBuild *build, DisplayPath *path) {
    if (path->first != DISPLAY_NONE)
        add_element(build, path, PATH_CLOSE, (const double[]){0});
}

static void add_close(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    (void)node;
    close_path(build, path);
}

static void add_move_to(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    double p[2];
    if (draw_pair(node, ATTR_POINT, p))
        move_to(build, path, p[0], p[1]);
}

static void add_line_to(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    double p[2];
    if (!draw_pair(node, ATTR_POINT, p))
        return;
    begin_path(build, path);
    line_to(build, path, p[0], p[1]);
}

static void add_arc_element(DisplayListBuild *build, DisplayPath *path, double x, double y, double rx, double ry,
                            double start, double sweep, bool on) {
    bool joined = on && path->first != DISPLAY_NONE;
    add_element(build, path, joined ? PATH_ARC_ON : PATH_ARC, (const double[]){x, y, rx, ry, start, sweep});
}

static void add_curve_to(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    double p[2], c1[2], c2[2];
    if (!draw_pair(node, ATTR_POINT, p) || !draw_pair(node, ATTR_C1, c1))
        return;
    begin_path(build, path);
    if (draw_pair(node, ATTR_C2, c2))
        add_element(build, path, PATH_CUBIC, (const double[]){c1[0], c1[1], c2[0], c2[1], p[0], p[1]});
    else
        add_element(build, path, PATH_QUADRATIC, (const double[]){c1[0], c1[1], p[0], p[1]});
}

static void add_arc(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    double p[2], r[2];
    draw_pair(node, ATTR_POINT, p);
    double start = draw_number(node, ATTR_START), sweep = draw_number(node, ATTR_SWEEP);
    if (isnan(sweep))
        sweep = draw_number(node, ATTR_END) - start;
    if (!draw_pair(node, ATTR_RADIUS, r) || isnan(sweep))
        return;
    add_arc_element(build, path, p[0], p[1], r[0], r[1], start, fmod(sweep, 1), !draw_flag(node, ATTR_MOVE_TO));
}

static void add_arc_to(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    double p[2], r[2], turns = draw_number(node, ATTR_ROTATION) / 360;
    if (!draw_pair(node, ATTR_POINT, p) || !draw_pair(node, ATTR_RADIUS, r))
        return;
    begin_path(build, path);
    add_element(build, path, PATH_ARC_TO,
                (const double[]){r[0], r[1], turns - floor(turns), draw_flag(node, ATTR_LARGE),
                                 !draw_flag(node, ATTR_CCW), p[0], p[1]});
}

void display_list_build_rectangle(DisplayListBuild *build, DisplayPath *path, const double point[2],
                                  const double size[2]) {
    move_to(build, path, point[0], point[1]);
    line_to(build, path, point[0] + size[0], point[1]);
    line_to(build, path, point[0] + size[0], point[1] + size[1]);
    line_to(build, path, point[0], point[1] + size[1]);
    close_path(build, path);
}

static void add_rect(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    double p[2], size[2], r[2];
    draw_pair(node, ATTR_POINT, p);
    if (!draw_pair(node, ATTR_SIZE, size))
        return;
    draw_pair(node, ATTR_RADIUS, r);
    double width = fabs(size[0]), height = fabs(size[1]);
    // Radii that do not fit are scaled down together, so a large radius gives half circles at the shorter sides.
    double part = fmin(1, fmin(width / (2 * r[0]), height / (2 * r[1])));
    double rx = r[0] * part, ry = r[1] * part;
    if (!(rx > 0 && ry > 0)) {
        display_list_build_rectangle(build, path, p, size);
        return;
    }
    double left = fmin(p[0], p[0] + size[0]), top = fmin(p[1], p[1] + size[1]), right = left + width,
           bottom = top + height;
    add_arc_element(build, path, right - rx, top + ry, rx, ry, 0.75, 0.25, false);
    add_arc_element(build, path, right - rx, bottom - ry, rx, ry, 0, 0.25, true);
    add_arc_element(build, path, left + rx, bottom - ry, rx, ry, 0.25, 0.25, true);
    add_arc_element(build, path, left + rx, top + ry, rx, ry, 0.5, 0.25, true);
    close_path(build, path);
}

static void add_ellipse(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    double p[2], r[2];
    draw_pair(node, ATTR_POINT, p);
    if (!draw_pair(node, ATTR_RADIUS, r))
        return;
    add_arc_element(build, path, p[0], p[1], r[0], r[1], 0, 1, false);
    close_path(build, path);
}

// Returns the angle in turns between the directions from a to p and from p to b. Returns 0.25 for larger angles.
static double turn_at(const double *a, const double *p, const double *b) {
    double x1 = p[0] - a[0], y1 = p[1] - a[1], x2 = b[0] - p[0], y2 = b[1] - p[1];
    double lengths = maths_hypot(x1, y1) * maths_hypot(x2, y2);
    return lengths > 0 ? maths_acos(fmin(fmax((x1 * x2 + y1 * y2) / lengths, 0), 1)) / TURN : 0;
}

// Adds the corner at p, from the middle of the line before p to the middle of the line after p. If the direction
// changes by more than `curve` turns, the corner stays sharp; otherwise, it becomes a curve.
static void add_corner(DisplayListBuild *build, DisplayPath *path, const double *before, const double *p,
                       const double *after, double curve) {
    double a[2] = {(before[0] + p[0]) / 2, (before[1] + p[1]) / 2};
    double b[2] = {(p[0] + after[0]) / 2, (p[1] + after[1]) / 2};
    if (curve >= 0.5 || turn_at(a, p, b) <= curve) {
        add_element(build, path, PATH_QUADRATIC, (const double[]){p[0], p[1], b[0], b[1]});
    } else {
        line_to(build, path, p[0], p[1]);
        line_to(build, path, b[0], b[1]);
    }
}

static void add_line(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    const AttrValue *attr = draw_attr(node, ATTR_POINTS);
    uint32_t count = attr ? attr->count / 2 : 0;
    if (count == 0)
        return;
    const double *points = attr->as.list, *last = points + 2 * (count - 1);
    double curve = draw_number(node, ATTR_CURVE);
    bool closed = draw_flag(node, ATTR_CLOSE);
    if (curve <= 0 || count == 1) {
        for (uint32_t i = 0; i < count; i++)
            (i ? line_to : move_to)(build, path, points[2 * i], points[2 * i + 1]);
    } else if (closed) {
        move_to(build, path, (points[0] + points[2]) / 2, (points[1] + points[3]) / 2);
        for (uint32_t i = 1; i <= count; i++)
            add_corner(build, path, points + 2 * (i - 1), points + 2 * (i % count), points + 2 * ((i + 1) % count),
                       curve);
    } else {
        move_to(build, path, points[0], points[1]);
        line_to(build, path, (points[0] + points[2]) / 2, (points[1] + points[3]) / 2);
        for (const double *p = points + 2; p < last; p += 2)
            add_corner(build, path, p - 2, p, p + 2, curve);
        line_to(build, path, last[0], last[1]);
    }
    if (closed)
        close_path(build, path);
}

static void (*const shapes[KIND_COUNT])(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) = {
#define SHAPE(id, name, help) [KIND_##id] = add_##name,
#include "schema/schema_list.h"
};

void display_list_build_shape(DisplayListBuild *build, DisplayPath *path, const DrawNode *node) {
    shapes[node->kind](build, path, node);
}
