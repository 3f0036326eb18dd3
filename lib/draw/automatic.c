// automatic.c: draws the automatic picture of particle systems; see automatic.h.
#include "draw/draw.h"
#include "maths/maths.h"

#include <math.h>
#include <stdlib.h>

typedef struct Colour {
    double r, g, b;
} Colour;

static const Colour GROUND = {0.06, 0.07, 0.09};
// Minimum radii of bodies: in panel pixels, and in pixels of the target. The larger of the two applies.
static const double MIN_RADIUS = 2, MIN_DEVICE_RADIUS = 1.5;
// The camera is 0.45 radians to the right of the front view and 0.35 radians above it.
static const double COS_YAW = 0.9004471023526769, SIN_YAW = 0.43496553411123023;
static const double COS_PITCH = 0.9393727128473789, SIN_PITCH = 0.34289780745545134;
static const double EYE = 4; // distance of the camera from the centre, in units of half the view's side

// The area in which a system is drawn.
typedef struct Panel {
    Canvas *canvas;
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

static void set_colour(cairo_t *cr, Colour c, double alpha) {
    cairo_set_source_rgba(cr, c.r, c.g, c.b, alpha);
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

static void add_circle(Canvas *canvas, double x, double y, double radius) {
    draw_clamp_point(canvas, &x, &y);
    draw_ellipse_path(canvas, x, y, radius, radius, 0, 1, false);
    cairo_close_path(canvas->cr);
}

// Sets a gradient that shades a circle like a ball lit from the upper left.
static void set_ball(cairo_t *cr, const Projected *seen, double radius, Colour colour) {
    cairo_pattern_t *ball = cairo_pattern_create_radial(seen->x - radius * 0.35, seen->y - radius * 0.4, radius * 0.05,
                                                        seen->x - radius * 0.1, seen->y - radius * 0.1, radius * 1.15);
    Colour light = mix_colours(colour, (Colour){1, 1, 1}, 0.5), dark = mix_colours(colour, (Colour){0, 0, 0}, 0.65);
    cairo_pattern_add_color_stop_rgb(ball, 0, light.r, light.g, light.b);
    cairo_pattern_add_color_stop_rgb(ball, 0.45, colour.r, colour.g, colour.b);
    cairo_pattern_add_color_stop_rgb(ball, 1, dark.r, dark.g, dark.b);
    cairo_set_source(cr, ball);
    cairo_pattern_destroy(ball);
}

// Paints that are passed to the cost model: a plain colour and a gradient.
static const DisplayPaint PLAIN = {.composite = COMPOSITE_OVER, .source = DISPLAY_NONE},
                          SHADED = {.composite = COMPOSITE_OVER};

static void draw_body(const Panel *panel, const AutoBody *body, const Projected *seen) {
    cairo_t *cr = panel->canvas->cr;
    double radius = body->radius * seen->size;
    double shown = fmin(fmax(radius, panel->min_radius), 4 * (panel->width + panel->height));
    Colour colour = fade_with_depth(panel, shade_colour(panel->system, body->shade), seen->depth);
    if (body->anchor) {
        double line = 1.5 * panel->pixel;
        add_circle(panel->canvas, seen->x, seen->y, fmax(shown - line / 2, fmax(panel->min_radius, 3 * panel->pixel)));
        cairo_set_line_width(cr, line);
        set_colour(cr, colour, 1);
        cairo_stroke(cr);
        return;
    }
    bool small = shown <= panel->min_radius, ball = panel->system->dimensions == 3 && !small;
    draw_forget_path(panel->canvas);
    add_circle(panel->canvas, seen->x, seen->y, shown);
    if (!draw_charge_path(panel->canvas, ball ? &SHADED : &PLAIN, true, false)) {
        cairo_new_path(cr);
    } else if (ball) {
        set_ball(cr, seen, shown, colour);
        cairo_fill(cr);
    } else {
        set_colour(cr, colour, small ? 1 : 0.85);
        cairo_fill(cr);
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
    Arena *arena = &panel->canvas->painter->arena;
    DepthEntry *places = arena_alloc_array(arena, system->body_count, sizeof *places);
    for (uint32_t i = 0; i < system->body_count; i++)
        places[i] = (DepthEntry){project_point(panel, system->bodies[i].position), i};
    if (system->dimensions == 3)
        qsort(places, system->body_count, sizeof *places, compare_depth);
    for (uint32_t i = 0; i < system->body_count; i++)
        draw_body(panel, &system->bodies[places[i].body], &places[i].seen);
}

static void add_line(Canvas *canvas, double x1, double y1, double x2, double y2) {
    draw_clamp_point(canvas, &x1, &y1);
    draw_clamp_point(canvas, &x2, &y2);
    cairo_move_to(canvas->cr, x1, y1);
    cairo_line_to(canvas->cr, x2, y2);
}

static void draw_links(const Panel *panel) {
    const AutoSystem *system = panel->system;
    cairo_t *cr = panel->canvas->cr;
    cairo_set_line_width(cr, panel->pixel);
    for (uint32_t i = 0; i < system->link_count; i++) {
        Projected from = project_point(panel, system->bodies[system->links[i].from].position);
        Projected to = project_point(panel, system->bodies[system->links[i].to].position);
        add_line(panel->canvas, from.x, from.y, to.x, to.y);
        set_colour(cr, fade_with_depth(panel, (Colour){0.6, 0.65, 0.7}, (from.depth + to.depth) / 2), 0.4);
        cairo_stroke(cr);
    }
}

static const Colour WALL = {0.75, 0.7, 0.55};

// Draws the barrier of a one- or two-dimensional system: a line, with the blocked side shaded.
static void draw_wall(const Panel *panel, const AutoBarrier *barrier) {
    cairo_t *cr = panel->canvas->cr;
    Projected at = project_point(panel, barrier->position);
    double nx = barrier->normal[0], ny = panel->system->dimensions == 1 ? 0 : -barrier->normal[1];
    double length = maths_hypot(nx, ny), far = panel->width + panel->height;
    if (!(length > 0) || !isfinite(length) || !draw_charge_box(panel->canvas, &PLAIN, far, far, 1))
        return;
    nx /= length;
    ny /= length;
    // Starts from the point of the wall nearest to the panel's centre, because the barrier's position can be far away.
    double along = (panel->x - at.x) * -ny + (panel->y - at.y) * nx;
    double x = at.x - ny * along, y = at.y + nx * along;
    cairo_move_to(cr, x - ny * far, y + nx * far);
    cairo_line_to(cr, x + ny * far, y - nx * far);
    cairo_set_line_width(cr, 2 * panel->pixel);
    set_colour(cr, WALL, 0.9);
    cairo_stroke(cr);
    cairo_move_to(cr, x - ny * far, y + nx * far);
    cairo_line_to(cr, x + ny * far, y - nx * far);
    cairo_line_to(cr, x + (ny - nx) * far, y - (nx + ny) * far);
    cairo_line_to(cr, x - (ny + nx) * far, y + (nx - ny) * far);
    set_colour(cr, WALL, 0.12);
    cairo_fill(cr);
}

// Draws the barrier of a three-dimensional system: a grid of lines around the point of the wall nearest to the view's
// centre.
static void draw_grid(const Panel *panel, const AutoBarrier *barrier) {
    enum { LINES = 4 };
    cairo_t *cr = panel->canvas->cr;
    const AutoFrame *frame = &panel->system->frame;
    const double *n = barrier->normal;
    double away = 0, foot[3], u[3], v[3];
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
    cairo_set_line_width(cr, panel->pixel);
    for (int i = -LINES; i <= LINES; i++)
        for (int turned = 0; turned < 2; turned++) {
            const double *a = turned ? v : u, *b = turned ? u : v;
            double one[3], two[3], part = frame->half * i / LINES;
            for (int k = 0; k < 3; k++) {
                one[k] = foot[k] + a[k] * part + b[k] * frame->half;
                two[k] = foot[k] + a[k] * part - b[k] * frame->half;
            }
            Projected from = project_point(panel, one), to = project_point(panel, two);
            add_line(panel->canvas, from.x, from.y, to.x, to.y);
        }
    set_colour(cr, WALL, 0.3);
    cairo_stroke(cr);
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
    for (uint32_t k = 0; k < axes; k++) {
        double from[3] = {0}, to[3] = {0}, length = axes == 3 ? frame->half : far;
        from[k] = (axes == 3 ? 0 : frame->middle[k]) - length;
        to[k] = (axes == 3 ? 0 : frame->middle[k]) + length;
        Projected a = project_point(panel, from), b = project_point(panel, to);
        add_line(panel->canvas, a.x, a.y, b.x, b.y);
    }
    cairo_set_line_width(panel->canvas->cr, panel->pixel);
    set_colour(panel->canvas->cr, MARK, 0.25);
    cairo_stroke(panel->canvas->cr);
}

static void draw_scale(const Panel *panel) {
    const AutoSystem *system = panel->system;
    double left = panel->x - panel->width / 2, bottom = panel->y + panel->height / 2, pixel = panel->pixel;
    for (uint32_t i = 0; i < system->scale_count; i++) {
        const AutoLine *at = &system->scale[i];
        add_line(panel->canvas, left + at->x1 * pixel, bottom - at->y1 * pixel, left + at->x2 * pixel,
                 bottom - at->y2 * pixel);
    }
    cairo_set_line_width(panel->canvas->cr, 1.5 * pixel);
    set_colour(panel->canvas->cr, MARK, 0.8);
    cairo_stroke(panel->canvas->cr);
}

static void draw_panel(Panel *panel) {
    cairo_t *cr = panel->canvas->cr;
    double left = panel->x - panel->width / 2, top = panel->y - panel->height / 2;
    cairo_save(cr);
    cairo_rectangle(cr, left, top, panel->width, panel->height);
    cairo_clip(cr);
    set_colour(cr, GROUND, 1);
    cairo_paint(cr);
    draw_origin(panel);
    draw_barriers(panel);
    if (panel->system->dimensions == 1) { // the line that all bodies lie on
        double middle[3] = {panel->system->frame.middle[0], 0, 0};
        add_line(panel->canvas, left, project_point(panel, middle).y, left + panel->width,
                 project_point(panel, middle).y);
        cairo_set_line_width(cr, panel->pixel);
        set_colour(cr, MARK, 0.5);
        cairo_stroke(cr);
    }
    draw_links(panel);
    draw_bodies(panel);
    draw_scale(panel);
    cairo_restore(cr);
}

void draw_automatic(Canvas *canvas, const AutoPicture *picture) {
    const CanvasPicture *whole = canvas->picture;
    uint32_t columns = 1, count = picture->count ? picture->count : 1;
    while (columns * columns < count)
        columns++;
    uint32_t rows = (count + columns - 1) / columns;
    double width = whole->width / columns, height = whole->height / rows;
    set_colour(canvas->cr, GROUND, 1);
    cairo_paint(canvas->cr);
    for (uint32_t i = 0; i < picture->count; i++) {
        const AutoSystem *system = &picture->systems[i];
        double side = fmin(width, height) / 2 * (1 - 2 * AUTO_MARGIN);
        Panel panel = {.canvas = canvas,
                       .system = system,
                       .x = (i % columns + 0.5) * width,
                       .y = (i / columns + 0.5) * height,
                       .side = side,
                       .scale = side / system->frame.half,
                       .width = width,
                       .height = height,
                       .pixel = fmin(width, height) / AUTO_PANEL};
        panel.min_radius = fmax(MIN_RADIUS * panel.pixel, MIN_DEVICE_RADIUS / draw_scale_of(canvas->cr));
        draw_panel(&panel);
    }
}
