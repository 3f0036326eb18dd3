// cairo_automatic.c: draws the shapes of the automatic picture (automatic.h) with Cairo.
#include "draw/draw.h"

static void set_colour(cairo_t *cr, AutoColour c, double alpha) {
    cairo_set_source_rgba(cr, c.r, c.g, c.b, alpha);
}

static void set_ball(cairo_t *cr, const AutoShape *ball) {
    static const double inner[] = AUTO_BALL_INNER, outer[] = AUTO_BALL_OUTER;
    double x = ball->points[0], y = ball->points[1], radius = ball->size;
    cairo_pattern_t *gradient =
        cairo_pattern_create_radial(x + radius * inner[0], y + radius * inner[1], radius * inner[2],
                                    x + radius * outer[0], y + radius * outer[1], radius * outer[2]);
    cairo_pattern_add_color_stop_rgb(gradient, 0, ball->light.r, ball->light.g, ball->light.b);
    cairo_pattern_add_color_stop_rgb(gradient, AUTO_BALL_MIDDLE, ball->colour.r, ball->colour.g, ball->colour.b);
    cairo_pattern_add_color_stop_rgb(gradient, 1, ball->dark.r, ball->dark.g, ball->dark.b);
    cairo_set_source(cr, gradient);
    cairo_pattern_destroy(gradient);
}

// Paints that are passed to the cost model: a plain colour and a gradient.
static const DisplayPaint PLAIN = {.composite = COMPOSITE_OVER, .source = DISPLAY_NONE},
                          SHADED = {.composite = COMPOSITE_OVER};

static void draw_lines(Canvas *canvas, const AutoShape *lines) {
    for (uint32_t i = 0; i < lines->count; i++) {
        double x = lines->points[2 * i], y = lines->points[2 * i + 1];
        draw_clamp_point(canvas, &x, &y);
        (i % 2 ? cairo_line_to : cairo_move_to)(canvas->cr, x, y);
    }
    cairo_set_line_width(canvas->cr, lines->size);
    set_colour(canvas->cr, lines->colour, lines->alpha);
    cairo_stroke(canvas->cr);
}

static void draw_wall(Canvas *canvas, const AutoShape *wall) {
    cairo_t *cr = canvas->cr;
    const double *p = wall->points;
    if (!draw_charge_box(canvas, &PLAIN, wall->size, wall->size, 1))
        return;
    cairo_move_to(cr, p[0], p[1]);
    cairo_line_to(cr, p[2], p[3]);
    cairo_set_line_width(cr, wall->line);
    set_colour(cr, wall->colour, wall->alpha);
    cairo_stroke(cr);
    for (uint32_t i = 0; i < wall->count; i++)
        (i > 0 ? cairo_line_to : cairo_move_to)(cr, p[2 * i], p[2 * i + 1]);
    set_colour(cr, wall->colour, AUTO_WALL_ALPHA);
    cairo_fill(cr);
}

static void draw_disc(Canvas *canvas, const AutoShape *disc) {
    cairo_t *cr = canvas->cr;
    double x = disc->points[0], y = disc->points[1];
    draw_forget_path(canvas);
    draw_clamp_point(canvas, &x, &y);
    draw_ellipse_path(canvas, x, y, disc->size, disc->size, 0, 1, false);
    cairo_close_path(cr);
    if (disc->kind != AUTO_RING && !draw_charge_path(canvas, disc->kind == AUTO_BALL ? &SHADED : &PLAIN, true, false)) {
        cairo_new_path(cr);
        return;
    }
    if (disc->kind == AUTO_BALL)
        set_ball(cr, disc);
    else
        set_colour(cr, disc->colour, disc->alpha);
    cairo_set_line_width(cr, disc->line);
    (disc->kind == AUTO_RING ? cairo_stroke : cairo_fill)(cr);
}

static void draw_shape(void *context, const AutoShape *shape) {
    Canvas *canvas = context;
    cairo_t *cr = canvas->cr;
    const double *p = shape->points;
    switch (shape->kind) {
    case AUTO_PANEL_START:
        cairo_save(cr);
        cairo_rectangle(cr, p[0], p[1], p[2], p[3]);
        cairo_clip(cr);
        set_colour(cr, shape->colour, 1);
        cairo_paint(cr);
        break;
    case AUTO_PANEL_END:
        cairo_restore(cr);
        break;
    case AUTO_LINES:
        draw_lines(canvas, shape);
        break;
    case AUTO_WALL:
        draw_wall(canvas, shape);
        break;
    case AUTO_DISC:
    case AUTO_RING:
    case AUTO_BALL:
        draw_disc(canvas, shape);
        break;
    }
}

void draw_automatic(Canvas *canvas, const AutoPicture *picture) {
    set_colour(canvas->cr, (AutoColour)AUTO_GROUND, 1);
    cairo_paint(canvas->cr);
    auto_draw(&(AutoTarget){.arena = &canvas->painter->arena,
                            .width = canvas->picture->width,
                            .height = canvas->picture->height,
                            .scale = draw_scale_of(canvas->cr),
                            .draw = draw_shape,
                            .context = canvas},
              picture);
}
