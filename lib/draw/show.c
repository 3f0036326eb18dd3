// show.c: shows a list of commands with Cairo.
#include "draw/light.h"

#include <math.h>

enum { MOST_LAYERS = 64 }; // open at a time
static const double MOST_LAYER_PIXELS = 1 << 27;

typedef struct Layers {
    bool drawn[MOST_LAYERS]; // whether a layer of its own has been begun
    double pixels[MOST_LAYERS];
    Sheet below[MOST_LAYERS]; // of a wide canvas
    uint32_t depth;           // of what is open; beyond MOST_LAYERS all are drawn without
} Layers;

bool draw_is_invertible(const cairo_matrix_t *m) {
    return list_invertible(&(ListMatrix){m->xx, m->yx, m->xy, m->yy, m->x0, m->y0});
}

double draw_scale_of(cairo_t *cr) {
    cairo_matrix_t m;
    cairo_get_matrix(cr, &m);
    return sqrt(fabs(m.xx * m.yy - m.xy * m.yx));
}

// Begins a layer unless there are too many: they take memory, and time.
static void begin_layer(Canvas *canvas, Layers *layers, const Origin *place) {
    double x1, y1, x2, y2;
    uint32_t at = layers->depth++;
    bool wide = canvas->wide.pixels != NULL;
    cairo_save(canvas->cr);
    cairo_identity_matrix(canvas->cr);
    cairo_clip_extents(canvas->cr, &x1, &y1, &x2, &y2);
    cairo_restore(canvas->cr);
    double pixels = wide ? (double)canvas->wide.width * canvas->wide.height : (x2 - x1) * (y2 - y1);
    bool many = at >= MOST_LAYERS || canvas->layer_pixels + pixels > MOST_LAYER_PIXELS;
    if (at < MOST_LAYERS)
        layers->drawn[at] = false;
    if (many) {
        draw_fault_at(canvas, place, DIAG_WARNING, "too-many-layers",
                      "!layer: layers are too many or too large; the innermost are drawn without");
        return;
    }
    if (!draw_spend(canvas, place, pixels, "what is in here is drawn without a layer"))
        return;
    if (wide)
        layers->below[at] = light_begin(canvas);
    bool lacking =
        wide ? canvas->wide.pixels == layers->below[at].pixels : !draw_take(canvas, (size_t)pixels * sizeof(uint32_t));
    draw_lacks(canvas, place, "the layer", lacking);
    if (lacking)
        return;
    layers->drawn[at] = true;
    layers->pixels[at] = pixels;
    canvas->layer_pixels += pixels;
    if (!wide)
        cairo_push_group(canvas->cr);
}

static void end_layer(Canvas *canvas, Layers *layers, double alpha) {
    uint32_t at = --layers->depth;
    if (at >= MOST_LAYERS || !layers->drawn[at])
        return;
    canvas->layer_pixels -= layers->pixels[at];
    if (canvas->wide.pixels) {
        light_end(canvas, layers->below[at], alpha);
        return;
    }
    cairo_pop_group_to_source(canvas->cr);
    cairo_set_operator(canvas->cr, CAIRO_OPERATOR_OVER);
    cairo_paint_with_alpha(canvas->cr, alpha);
    draw_give(canvas, (size_t)layers->pixels[at] * sizeof(uint32_t));
}

// With even-odd, a rectangle around everything turns a figure inside out.
static void add_frame(Canvas *canvas) {
    double x1, y1, x2, y2;
    cairo_t *cr = canvas->cr;
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_clip_extents(cr, &x1, &y1, &x2, &y2);
    cairo_rectangle(cr, floor(x1) - 1, floor(y1) - 1, ceil(x2) - floor(x1) + 2, ceil(y2) - floor(y1) + 2);
    cairo_restore(cr);
}

static void clip(Canvas *canvas, const ListCommand *command) {
    int fill_type = command->path.fill_type;
    bool inverse = (command->kind == LIST_MASK) != (fill_type > FILL_EVEN_ODD);
    draw_set_path(canvas, command);
    const ListPaint *paint = &canvas->list->paints.at[command->paint];
    if (!draw_is_drawable(canvas) || !draw_spend_figure(canvas, paint, false, false))
        return;
    if (inverse) {
        add_frame(canvas);
        fill_type = FILL_EVEN_ODD;
    }
    draw_set_edges(canvas, paint->antialias, fill_type);
    cairo_clip_preserve(canvas->cr);
    if (inverse)
        draw_forget_path(canvas);
}

void draw_plainly(Canvas *canvas, const ListCommand *command, const ListPaint *paint) {
    if (command->kind == LIST_TEXT) {
        draw_text(canvas, command, paint);
    } else if (command->kind == LIST_IMAGE) {
        draw_image(canvas, &canvas->list->images.at[command->item], paint);
    } else {
        draw_set_path(canvas, command);
        draw_figure(canvas, command, paint);
    }
}

static void show(Canvas *canvas, const ListCommand *command) {
    const ListPaint *paint = &canvas->list->paints.at[command->paint];
    (paint->filter != LIST_NONE ? draw_filtered : draw_plainly)(canvas, command, paint);
}

// False if nothing can be seen through it.
static bool set_matrix(Canvas *canvas, const ListMatrix *m) {
    cairo_matrix_t matrix = {m->xx, m->yx, m->xy, m->yy, m->x0, m->y0};
    cairo_matrix_multiply(&matrix, &matrix, &canvas->base);
    if (!draw_is_invertible(&matrix))
        return false;
    cairo_set_matrix(canvas->cr, &matrix);
    return true;
}

static void run(Canvas *canvas, const ListCommand *command, Layers *layers) {
    switch (command->kind) {
    case LIST_DRAW:
    case LIST_TEXT:
    case LIST_IMAGE:
        show(canvas, command);
        break;
    case LIST_CLIP:
    case LIST_MASK:
        clip(canvas, command);
        break;
    case LIST_SAVE:
        cairo_save(canvas->cr);
        break;
    case LIST_RESTORE:
        cairo_restore(canvas->cr);
        break;
    case LIST_LAYER:
        begin_layer(canvas, layers, &canvas->list->places.at[command->item]);
        break;
    case LIST_LAYER_END:
        end_layer(canvas, layers, command->alpha);
        break;
    }
}

void draw_list(Canvas *canvas, const List *list) {
    Layers layers = {.depth = 0};
    uint32_t matrix = LIST_NONE;
    bool seen = true;
    canvas->list = list;
    cairo_get_matrix(canvas->cr, &canvas->base);
    cairo_save(canvas->cr);
    draw_forget_path(canvas);
    for (uint32_t i = 0; i < list->commands.count; i++) {
        const ListCommand *command = &list->commands.at[i];
        if (command->matrix != matrix)
            seen = set_matrix(canvas, &list->matrices.at[command->matrix]);
        // These bring matrices of their own back.
        bool state = command->kind >= LIST_SAVE;
        matrix = state ? LIST_NONE : command->matrix;
        if (seen || state)
            run(canvas, command, &layers);
    }
    cairo_restore(canvas->cr);
    draw_forget_path(canvas);
    canvas->list = NULL;
}
