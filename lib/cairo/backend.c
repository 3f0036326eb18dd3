// backend.c: the backend that draws with Cairo (backend.h): creates surfaces, and draws pictures on them.
#include "cairo/canvas.h"
#include "cairo/encode.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <string.h>

// Sets a transform that fits width x height units into a box of the target.
static void fit_to_box(cairo_t *cr, double width, double height, double box_width, double box_height) {
    double left, top, scale = painter_fit(width, height, box_width, box_height, &left, &top);
    cairo_translate(cr, left, top);
    cairo_scale(cr, scale, scale);
}

// The content of a surface.
typedef struct Page {
    const CanvasPicture *picture;
    const DrawNode *canvas;  // the canvas to draw; NULL: none
    cairo_surface_t *pixels; // an image that is drawn instead of a canvas; NULL: none
    FloatImage hdr_target; // on an HDR canvas: drawn on instead of the surface; on other canvases, its `pixels` is NULL
    double width;          // size of the content in units; it is scaled to fit the surface
    double height;
    bool black; // true for a black background
} Page;

static void draw_image_of(cairo_t *cr, cairo_surface_t *pixels, double width, double height) {
    cairo_scale(cr, width / cairo_image_surface_get_width(pixels), height / cairo_image_surface_get_height(pixels));
    cairo_set_source_surface(cr, pixels, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_BILINEAR);
    cairo_pattern_set_extend(cairo_get_source(cr),
                             CAIRO_EXTEND_PAD); // avoids transparent edges; the clip hides the padding
    cairo_paint(cr);
}

static void draw_canvas_node(Canvas *canvas, const Page *page) {
    DisplayList list = {.arena = &canvas->painter->arena};
    display_list_begin(&list, page->width, page->height);
    display_list_build(&list, page->canvas, NULL, &canvas->painter->sizes);
    draw_display_list(canvas, &list);
}

// Draws the whole page. Returns false if Cairo failed.
static bool draw_page(Canvas *canvas, const Page *page, double width, double height) {
    cairo_t *cr = canvas->cr;
    if (canvas->painter->text_context)
        canvas->painter->text_context->font.family = NULL;
    cairo_set_tolerance(cr, 0.1);
    if (page->black) {
        cairo_set_source_rgb(cr, 0, 0, 0);
        cairo_paint(cr);
    }
    fit_to_box(cr, page->width, page->height, width, height);
    cairo_rectangle(cr, 0, 0, page->width, page->height);
    cairo_clip(cr);
    if (page->pixels)
        draw_image_of(cr, page->pixels, page->width, page->height);
    else if (page->canvas)
        draw_canvas_node(canvas, page);
    else if (page->picture->automatic)
        draw_automatic(canvas, page->picture->automatic);
    cairo_status_t status = cairo_status(cr);
    if (status != CAIRO_STATUS_SUCCESS && !canvas->failed)
        draw_report(canvas, NULL, DIAG_ERROR, "cannot-draw", "the picture cannot be drawn: %s",
                    cairo_status_to_string(status));
    return status == CAIRO_STATUS_SUCCESS && !canvas->failed;
}

static PetriStatus result_of(cairo_status_t status) {
    return status == CAIRO_STATUS_SUCCESS     ? PETRI_OK
           : status == CAIRO_STATUS_NO_MEMORY ? PETRI_OUT_OF_MEMORY
                                              : PETRI_INVALID;
}

typedef struct Drawing {
    Canvas canvas;
    const Page *page;
    double width;
    double height;
    bool done;
} Drawing;

static void draw_protected(void *context) {
    Drawing *drawing = context;
    drawing->done = draw_page(&drawing->canvas, drawing->page, drawing->width, drawing->height);
}

