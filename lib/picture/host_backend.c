// host_backend.c: draws canvases with the functions of a host (PetriCanvasBackend).
#include "picture/painter.h"

#include <math.h>

// The arguments and result of drawing with the host's functions.
typedef struct HostDrawing {
    PetriPainter *painter;
    const CanvasPicture *picture;
    const DrawNode *canvas; // NULL: draw the whole picture, which needs no shaders
    int width;
    int height;
    uint32_t *pixels;
    DiagSink *diags;
    bool done;
} HostDrawing;

static void call_host(void *context) {
    HostDrawing *drawing = context;
    PetriPainter *painter = drawing->painter;
    DisplayNumbers list =
        drawing->canvas
            ? display_list_of_canvas(painter, drawing->canvas, drawing->width, drawing->height)
            : display_list_of_picture(&painter->arena, drawing->picture, drawing->width / drawing->picture->width);
    drawing->done = painter->host.draw(painter->host.user_data, list.at, list.count, drawing->width, drawing->height,
                                       drawing->pixels);
    if (!drawing->done)
        painter_report(drawing->diags, NULL, DIAG_ERROR, "cannot-draw", "the picture cannot be drawn");
}

static PetriStatus draw_with_host(HostDrawing *drawing) {
    PetriPainter *painter = drawing->painter;
    Arena *arenas[] = {&painter->arena, drawing->diags->arena};
    ArenaMark mark = arena_mark(&painter->arena);
    ArenaOutcome end = arena_protect(arenas, 2, call_host, drawing);
    arena_rewind(&painter->arena, mark);
    if (end == ARENA_MEMORY_LIMIT)
        return painter_report_limit(drawing->diags);
    return end != ARENA_OK ? PETRI_OUT_OF_MEMORY : drawing->done ? PETRI_OK : PETRI_INVALID;
}

static PetriStatus draw_canvas(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, int width,
                               int height, Texture *texture, DiagSink *diags) {
    (void)width; // hosts always draw at full detail
    (void)height;
    Texture *bytes = texture->bytes ? texture : texture_new(&painter->budget, texture->width, texture->height, false);
    if (!bytes)
        return painter->budget.memory_refused ? painter_report_limit(diags) : PETRI_OUT_OF_MEMORY;
    PetriStatus status = draw_with_host(&(HostDrawing){.painter = painter,
                                                       .picture = picture,
                                                       .canvas = node,
                                                       .width = texture->width,
                                                       .height = texture->height,
                                                       .pixels = bytes->bytes,
                                                       .diags = diags});
    if (bytes != texture) {
        texture_copy_linear(bytes, texture->linear);
        texture_free(bytes);
    }
    return status;
}

// Scales a picture to fit into the centre of the pixels.
static void scale_texture(const Texture *texture, const CanvasPicture *picture, uint32_t *pixels, int width, int height,
                          size_t stride) {
    const Sampler sampler = {.clamped = true};
    double left, top, scale = painter_fit(picture->width, picture->height, width, height, &left, &top);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            double u = (x + 0.5 - left) / (picture->width * scale), v = (y + 0.5 - top) / (picture->height * scale);
            float color[4] = {0};
            if (u >= 0 && u <= 1 && v >= 0 && v <= 1)
                texture_sample(texture, &sampler, u, v, color);
            Texture one = {.width = 1, .height = 1, .linear = color};
            texture_row(&one, 0, picture->opaque, (uint32_t *)(void *)((char *)pixels + (size_t)y * stride) + x);
        }
}

static PetriStatus draw_whole(PetriPainter *painter, const CanvasPicture *picture, const Texture *shown,
                              uint32_t *pixels, int width, int height, size_t stride, DiagSink *diags) {
    if (shown) {
        scale_texture(shown, picture, pixels, width, height, stride);
        return PETRI_OK;
    }
    if (!picture->direct && !picture->automatic)
        return PETRI_OK;
    if (stride != (size_t)width * sizeof *pixels)
        return PETRI_INVALID;
    return draw_with_host(&(HostDrawing){
        .painter = painter, .picture = picture, .width = width, .height = height, .pixels = pixels, .diags = diags});
}

static bool find_image(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, ImagePixels *image,
                       DiagSink *diags) {
    (void)picture;
    const PetriCanvasBackend *host = &painter->host;
    Str name = draw_attr(node, ATTR_FILENAME)->as.text;
    *image = (ImagePixels){.alpha = true};
    if (host->image)
        image->pixels = host->image(host->user_data, str_to_c(&painter->arena, name), &image->width, &image->height);
    if (!image->pixels || image->width < 1 || image->height < 1) {
        painter_report(diags, &node->origin, DIAG_WARNING, "cannot-read", "!image: cannot read '%s': no such picture",
                       name.bytes);
        return false;
    }
    image->stride = (size_t)image->width * sizeof *image->pixels;
    return true;
}

static const char *measure_text(PetriPainter *painter, Str text, const TextStyle *style, double *width, bool *loaded) {
    const PetriCanvasBackend *host = &painter->host;
    double unit = NAN;
    (void)loaded;
    if (host->measure) {
        ArenaMark mark = arena_mark(&painter->arena);
        const char *bytes = str_to_c(&painter->arena, text);
        unit = host->measure(host->user_data, bytes, style->family, style->weight, style->width, style->slant);
        arena_rewind(&painter->arena, mark);
    }
    if (isnan(unit))
        return "not supported: there are no fonts";
    *width = unit * style->size;
    return NULL;
}

PetriStatus petri_painter_use_backend(PetriPainter *painter, const PetriCanvasBackend *functions) {
    static const CanvasBackend host_backend = {
        .draw_canvas = draw_canvas, .draw_pixels = draw_whole, .find_image = find_image, .measure_text = measure_text};
    PetriCanvasBackend host = {0};
    if (!painter || !functions)
        return PETRI_INVALID;
    if (painter->backend->draw_canvas && painter->backend != &host_backend)
        return PETRI_UNSUPPORTED;
    if (!host_struct_read(&host, sizeof host, functions) || !host.draw || painter->rendered > 0)
        return PETRI_INVALID;
    painter->host = host;
    painter->backend = &host_backend;
    return PETRI_OK;
}
