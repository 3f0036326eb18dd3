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
static void begin_layer(Canvas *canvas, Layers *layers, Origin origin) {
    const Origin *place = &origin;
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

static void apply_clip(Canvas *canvas, const CLIPOperands *clip, const DisplayPaint *paint) {
    int fill_type = clip->even_odd != 0 ? FILL_EVEN_ODD : FILL_WINDING;
    bool inverse = clip->outside != 0;
    draw_set_path(canvas, clip->path);
    if (!draw_is_drawable(canvas) || !draw_charge_path(canvas, paint, false, false))
        return;
    if (inverse) {
        add_outer_rectangle(canvas);
        fill_type = FILL_EVEN_ODD;
    }
    draw_set_edges(canvas, paint->style.antialias != 0, fill_type);
    cairo_clip_preserve(canvas->cr);
    if (inverse)
        draw_forget_path(canvas);
}

// Sets the current transform. Returns false if it is not invertible, because nothing would be visible.
static bool set_matrix(Canvas *canvas, const DisplayMatrix *m) {
    cairo_matrix_t matrix = {m->xx, m->yx, m->xy, m->yy, m->x0, m->y0};
    canvas->matrix = *m;
    cairo_matrix_multiply(&matrix, &matrix, &canvas->base);
    if (!draw_is_invertible(&matrix))
        return false;
    cairo_set_matrix(canvas->cr, &matrix);
    return true;
}

// Executes a command. `visible` is false if nothing can be seen under the current matrix.
static void execute_command(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint, bool visible,
                            Layers *layers) {
    switch (row->kind) {
    case PETRI_DRAW_PATH:
    case PETRI_DRAW_TEXT:
    case PETRI_DRAW_IMAGE:
    case PETRI_DRAW_PIXELS:
        if (visible)
            draw_command(canvas, row, paint);
        break;
    case PETRI_DRAW_CLIP:
        if (visible)
            apply_clip(canvas, &row->CLIP, paint);
        break;
    case PETRI_DRAW_SAVE:
        cairo_save(canvas->cr);
        break;
    case PETRI_DRAW_RESTORE:
        cairo_restore(canvas->cr);
        break;
    case PETRI_DRAW_LAYER:
        begin_layer(canvas, layers, display_list_note(canvas->list, row->LAYER.at).place);
        break;
    case PETRI_DRAW_LAYER_END:
        end_layer(canvas, layers, row->LAYER_END.opacity);
        break;
    default: // PETRI_DRAW_UNSUPPORTED and PETRI_DRAW_BACKGROUND are only in lists for hosts
        break;
    }
}

void draw_display_list(Canvas *canvas, const DisplayList *list) {
    Layers layers = {.depth = 0};
    DisplayPaint paint = {0};
    DisplayRow row;
    bool visible = true;
    canvas->list = list;
    cairo_get_matrix(canvas->cr, &canvas->base);
    cairo_save(canvas->cr);
    draw_forget_path(canvas);
    for (const double *at = list->numbers.at + DISPLAY_HEADER; at < list->numbers.at + list->numbers.count;) {
        at = display_list_read(at, &row);
        if (row.kind == PETRI_DRAW_MATRIX)
            visible = set_matrix(canvas, row.MATRIX.matrix);
        else if (!display_list_set_paint(&row, &paint))
            execute_command(canvas, &row, &paint, visible, &layers);
    }
    cairo_restore(canvas->cr);
    draw_forget_path(canvas);
    canvas->list = NULL;
}
