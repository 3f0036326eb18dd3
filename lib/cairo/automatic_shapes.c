// automatic_shapes.c: draws the shapes of the automatic picture (automatic.h) with Cairo.
#include "cairo/canvas.h"

static void set_ground(cairo_t *cr) {
    cairo_set_source_rgb(cr, AUTO_GROUND);
}

static void clip(void *context, const double *box) {
    cairo_t *cr = ((Canvas *)context)->cr;
    if (!box) {
        cairo_restore(cr);
        return;
    }
    cairo_save(cr);
    cairo_rectangle(cr, box[0], box[1], box[2], box[3]);
    cairo_clip(cr);
    set_ground(cr);
    cairo_paint(cr);
}

static void set_gradient(cairo_t *cr, const AutoGradient *gradient) {
    const double *from = gradient->inner, *to = gradient->outer;
    cairo_pattern_t *pattern = cairo_pattern_create_radial(from[0], from[1], from[2], to[0], to[1], to[2]);
    for (int i = 0; i < 3; i++) {
        const double *c = gradient->stops[i].color;
        cairo_pattern_add_color_stop_rgb(pattern, gradient->stops[i].offset, c[0], c[1], c[2]);
    }
    cairo_set_source(cr, pattern);
    cairo_pattern_destroy(pattern);
}

static void draw_shape(void *context, const AutoShape *shape) {
    Canvas *canvas = context;
    cairo_t *cr = canvas->cr;
    draw_forget_path(canvas);
    draw_add_elements(canvas, (DisplayNumbers){shape->path, shape->length});
    const double source = shape->gradient ? PETRI_DRAW_RADIAL : PETRI_DRAW_COLOR;
    const DisplayPaint paint = {.source = &source, .style.mode = COMPOSITE_OVER};
    if (shape->line == 0 && !draw_charge_path(canvas, &paint, true, false)) {
        cairo_new_path(cr);
        return;
    }
    if (shape->gradient)
        set_gradient(cr, shape->gradient);
    else
        cairo_set_source_rgba(cr, shape->color[0], shape->color[1], shape->color[2], shape->color[3]);
    cairo_set_line_width(cr, shape->line);
    (shape->line == 0 ? cairo_fill : cairo_stroke)(cr);
}

void draw_automatic(Canvas *canvas, const AutoPicture *picture) {
    set_ground(canvas->cr);
    cairo_paint(canvas->cr);
    auto_draw(&(AutoTarget){.arena = &canvas->painter->arena,
                            .width = canvas->picture->width,
                            .height = canvas->picture->height,
                            .scale = draw_scale_of(canvas->cr),
                            .clip = clip,
                            .draw = draw_shape,
                            .context = canvas},
              picture);
}
