// list.c: draws a display list: its commands, clips and layers.
#include "cairo/hdr_composite.h"

#include <math.h>

enum { MAX_LAYERS = 64 }; // maximum number of layers that are open at the same time
static const double MAX_LAYER_PIXELS = 1 << 27;

typedef struct Layers {
    bool drawn[MAX_LAYERS]; // true if the layer has a separate surface, false if it is drawn directly
    double pixels[MAX_LAYERS];
    FloatImage below[MAX_LAYERS]; // for HDR canvases: the image below the layer
    uint32_t depth;               // number of open layers; layers with index MAX_LAYERS or more are drawn directly
} Layers;

// Begins a layer. If too many layers are open, or if they are too large, draws the content of this layer directly,
// because layers take memory and time.
static void begin_layer(Canvas *canvas, Layers *layers, const Origin *place) {
    double x1, y1, x2, y2;
    uint32_t at = layers->depth++;
    bool wide = canvas->hdr_target.pixels;
    cairo_save(canvas->cr);
    cairo_identity_matrix(canvas->cr);
    cairo_clip_extents(canvas->cr, &x1, &y1, &x2, &y2);
    cairo_restore(canvas->cr);
    double pixels = wide ? (double)canvas->hdr_target.width * canvas->hdr_target.height : (x2 - x1) * (y2 - y1);
    bool many = at >= MAX_LAYERS || canvas->layer_pixels + pixels > MAX_LAYER_PIXELS;
    if (at < MAX_LAYERS)
        layers->drawn[at] = false;
    if (many) {
        draw_report(canvas, place, DIAG_WARNING, "too-many-layers",
                    "!layer: layers are nested too deeply or too large; the innermost are drawn without a layer");
        return;
    }
    if (!draw_charge(canvas, place, pixels, "the content is drawn without the layer"))
        return;
    if (wide)
        layers->below[at] = hdr_begin_layer(canvas);
    bool degraded = wide ? canvas->hdr_target.pixels == layers->below[at].pixels
                         : !float_image_reserve(&canvas->pool, (size_t)pixels * sizeof(uint32_t));
    draw_report_degraded(canvas, place, "the layer", degraded);
    if (degraded)
        return;
    layers->drawn[at] = true;
    layers->pixels[at] = pixels;
    canvas->layer_pixels += pixels;
    if (!wide)
        cairo_push_group(canvas->cr);
}

static void end_layer(Canvas *canvas, Layers *layers, double alpha) {
    uint32_t at = --layers->depth;
    if (at >= MAX_LAYERS || !layers->drawn[at])
        return;
    canvas->layer_pixels -= layers->pixels[at];
    if (canvas->hdr_target.pixels) {
        hdr_end_layer(canvas, layers->below[at], alpha);
        return;
    }
    cairo_pop_group_to_source(canvas->cr);
    cairo_set_operator(canvas->cr, CAIRO_OPERATOR_OVER);
    cairo_paint_with_alpha(canvas->cr, alpha);
    float_image_release(&canvas->pool, (size_t)layers->pixels[at] * sizeof(uint32_t));
}

// Adds a rectangle around the clip area to the path. Under the even-odd rule, this inverts the path.
static void add_outer_rectangle(Canvas *canvas) {
    double x1, y1, x2, y2;
    cairo_t *cr = canvas->cr;
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_clip_extents(cr, &x1, &y1, &x2, &y2);
    cairo_rectangle(cr, floor(x1) - 1, floor(y1) - 1, ceil(x2) - floor(x1) + 2, ceil(y2) - floor(y1) + 2);
    cairo_restore(cr);
}

static void apply_clip(Canvas *canvas, const DisplayCommand *command) {
    int fill_type = command->path.fill_type;
    bool inverse = (command->kind == DISPLAY_MASK) != (fill_type > FILL_EVEN_ODD);
    draw_set_path(canvas, command);
    const DisplayPaint *paint = &canvas->list->paints.at[command->paint];
    if (!draw_is_drawable(canvas) || !draw_charge_path(canvas, paint, false, false))
        return;
    if (inverse) {
        add_outer_rectangle(canvas);
        fill_type = FILL_EVEN_ODD;
    }
    draw_set_edges(canvas, paint->antialias, fill_type);
    cairo_clip_preserve(canvas->cr);
    if (inverse)
        draw_forget_path(canvas);
}

// Sets the current transform. Returns false if it is not invertible, because nothing would be visible.
static bool set_matrix(Canvas *canvas, const DisplayMatrix *m) {
    cairo_matrix_t matrix = {m->xx, m->yx, m->xy, m->yy, m->x0, m->y0};
    cairo_matrix_multiply(&matrix, &matrix, &canvas->base);
    if (!draw_is_invertible(&matrix))
        return false;
    cairo_set_matrix(canvas->cr, &matrix);
    return true;
}

static void execute_command(Canvas *canvas, const DisplayCommand *command, Layers *layers) {
    switch (command->kind) {
    case DISPLAY_DRAW:
    case DISPLAY_TEXT:
    case DISPLAY_IMAGE:
        draw_command(canvas, command, &canvas->list->paints.at[command->paint]);
        break;
    case DISPLAY_CLIP:
    case DISPLAY_MASK:
        apply_clip(canvas, command);
        break;
    case DISPLAY_SAVE:
        cairo_save(canvas->cr);
        break;
    case DISPLAY_RESTORE:
        cairo_restore(canvas->cr);
        break;
    case DISPLAY_LAYER:
        begin_layer(canvas, layers, &canvas->list->places.at[command->item]);
        break;
    case DISPLAY_LAYER_END:
        end_layer(canvas, layers, command->alpha);
        break;
    }
}

void draw_display_list(Canvas *canvas, const DisplayList *list) {
    Layers layers = {.depth = 0};
    uint32_t matrix = DISPLAY_NONE;
    bool seen = true;
    canvas->list = list;
    cairo_get_matrix(canvas->cr, &canvas->base);
    cairo_save(canvas->cr);
    draw_forget_path(canvas);
    for (uint32_t i = 0; i < list->commands.count; i++) {
        const DisplayCommand *command = &list->commands.at[i];
        if (command->matrix != matrix)
            seen = set_matrix(canvas, &list->matrices.at[command->matrix]);
        // Saving and restoring also change Cairo's transform.
        bool state = command->kind >= DISPLAY_SAVE;
        matrix = state ? DISPLAY_NONE : command->matrix;
        if (seen || state)
            execute_command(canvas, command, &layers);
    }
    cairo_restore(canvas->cr);
    draw_forget_path(canvas);
    canvas->list = NULL;
}