// Draws a page on a surface of width x height.
static PetriStatus draw_on(PetriPainter *painter, const Page *page, cairo_surface_t *surface, bool vector, double width,
                           double height, DiagSink *diags) {
    cairo_t *cr = cairo_create(surface);
    PetriStatus result = result_of(cairo_status(cr));
    if (result == PETRI_OK) {
        Drawing drawing = {.canvas = {.painter = painter,
                                      .pool.budget = &painter->budget,
                                      .picture = page->picture,
                                      .cr = cr,
                                      .diags = diags,
                                      .vector = vector,
                                      .columns = width,
                                      .rows = height,
                                      .hdr_target = page->hdr_target},
                           .page = page,
                           .width = width,
                           .height = height};
        Arena *arenas[] = {&painter->arena, diags->arena};
        ArenaMark mark = arena_mark(&painter->arena);
        ArenaOutcome end = arena_protect(arenas, 2, draw_protected, &drawing);
        if (end == ARENA_MEMORY_LIMIT)
            result = painter_report_limit(diags);
        else if (end != ARENA_OK)
            result = PETRI_OUT_OF_MEMORY;
        else if (!drawing.done)
            result = cairo_status(cr) == CAIRO_STATUS_NO_MEMORY ? PETRI_OUT_OF_MEMORY : PETRI_INVALID;
        draw_close(&drawing.canvas);
        arena_rewind(&painter->arena, mark);
    }
    cairo_destroy(cr);
    return result;
}

static cairo_surface_t *surface_of(uint32_t *pixels, int width, int height, size_t stride) {
    return cairo_image_surface_create_for_data((unsigned char *)pixels, CAIRO_FORMAT_ARGB32, width, height,
                                               (int)stride);
}

static PetriStatus draw_canvas(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, int width,
                               int height, Texture *texture, DiagSink *diags) {
    Page page = {.picture = picture,
                 .canvas = node,
                 .hdr_target = {.width = texture->width, .height = texture->height, .pixels = texture->linear},
                 .width = width,
                 .height = height};
    // Without `bytes`, the surface only tracks the clip, because the drawing goes to `hdr_target`.
    cairo_surface_t *surface =
        texture->bytes
            ? surface_of(texture->bytes, texture->width, texture->height, (size_t)texture->width * sizeof(uint32_t))
            : cairo_image_surface_create(CAIRO_FORMAT_A8, texture->width, texture->height);
    PetriStatus result = draw_on(painter, &page, surface, false, texture->width, texture->height, diags);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    return result;
}

// Composites pixels over black: premultiplied colours do not change, and alpha becomes 1.
static void make_opaque(uint32_t *pixels, int width, int height, size_t stride) {
    for (int y = 0; y < height; y++) {
        uint32_t *row = (uint32_t *)(void *)((unsigned char *)pixels + (size_t)y * stride);
        for (int x = 0; x < width; x++)
            row[x] |= 0xff000000u;
    }
}

// Returns a surface with the size and pixels of a texture. The caller destroys the surface.
static cairo_surface_t *surface_of_texture(const Texture *texture, bool opaque) {
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, texture->width, texture->height);
    if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS) {
        painter_copy_texture(texture, opaque, (uint32_t *)(void *)cairo_image_surface_get_data(surface),
                             (size_t)cairo_image_surface_get_stride(surface));
        cairo_surface_mark_dirty(surface);
    }
    return surface;
}

// Returns a page that shows the picture on a surface of any size. The caller destroys the `pixels` of the page.
static Page page_of(const CanvasPicture *picture, const Texture *shown, bool vector) {
    return (Page){.picture = picture,
                  .canvas = picture->direct,
                  .pixels = shown && !picture->direct ? surface_of_texture(shown, picture->opaque) : NULL,
                  .width = picture->width,
                  .height = picture->height,
                  .black = vector && picture->opaque};
}

static PetriStatus draw_whole(PetriPainter *painter, const CanvasPicture *picture, const Texture *shown,
                              uint32_t *pixels, int width, int height, size_t stride, DiagSink *diags) {
    cairo_surface_t *surface = surface_of(pixels, width, height, stride);
    Page page = page_of(picture, shown, false);
    painter_limit(painter, picture);
    PetriStatus result = draw_on(painter, &page, surface, false, width, height, diags);
    painter_report_needed(painter, picture, diags);
    cairo_surface_destroy(page.pixels);
    cairo_surface_finish(surface);
    cairo_surface_destroy(surface);
    if (result != PETRI_OK)
        painter_clear(pixels, width, height, stride);
    else if (picture->opaque)
        make_opaque(pixels, width, height, stride);
    return result;
}

