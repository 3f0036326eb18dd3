// paint.c: see paint.h: surfaces to draw on, and the canvases of a window one over the other.
#include "draw/paint.h"

#include "draw/draw.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

PetriPainter *petri_painter_open(void) {
    PetriPainter *painter = calloc(1, sizeof *painter);
    if (!painter)
        return NULL;
    arena_init(&painter->arena, "painter", SIZE_MAX);
    if (draw_text_open(painter))
        return painter;
    petri_painter_close(&painter);
    return NULL;
}

void petri_painter_close(PetriPainter **handle) {
    if (!handle)
        return;
    PetriPainter *painter = *handle;
    *handle = NULL;
    if (!painter)
        return;
    draw_text_close(painter);
    draw_images_close(painter);
    arena_free(&painter->arena);
    free(painter);
}

void draw_fault(Canvas *canvas, DiagLevel level, const char *code, const char *format, ...) {
    Text text = text_new(canvas->faults->arena);
    va_list args;
    va_start(args, format);
    text_add_va(&text, format, args);
    va_end(args);
    diag_report(canvas->faults, &(Diag){.level = level, .text = text_str(&text), .code = code});
}

// Makes width x height units fill a box of the target, keeping their proportions.
static void fit(cairo_t *cr, double width, double height, double box_width, double box_height) {
    double scale = fmin(box_width / width, box_height / height);
    cairo_translate(cr, (box_width - width * scale) / 2, (box_height - height * scale) / 2);
    cairo_scale(cr, scale, scale);
}

static void draw_sheet(Canvas *canvas, const DrawNode *node) {
    double size[2];
    cairo_save(canvas->cr);
    if (draw_pair(node, ATTR_SIZE, size) && size[0] > 0 && size[1] > 0)
        fit(canvas->cr, size[0], size[1], canvas->picture->width, canvas->picture->height);
    draw_tree(canvas, node);
    cairo_restore(canvas->cr);
}

// The first canvas can be drawn directly where it begins with nothing; the others are each drawn apart.
static void draw_window(Canvas *canvas, const DrawNode *window) {
    bool direct = !canvas->vector || !canvas->picture->opaque;
    for (uint32_t i = 0; i < window->child_count; i++) {
        if (window->children[i]->kind != KIND_CANVAS)
            continue;
        if (direct) {
            draw_sheet(canvas, window->children[i]);
        } else {
            cairo_push_group(canvas->cr);
            draw_sheet(canvas, window->children[i]);
            cairo_pop_group_to_source(canvas->cr);
            draw_paint(canvas, draw_word(window, ATTR_COMPOSITE), 1);
        }
        direct = false;
    }
}

// Draws the whole picture. False if Cairo gave up.
static bool draw_picture(Canvas *canvas, double width, double height) {
    cairo_t *cr = canvas->cr;
    const CanvasPicture *picture = canvas->picture;
    canvas->painter->family = NULL;
    cairo_set_tolerance(cr, 0.1);
    if (canvas->vector && picture->opaque) {
        cairo_set_source_rgb(cr, 0, 0, 0);
        cairo_paint(cr);
    }
    fit(cr, picture->width, picture->height, width, height);
    cairo_rectangle(cr, 0, 0, picture->width, picture->height);
    cairo_clip(cr);
    if (picture->window)
        draw_window(canvas, picture->window);
    else
        draw_automatic(canvas, picture->automatic);
    cairo_status_t status = cairo_status(cr);
    if (status != CAIRO_STATUS_SUCCESS && !canvas->failed)
        draw_fault(canvas, DIAG_ERROR, "cannot-draw", "the picture cannot be drawn: %s",
                   cairo_status_to_string(status));
    return status == CAIRO_STATUS_SUCCESS && !canvas->failed;
}

static PetriStatus result_of(cairo_status_t status) {
    return status == CAIRO_STATUS_SUCCESS ? PETRI_OK : status == CAIRO_STATUS_NO_MEMORY ? PETRI_MEMORY : PETRI_INVALID;
}

