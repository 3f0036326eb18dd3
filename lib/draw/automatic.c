// automatic.c: the automatic picture of particle systems, as shapes for any target; see automatic.h.
#include "draw/automatic.h"

#include "maths/maths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const AutoColour GROUND = AUTO_GROUND;
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

static AutoColour mix_colours(AutoColour a, AutoColour b, double part) {
    return (AutoColour){a.r + (b.r - a.r) * part, a.g + (b.g - a.g) * part, a.b + (b.b - a.b) * part};
}

// Returns the colour for `shade`, which is a charge (blue through white to orange) or a speed (deep blue through
// turquoise to pale yellow).
static AutoColour shade_colour(const AutoSystem *system, double shade) {
    static const AutoColour negative = {0.25, 0.55, 1}, neutral = {0.85, 0.87, 0.9}, positive = {1, 0.5, 0.15};
    static const AutoColour slow = {0.2, 0.35, 0.75}, middle = {0.2, 0.75, 0.7}, fast = {1, 0.95, 0.6};
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
static AutoColour fade_with_depth(const Panel *panel, AutoColour colour, double depth) {
    return panel->system->dimensions < 3 ? colour : mix_colours(colour, GROUND, fmin(fmax(0.3 + 0.3 * depth, 0), 0.8));
}

static void draw(const Panel *panel, AutoShape shape) {
    panel->target->draw(panel->target->context, &shape);
}

// Draws lines between successive pairs of points.
static void draw_lines(const Panel *panel, const double *points, uint32_t count, double width, AutoColour colour,
                       double alpha) {
    draw(panel, (AutoShape){.kind = AUTO_LINES,
                            .points = points,
                            .count = count,
                            .size = width * panel->pixel,
                            .colour = colour,
                            .alpha = alpha});
}

static void draw_body(const Panel *panel, const AutoBody *body, const Projected *seen) {
    double radius = body->radius * seen->size, centre[] = {seen->x, seen->y};
    double shown = fmin(fmax(radius, panel->min_radius), 4 * (panel->width + panel->height));
    bool small = shown <= panel->min_radius;
    AutoShape shape = {.kind = AUTO_DISC,
                       .points = centre,
                       .count = 1,
                       .size = shown,
                       .colour = fade_with_depth(panel, shade_colour(panel->system, body->shade), seen->depth),
                       .alpha = small ? 1 : 0.85};
    if (body->anchor) {
        shape.kind = AUTO_RING;
        shape.line = 1.5 * panel->pixel;
        shape.size = fmax(shown - shape.line / 2, fmax(panel->min_radius, 3 * panel->pixel));
        shape.alpha = 1;
    } else if (panel->system->dimensions == 3 && !small) {
        shape.kind = AUTO_BALL;
        shape.light = mix_colours(shape.colour, (AutoColour){1, 1, 1}, 0.5);
        shape.dark = mix_colours(shape.colour, (AutoColour){0, 0, 0}, 0.65);
    }
    draw(panel, shape);
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
        AutoColour colour = fade_with_depth(panel, (AutoColour){0.6, 0.65, 0.7}, (from.depth + to.depth) / 2);
        draw_lines(panel, (const double[]){from.x, from.y, to.x, to.y}, 2, 1, colour, 0.4);
    }
}

static const AutoColour WALL = {0.75, 0.7, 0.55};

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
    const double corners[] = {x - ny * far,        y + nx * far,        x + ny * far,        y - nx * far,
                              x + (ny - nx) * far, y - (nx + ny) * far, x - (ny + nx) * far, y + (nx - ny) * far};
    draw(panel, (AutoShape){.kind = AUTO_WALL,
                            .points = corners,
                            .count = 4,
                            .size = far,
                            .line = 2 * panel->pixel,
                            .colour = WALL,
                            .alpha = 0.9});
}

// Draws the barrier of a three-dimensional system: a grid of lines around the point of the wall nearest to the view's
// centre.
static void draw_grid(const Panel *panel, const AutoBarrier *barrier) {
    enum { LINES = 4 };
    const AutoFrame *frame = &panel->system->frame;
    const double *n = barrier->normal;
    double away = 0, foot[3], u[3], v[3], points[2 * (2 * LINES + 1)][2][2];
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
        for (int end = 0; end < 2; end++) {
            double point[3];
            for (int k = 0; k < 3; k++)
                point[k] =
                    end ? foot[k] + a[k] * part - b[k] * frame->half : foot[k] + a[k] * part + b[k] * frame->half;
            Projected seen = project_point(panel, point);
            points[i][end][0] = seen.x;
            points[i][end][1] = seen.y;
        }
    }
    draw_lines(panel, &points[0][0][0], sizeof points / sizeof points[0][0], 1, WALL, 0.3);
}

static void draw_barriers(const Panel *panel) {
    for (uint32_t i = 0; i < panel->system->barrier_count; i++)
        if (panel->system->dimensions == 3)
            draw_grid(panel, &panel->system->barriers[i]);
        else
            draw_wall(panel, &panel->system->barriers[i]);
}

static const AutoColour MARK = {0.5, 0.55, 0.6};

// Draws the axes through the origin, across the whole view.
static void draw_origin(const Panel *panel) {
    const AutoFrame *frame = &panel->system->frame;
    uint32_t axes = panel->system->dimensions == 3 ? 3 : 2;
    const double far = 2 * (panel->width + panel->height) / panel->scale;
    double points[12];
    for (uint32_t k = 0; k < axes; k++) {
        double from[3] = {0}, to[3] = {0}, length = axes == 3 ? frame->half : far;
        from[k] = (axes == 3 ? 0 : frame->middle[k]) - length;
        to[k] = (axes == 3 ? 0 : frame->middle[k]) + length;
        Projected a = project_point(panel, from), b = project_point(panel, to);
        memcpy(points + 4 * k, (const double[]){a.x, a.y, b.x, b.y}, 4 * sizeof *points);
    }
    draw_lines(panel, points, 2 * axes, 1, MARK, 0.25);
}

static void draw_scale(const Panel *panel) {
    const AutoSystem *system = panel->system;
    double left = panel->x - panel->width / 2, bottom = panel->y + panel->height / 2, pixel = panel->pixel;
    double *points = arena_alloc_array(panel->target->arena, system->scale_count, 4 * sizeof *points);
    for (uint32_t i = 0; i < system->scale_count; i++) {
        const AutoLine *at = &system->scale[i];
        points[4 * i] = left + at->x1 * pixel;
        points[4 * i + 1] = bottom - at->y1 * pixel;
        points[4 * i + 2] = left + at->x2 * pixel;
        points[4 * i + 3] = bottom - at->y2 * pixel;
    }
    draw_lines(panel, points, 2 * system->scale_count, 1.5, MARK, 0.8);
}

static void draw_panel(const Panel *panel) {
    double left = panel->x - panel->width / 2, top = panel->y - panel->height / 2;
    const double box[] = {left, top, panel->width, panel->height};
    draw(panel, (AutoShape){.kind = AUTO_PANEL_START, .points = box, .count = 2, .colour = GROUND, .alpha = 1});
    draw_origin(panel);
    draw_barriers(panel);
    if (panel->system->dimensions == 1) { // the line that all bodies lie on
        double y = project_point(panel, (const double[3]){panel->system->frame.middle[0]}).y;
        draw_lines(panel, (const double[]){left, y, left + panel->width, y}, 2, 1, MARK, 0.5);
    }
    draw_links(panel);
    draw_bodies(panel);
    draw_scale(panel);
    draw(panel, (AutoShape){.kind = AUTO_PANEL_END});
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
