// labels.c: text panels over a picture.
#include "cairo/canvas.h"

#include <string.h>

enum { STRIPE = 4, CORNER = 6 };

static void set_colour(cairo_t *cr, const double colour[4]) {
    cairo_set_source_rgba(cr, colour[0], colour[1], colour[2], colour[3]);
}

static void draw_panel(cairo_t *cr, const PetriLabel *label) {
    static const double turn = 6.283185307179586;
    double left = label->x + CORNER, right = label->x + label->width - CORNER;
    double top = label->y + CORNER, bottom = label->y + label->height - CORNER;
    cairo_new_path(cr);
    cairo_arc(cr, left, top, CORNER, turn * 0.5, turn * 0.75);
    cairo_arc(cr, right, top, CORNER, turn * 0.75, turn);
    cairo_arc(cr, right, bottom, CORNER, 0, turn * 0.25);
    cairo_arc(cr, left, bottom, CORNER, turn * 0.25, turn * 0.5);
    set_colour(cr, label->background);
    cairo_fill(cr);
    cairo_rectangle(cr, label->x, label->y, STRIPE, label->height);
    set_colour(cr, label->accent);
    cairo_fill(cr);
}

static void draw_lines(cairo_t *cr, PangoLayout *layout, const PetriLabel *label) {
    double base = label->y + label->padding + label->size * 0.8;
    set_colour(cr, label->foreground);
    for (const char *line = label->text; *line; base += label->line_height) {
        size_t length = strcspn(line, "\n");
        pango_layout_set_text(layout, line, (int)length);
        cairo_move_to(cr, label->x + label->padding, base - pango_layout_get_baseline(layout) / (double)PANGO_SCALE);
        pango_cairo_show_layout(cr, layout);
        line += length + (line[length] == '\n');
    }
}

PetriStatus draw_labels(PetriPainter *painter, const PetriLabel *labels, size_t count, size_t size, double scale,
                        uint32_t *pixels, int width, int height, size_t stride) {
    TextContext *text_context = draw_text_context(painter);
    if (!text_context)
        return PETRI_OUT_OF_MEMORY;
    cairo_surface_t *target =
        cairo_image_surface_create_for_data((unsigned char *)pixels, CAIRO_FORMAT_ARGB32, width, height, (int)stride);
    cairo_t *cr = cairo_create(target);
    PangoFontDescription *font = pango_font_description_from_string("monospace");
    cairo_scale(cr, scale, scale);
    pango_cairo_update_layout(cr, text_context->layout);
    pango_layout_set_attributes(text_context->layout, NULL);
    text_context->font.family = NULL;
    for (size_t i = 0; i < count; i++) {
        PetriLabel label = painter_label_at(labels, size, i);
        pango_font_description_set_absolute_size(font, label.size * PANGO_SCALE);
        pango_layout_set_font_description(text_context->layout, font);
        draw_panel(cr, &label);
        draw_lines(cr, text_context->layout, &label);
    }
    PetriStatus status = cairo_status(cr) == CAIRO_STATUS_SUCCESS ? PETRI_OK : PETRI_OUT_OF_MEMORY;
    pango_font_description_free(font);
    cairo_destroy(cr);
    cairo_surface_destroy(target);
    return status;
}
