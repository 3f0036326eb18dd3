// image.c: draws images.
#include "cairo/canvas.h"
#include "cairo/hdr_composite.h"

#include <math.h>

// The placement of an image.
typedef struct Box {
    double x;
    double y;
    double scale_x;
    double scale_y;
    bool cut; // true if the image is clipped to width x height units at its `point`
    double width;
    double height;
} Box;

// Computes the placement of an image of width x height pixels. Returns false if nothing would be visible.
static bool find_box(const IMAGEOperands *image, double width, double height, Box *box) {
    const double *size = image->size;
    *box = (Box){.x = image->point[0], .y = image->point[1], .scale_x = 1, .scale_y = 1};
    if (image->fit == FIT_FILL || image->fit == FIT_INSIDE) {
        double wide = size[0] / width, high = size[1] / height;
        double scale = image->fit == FIT_FILL ? fmax(wide, high) : fmin(wide, high);
        box->scale_x = box->scale_y = scale;
        box->x += (size[0] - width * scale) / 2;
        box->y += (size[1] - height * scale) / 2;
        box->cut = image->fit == FIT_FILL;
        box->width = size[0];
        box->height = size[1];
    } else if (image->fit == FIT_SIZE) {
        box->scale_x = size[0] / width;
        box->scale_y = size[1] / height;
    }
    return box->scale_x != 0 && box->scale_y != 0 && isfinite(box->scale_x) && isfinite(box->scale_y);
}

// Paints `surface`. On an HDR canvas, `surface` is NULL, and `shade` is painted instead.
static void paint_image(Canvas *canvas, cairo_surface_t *surface, HdrPaint *shade, double width, double height,
                        const Box *box, const double point[2], const DisplayPaint *paint) {
    cairo_t *cr = canvas->cr;
    draw_forget_path(canvas);
    cairo_save(cr);
    draw_set_edges(canvas, paint->style.antialias != 0, FILL_WINDING);
    if (box->cut) {
        double x1 = point[0], y1 = point[1], x2 = x1 + box->width, y2 = y1 + box->height;
        draw_clamp_point(canvas, &x1, &y1);
        draw_clamp_point(canvas, &x2, &y2);
        cairo_rectangle(cr, x1, y1, x2 - x1, y2 - y1);
        cairo_clip(cr);
    }
    cairo_matrix_t matrix, placed;
    cairo_get_matrix(cr, &matrix);
    cairo_matrix_init(&placed, box->scale_x, 0, 0, box->scale_y, box->x, box->y);
    cairo_matrix_multiply(&placed, &placed, &matrix);
    if (draw_is_invertible(&placed)) {
        double alpha = display_paint_alpha(paint);
        cairo_set_matrix(cr, &placed);
        cairo_rectangle(cr, 0, 0, width, height);
        cairo_clip(cr);
        if (surface) {
            cairo_set_source_surface(cr, surface, 0, 0);
            cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
            cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD); // avoids transparent edges
            cairo_set_operator(cr, draw_operator((int)paint->style.mode));
            cairo_paint_with_alpha(cr, alpha);
        } else {
            shade->to_units = placed;
            shade->alpha = (float)alpha;
            cairo_matrix_invert(&shade->to_units);
            hdr_draw_image(canvas, paint, shade);
        }
    }
    cairo_restore(cr);
    draw_forget_path(canvas);
}

void draw_image(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint) {
    const IMAGEOperands *placed = &row->IMAGE; // PETRI_DRAW_PIXELS begins with the same operands
    DrawImage image = draw_image_at(canvas, placed->at, row->kind == PETRI_DRAW_IMAGE ? &placed->file : NULL);
    HdrPaint shade = {.file = NULL};
    cairo_surface_t *surface = NULL;
    Box box;
    if (canvas->hdr_target.pixels)
        draw_find_pixels(canvas, &image, &shade.texture, &shade.file);
    else
        surface = draw_find_image(canvas, &image);
    cairo_surface_t *pixels = surface ? surface : shade.file;
    if (!pixels && !shade.texture)
        return;
    int width = pixels ? cairo_image_surface_get_width(pixels) : shade.texture->width;
    int height = pixels ? cairo_image_surface_get_height(pixels) : shade.texture->height;
    if (find_box(placed, width, height, &box) &&
        (!surface || draw_charge_box(canvas, paint, width * box.scale_x, height * box.scale_y, 1)))
        paint_image(canvas, surface, &shade, width, height, &box, placed->point, paint);
    cairo_surface_destroy(surface);
}
