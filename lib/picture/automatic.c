// automatic.c: the automatic picture of particle systems, as shapes for any target; see automatic.h.
//
// A panel is drawn from back to front: axes, barriers, links, bodies from far to near, scale bar.
#include "picture/automatic.h"

#include "maths/maths.h"

#include <math.h>
#include <stdlib.h>

typedef struct Colour {
    double r, g, b;
} Colour;

static const Colour GROUND = {AUTO_GROUND};
// Minimum radii of bodies: in panel pixels, and in pixels of the target. The larger of the two applies.
static const double MIN_RADIUS = 2, MIN_DEVICE_RADIUS = 1.5;
// The camera is 0.45 radians to the right of the front view and 0.35 radians above it.
static const double COS_YAW = 0.9004471023526769, SIN_YAW = 0.43496553411123023;
static const double COS_PITCH = 0.9393727128473789, SIN_PITCH = 0.34289780745545134;
static const double EYE = 4; // distance of the camera from the centre, in units of half the view's side

// The area in which a system is drawn.
typedef struct Panel {
    const AutoTarget *target;
    const AutoSystem *system;
    double x; // centre of the panel, in the picture's units
    double y;
    double side;  // half the side of the view, in the picture's units
    double scale; // units of the picture per unit of the system
    double width;
    double height;
    double pixel;      // size of a panel pixel in the picture's units
    double min_radius; // minimum radius of a body, in the picture's units
} Panel;

static Colour mix_colours(Colour a, Colour b, double part) {
    return (Colour){a.r + (b.r - a.r) * part, a.g + (b.g - a.g) * part, a.b + (b.b - a.b) * part};
}

// Returns the colour for `shade`, which is a charge (blue through white to orange) or a speed (deep blue through
// turquoise to pale yellow).
static Colour shade_colour(const AutoSystem *system, double shade) {
    static const Colour negative = {0.25, 0.55, 1}, neutral = {0.85, 0.87, 0.9}, positive = {1, 0.5, 0.15};
    static const Colour slow = {0.2, 0.35, 0.75}, middle = {0.2, 0.75, 0.7}, fast = {1, 0.95, 0.6};
    if (system->charged)
        return shade < 0 ? mix_colours(neutral, negative, -shade) : mix_colours(neutral, positive, shade);
    return shade < 0.5 ? mix_colours(slow, middle, shade * 2) : mix_colours(middle, fast, shade * 2 - 1);
}

// A point of a system, projected to its panel. `depth` increases with the distance from the camera; `size` is the scale
// at that depth.
typedef struct Projected {
    double x;
    double y;
    double depth;
    double size;
} Projected;

static Projected project_point(const Panel *panel, const double position[3]) {
    const AutoFrame *frame = &panel->system->frame;
    double x = (position[0] - frame->middle[0]) / frame->half, y = (position[1] - frame->middle[1]) / frame->half;
    if (panel->system->dimensions < 3)
        return (Projected){panel->x + x * panel->side, panel->y - y * panel->side, 0, panel->scale};
    double z = (position[2] - frame->middle[2]) / frame->half;
    double right = x * COS_YAW - z * SIN_YAW, towards = x * SIN_YAW + z * COS_YAW;
    double up = y * COS_PITCH - towards * SIN_PITCH;
    double depth = -(y * SIN_PITCH + towards * COS_PITCH);
    double nearness = EYE / fmax(EYE + depth, 0.1);
    return (Projected){panel->x + right * panel->side * nearness, panel->y - up * panel->side * nearness, depth,
                       panel->scale * nearness};
}

// Distant objects fade into the background.
static Colour fade_with_depth(const Panel *panel, Colour colour, double depth) {
    return panel->system->dimensions < 3 ? colour : mix_colours(colour, GROUND, fmin(fmax(0.3 + 0.3 * depth, 0), 0.8));
}

// Draws a path as a line, whose width is in panel pixels, or fills it if the width is 0.
static void draw_path(const Panel *panel, const double *path, uint32_t length, double width, Colour c, double alpha,
                      const AutoGradient *gradient) {
    panel->target->draw(panel->target->context, &(AutoShape){.path = path,
                                                             .length = length,
                                                             .line = width * panel->pixel,
                                                             .color = {c.r, c.g, c.b, alpha},
                                                             .gradient = gradient});
}

typedef struct Line {
    double path[6];
} Line;

static Line line_between(double x1, double y1, double x2, double y2) {
    return (Line){{PATH_MOVE, x1, y1, PATH_LINE, x2, y2}};
}

static void draw_lines(const Panel *panel, const Line *lines, uint32_t count, double width, Colour colour,
                       double alpha) {
    draw_path(panel, lines->path, 6 * count, width, colour, alpha, NULL);
}