static cairo_status_t append_bytes(void *closure, const unsigned char *bytes, unsigned length) {
    return encode_add(closure, bytes, length) ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_NO_MEMORY;
}

static PetriStatus encode_png(PetriPainter *painter, const CanvasPicture *picture, int width, int height, Encoded *out,
                              DiagSink *diags) {
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    PetriStatus result = result_of(cairo_surface_status(surface));
    if (result == PETRI_OK)
        result = painter_draw_pixels(painter, picture, (uint32_t *)(void *)cairo_image_surface_get_data(surface), width,
                                     height, (size_t)cairo_image_surface_get_stride(surface), diags);
    const uint32_t *pixels = (const uint32_t *)(const void *)cairo_image_surface_get_data(surface);
    if (result == PETRI_OK && picture->opaque) { // rows of 32-bit pixels are contiguous
        result = encode_png_pixels(out, pixels, width, height, false) ? PETRI_OK : PETRI_OUT_OF_MEMORY;
    } else if (result == PETRI_OK) {
        cairo_surface_mark_dirty(surface);
        result = result_of(cairo_surface_write_to_png_stream(surface, append_bytes, out));
    }
    cairo_surface_destroy(surface);
    return result;
}

static PetriStatus encode_vector(PetriPainter *painter, const Page *page, bool pdf, int width, int height, Encoded *out,
                                 DiagSink *diags) {
    cairo_surface_t *surface = pdf ? cairo_pdf_surface_create_for_stream(append_bytes, out, width, height)
                                   : cairo_svg_surface_create_for_stream(append_bytes, out, width, height);
    if (pdf) // a fixed date makes the bytes reproducible
        cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    else
        cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    painter_limit(painter, page->picture);
    PetriStatus result = draw_on(painter, page, surface, true, width, height, diags);
    painter_report_needed(painter, page->picture, diags);
    cairo_surface_finish(surface);
    if (result == PETRI_OK)
        result = result_of(cairo_surface_status(surface));
    cairo_surface_destroy(surface);
    return result;
}

static PetriStatus encode(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width,
                          int height, Encoded *out, DiagSink *diags) {
    if (format == CANVAS_PNG)
        return encode_png(painter, picture, width, height, out, diags);
    Page page = page_of(picture, painter_rendered(painter, picture), true);
    PetriStatus result = encode_vector(painter, &page, format == CANVAS_PDF, width, height, out, diags);
    cairo_surface_destroy(page.pixels);
    return result;
}

static PetriStatus encode_record(PetriPainter *painter, const CanvasPicture *picture, const Recorded *record,
                                 CanvasFormat format, Encoded *out, DiagSink *diags) {
    const DrawNode *node = record->node;
    const Texture *texture = record->texture;
    bool alpha = draw_flag(node, ATTR_KEEP_ALPHA), good = true;
    PetriStatus result = PETRI_OK;
    if (format == CANVAS_PNG) {
        good = encode_png_pixels(out, texture->bytes, texture->width, texture->height, alpha);
    } else if (format == CANVAS_JPEG) {
        good = encode_jpeg_pixels(out, texture->bytes, texture->width, texture->height,
                                  (int)draw_number(node, ATTR_QUALITY));
    } else {
        Page page = {.picture = picture,
                     .canvas = record->direct,
                     .pixels = record->direct ? NULL : surface_of_texture(texture, !alpha),
                     .width = texture->width,
                     .height = texture->height,
                     .black = !alpha};
        result = encode_vector(painter, &page, format == CANVAS_PDF, texture->width, texture->height, out, diags);
        cairo_surface_destroy(page.pixels);
    }
    return good ? result : PETRI_OUT_OF_MEMORY;
}

static void close_caches(PetriPainter *painter) {
    draw_text_close(painter);
    draw_images_close(painter);
}

PetriPainter *petri_painter_open(void) {
    static const CanvasBackend backend = {.draw_canvas = draw_canvas,
                                          .draw_pixels = draw_whole,
                                          .find_image = draw_find_file,
                                          .measure_text = draw_measure_text,
                                          .draw_labels = draw_labels,
                                          .encode = encode,
                                          .encode_record = encode_record,
                                          .close = close_caches};
    return painter_open(&backend);
}