// Draws on a surface, within the painter's escape for used-up memory.
static PetriStatus draw_on(PetriPainter *painter, const CanvasPicture *picture, cairo_surface_t *surface, bool vector,
                           double width, double height, DiagSink *faults) {
    jmp_buf escape;
    cairo_t *volatile cr = cairo_create(surface);
    PetriStatus result = result_of(cairo_status(cr));
    if (result == PETRI_OK) {
        painter->arena.escape = faults->arena->escape = &escape;
        if (setjmp(escape) == 0) {
            Canvas canvas = {
                .painter = painter, .picture = picture, .cr = cr, .faults = faults, .vector = vector, .rows = height};
            if (!draw_picture(&canvas, width, height))
                result = cairo_status(cr) == CAIRO_STATUS_NO_MEMORY ? PETRI_MEMORY : PETRI_INVALID;
        } else {
            result = PETRI_MEMORY;
        }
        painter->arena.escape = faults->arena->escape = NULL;
    }
    cairo_destroy(cr);
    arena_reset(&painter->arena);
    return result;
}

// Over black, colours that are premultiplied stay; only alpha changes.
static void make_opaque(uint32_t *pixels, int width, int height, size_t stride) {
    for (int y = 0; y < height; y++) {
        uint32_t *row = (uint32_t *)(void *)((unsigned char *)pixels + (size_t)y * stride);
        for (int x = 0; x < width; x++)
            row[x] |= 0xff000000u;
    }
}

static void clear(uint32_t *pixels, int width, int height, size_t stride) {
    for (int y = 0; y < height; y++)
        memset((unsigned char *)pixels + (size_t)y * stride, 0, (size_t)width * sizeof *pixels);
}

PetriStatus draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width, int height,
                        size_t stride, DiagSink *faults) {
    clear(pixels, width, height, stride);
    cairo_surface_t *surface =
        cairo_image_surface_create_for_data((unsigned char *)pixels, CAIRO_FORMAT_ARGB32, width, height, (int)stride);
    PetriStatus result = draw_on(painter, picture, surface, false, width, height, faults);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    if (result != PETRI_OK)
        clear(pixels, width, height, stride);
    else if (picture->opaque)
        make_opaque(pixels, width, height, stride);
    return result;
}

static cairo_status_t collect(void *closure, const unsigned char *bytes, unsigned length) {
    text_add(closure, (Str){(const char *)bytes, length});
    return CAIRO_STATUS_SUCCESS;
}

static PetriStatus encode_png(PetriPainter *painter, const CanvasPicture *picture, int width, int height, Text *out,
                              DiagSink *faults) {
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    PetriStatus result = result_of(cairo_surface_status(surface));
    if (result == PETRI_OK)
        result = draw_pixels(painter, picture, (uint32_t *)(void *)cairo_image_surface_get_data(surface), width, height,
                             (size_t)cairo_image_surface_get_stride(surface), faults);
    if (result == PETRI_OK) {
        cairo_surface_mark_dirty(surface);
        result = result_of(cairo_surface_write_to_png_stream(surface, collect, out));
    }
    cairo_surface_destroy(surface);
    return result;
}

static PetriStatus encode_vector(PetriPainter *painter, const CanvasPicture *picture, bool pdf, int width, int height,
                                 Text *out, DiagSink *faults) {
    cairo_surface_t *surface = pdf ? cairo_pdf_surface_create_for_stream(collect, out, width, height)
                                   : cairo_svg_surface_create_for_stream(collect, out, width, height);
    if (pdf) // the same bytes each time
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    else
        cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    PetriStatus result = draw_on(painter, picture, surface, true, width, height, faults);
    cairo_surface_finish(surface);
    if (result == PETRI_OK)
        result = result_of(cairo_surface_status(surface));
    cairo_surface_destroy(surface);
    return result;
}

PetriStatus draw_encode(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width, int height,
                        Arena *arena, Str *bytes, DiagSink *faults) {
    Text out = text_new(arena);
    PetriStatus result = format == CANVAS_PNG
                             ? encode_png(painter, picture, width, height, &out, faults)
                             : encode_vector(painter, picture, format == CANVAS_PDF, width, height, &out, faults);
    *bytes = text_str(&out);
    return result;
}