// Returns a gradient that shades a circle like a ball lit from the upper left.
static AutoGradient ball_gradient(double x, double y, double radius, Colour colour) {
    Colour light = mix_colours(colour, (Colour){1, 1, 1}, 0.5), dark = mix_colours(colour, (Colour){0, 0, 0}, 0.65);
    return (AutoGradient){{x - radius * 0.35, y - radius * 0.4, radius * 0.05},
                          {x - radius * 0.1, y - radius * 0.1, radius * 1.15},
                          {{0, {light.r, light.g, light.b, 1}},
                           {0.45, {colour.r, colour.g, colour.b, 1}},
                           {1, {dark.r, dark.g, dark.b, 1}}}};
}

static void draw_body(const Panel *panel, const AutoBody *body, const Projected *seen) {
    const double line = 1.5;
    double shown = fmin(fmax(body->radius * seen->size, panel->min_radius), 4 * (panel->width + panel->height));
    bool small = shown <= panel->min_radius;
    Colour colour = fade_with_depth(panel, shade_colour(panel->system, body->shade), seen->depth);
    double ring = fmax(shown - line * panel->pixel / 2, fmax(panel->min_radius, 3 * panel->pixel));
    double radius = body->anchor ? ring : shown;
    const double circle[] = {PATH_ARC, seen->x, seen->y, radius, radius, 0, 1, PATH_CLOSE};
    if (body->anchor) {
        draw_path(panel, circle, 8, line, colour, 1, NULL);
    } else if (panel->system->dimensions == 3 && !small) {
        AutoGradient ball = ball_gradient(seen->x, seen->y, radius, colour);
        draw_path(panel, circle, 8, 0, colour, 1, &ball);
    } else {
        draw_path(panel, circle, 8, 0, colour, small ? 1 : 0.85, NULL);
    }
}

// A body to sort, so that bodies are drawn from far to near. Bodies at equal depth keep their order.
typedef struct DepthEntry {
    Projected seen;
    uint32_t body;
} DepthEntry;

static int compare_depth(const void *a, const void *b) {
    const DepthEntry *x = a, *y = b;
    if (x->seen.depth != y->seen.depth)
        return x->seen.depth < y->seen.depth ? 1 : -1;
    return (x->body > y->body) - (x->body < y->body);
}

static void draw_bodies(const Panel *panel) {
    const AutoSystem *system = panel->system;
    DepthEntry *places = arena_alloc_array(panel->target->arena, system->body_count, sizeof *places);
    for (uint32_t i = 0; i < system->body_count; i++)
        places[i] = (DepthEntry){project_point(panel, system->bodies[i].position), i};
    if (system->dimensions == 3)
        qsort(places, system->body_count, sizeof *places, compare_depth);
    for (uint32_t i = 0; i < system->body_count; i++)
        draw_body(panel, &system->bodies[places[i].body], &places[i].seen);
}

static void draw_links(const Panel *panel) {
    const AutoSystem *system = panel->system;
    for (uint32_t i = 0; i < system->link_count; i++) {
        Projected from = project_point(panel, system->bodies[system->links[i].from].position);
        Projected to = project_point(panel, system->bodies[system->links[i].to].position);
        Colour colour = fade_with_depth(panel, (Colour){0.6, 0.65, 0.7}, (from.depth + to.depth) / 2);
        Line line = line_between(from.x, from.y, to.x, to.y);
        draw_lines(panel, &line, 1, 1, colour, 0.4);
    }
}

static const Colour WALL = {0.75, 0.7, 0.55};

// Draws the barrier of a one- or two-dimensional system: a line, with the blocked side shaded.
static void draw_wall(const Panel *panel, const AutoBarrier *barrier) {
    Projected at = project_point(panel, barrier->position);
    double nx = barrier->normal[0], ny = panel->system->dimensions == 1 ? 0 : -barrier->normal[1];
    double length = maths_hypot(nx, ny), far = panel->width + panel->height;
    if (!(length > 0) || !isfinite(length))
        return;
    nx /= length;
    ny /= length;
    // Starts from the point of the wall nearest to the panel's centre, because the barrier's position can be far away.
    double along = (panel->x - at.x) * -ny + (panel->y - at.y) * nx;
    double x = at.x - ny * along, y = at.y + nx * along;
    // The first two points are the line.
    const double box[] = {PATH_MOVE,           x - ny * far, y + nx * far,        PATH_LINE,
                          x + ny * far,        y - nx * far, PATH_LINE,           x + (ny - nx) * far,
                          y - (nx + ny) * far, PATH_LINE,    x - (ny + nx) * far, y + (nx - ny) * far};
    draw_path(panel, box, 6, 2, WALL, 0.9, NULL);
    draw_path(panel, box, 12, 0, WALL, 0.12, NULL);
}

// Draws the barrier of a three-dimensional system: a grid of lines around the point of the wall nearest to the view's
// centre.
static void draw_grid(const Panel *panel, const AutoBarrier *barrier) {
    enum { LINES = 4 };
    const AutoFrame *frame = &panel->system->frame;
    const double *n = barrier->normal;
    double away = 0, foot[3], u[3], v[3];
    Line lines[2 * (2 * LINES + 1)];
    for (int k = 0; k < 3; k++)
        away += (frame->middle[k] - barrier->position[k]) * n[k];
    if (!(fabs(away) < 1.6 * frame->half)) // the wall is outside the view
        return;
    for (int k = 0; k < 3; k++)
        foot[k] = frame->middle[k] - away * n[k];
    int axis = fabs(n[0]) <= fabs(n[1]) && fabs(n[0]) <= fabs(n[2]) ? 0 : fabs(n[1]) <= fabs(n[2]) ? 1 : 2;
    double e[3] = {axis == 0, axis == 1, axis == 2};
    double length = sqrt(1 - n[axis] * n[axis]);
    for (int k = 0; k < 3; k++)
        u[k] = (e[k] - n[axis] * n[k]) / length;
    for (int k = 0; k < 3; k++)
        v[k] = n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3];
    for (int i = 0; i < 2 * (2 * LINES + 1); i++) {
        const double *a = i % 2 ? v : u, *b = i % 2 ? u : v;
        double part = frame->half * (i / 2 - LINES) / LINES;
        double one[3], two[3];
        for (int k = 0; k < 3; k++) {
            one[k] = foot[k] + a[k] * part + b[k] * frame->half;
            two[k] = foot[k] + a[k] * part - b[k] * frame->half;
        }
        Projected from = project_point(panel, one), to = project_point(panel, two);
        lines[i] = line_between(from.x, from.y, to.x, to.y);
    }
    draw_lines(panel, lines, sizeof lines / sizeof *lines, 1, WALL, 0.3);
}

static void draw_barriers(const Panel *panel) {
    for (uint32_t i = 0; i < panel->system->barrier_count; i++)
        if (panel->system->dimensions == 3)
            draw_grid(panel, &panel->system->barriers[i]);
        else
            draw_wall(panel, &panel->system->barriers[i]);
}

static const Colour MARK = {0.5, 0.55, 0.6};

// Draws the axes through the origin, across the whole view.
static void draw_origin(const Panel *panel) {
    const AutoFrame *frame = &panel->system->frame;
    uint32_t axes = panel->system->dimensions == 3 ? 3 : 2;
    const double far = 2 * (panel->width + panel->height) / panel->scale;
    Line lines[3];
    for (uint32_t k = 0; k < axes; k++) {
        double from[3] = {0}, to[3] = {0}, length = axes == 3 ? frame->half : far;
        from[k] = (axes == 3 ? 0 : frame->middle[k]) - length;
        to[k] = (axes == 3 ? 0 : frame->middle[k]) + length;
        Projected a = project_point(panel, from), b = project_point(panel, to);
        lines[k] = line_between(a.x, a.y, b.x, b.y);
    }
    draw_lines(panel, lines, axes, 1, MARK, 0.25);
}

static void draw_scale(const Panel *panel) {
    const AutoSystem *system = panel->system;
    double left = panel->x - panel->width / 2, bottom = panel->y + panel->height / 2, pixel = panel->pixel;
    Line *lines = arena_alloc_array(panel->target->arena, system->scale_count, sizeof *lines);
    for (uint32_t i = 0; i < system->scale_count; i++) {
        const AutoLine *at = &system->scale[i];
        lines[i] = line_between(left + at->x1 * pixel, bottom - at->y1 * pixel, left + at->x2 * pixel,
                                bottom - at->y2 * pixel);
    }
    draw_lines(panel, lines, system->scale_count, 1.5, MARK, 0.8);
}

static void draw_panel(const Panel *panel) {
    double left = panel->x - panel->width / 2, top = panel->y - panel->height / 2;
    panel->target->clip(panel->target->context, (const double[]){left, top, panel->width, panel->height});
    draw_origin(panel);
    draw_barriers(panel);
    if (panel->system->dimensions == 1) { // the line that all bodies lie on
        double y = project_point(panel, (const double[3]){panel->system->frame.middle[0]}).y;
        Line line = line_between(left, y, left + panel->width, y);
        draw_lines(panel, &line, 1, 1, MARK, 0.5);
    }
    draw_links(panel);
    draw_bodies(panel);
    draw_scale(panel);
    panel->target->clip(panel->target->context, NULL);
}

void auto_draw(const AutoTarget *target, const AutoPicture *picture) {
    uint32_t columns = 1, count = picture->count ? picture->count : 1;
    while (columns * columns < count)
        columns++;
    uint32_t rows = (count + columns - 1) / columns;
    double width = target->width / columns, height = target->height / rows;
    for (uint32_t i = 0; i < picture->count; i++) {
        const AutoSystem *system = &picture->systems[i];
        double side = fmin(width, height) / 2 * (1 - 2 * AUTO_MARGIN), pixel = fmin(width, height) / AUTO_PANEL;
        draw_panel(&(Panel){.target = target,
                            .system = system,
                            .x = (i % columns + 0.5) * width,
                            .y = (i / columns + 0.5) * height,
                            .side = side,
                            .scale = side / system->frame.half,
                            .width = width,
                            .height = height,
                            .pixel = pixel,
                            .min_radius = fmax(MIN_RADIUS * pixel, MIN_DEVICE_RADIUS / target->scale)});
    }
}
