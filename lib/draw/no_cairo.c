// no_cairo.c: implements cairo_canvas.h in builds without Cairo. If the host provides a backend, the backend draws
// canvases.
#include "draw/painter.h"

#include <math.h>
#include <string.h>

void draw_tools_close(PetriPainter *painter) {
    (void)painter;
}

PetriStatus petri_painter_use_backend(PetriPainter *painter, const PetriCanvasBackend *functions) {
    PetriCanvasBackend backend = {0};
    if (!painter || !host_struct_read(&backend, sizeof backend, functions) || !backend.draw || painter->made > 0)
        return PETRI_INVALID;
    painter->backend = backend;
    return PETRI_OK;
}

static void report_missing(void *faults) {
    diag_report(
        faults,
        &(Diag){.level = DIAG_ERROR,
                .code = "cannot-draw",
                .text = STR(
                    "this build of petri cannot draw: it lacks Cairo, Pango, libjpeg or libpng; install them and build "
                    "it again (Debian: libcairo2-dev libpango1.0-dev libjpeg-dev libpng-dev)")});
}

static PetriStatus report_no_cairo(DiagSink *faults) {
    Arena *arenas[] = {faults->arena};
    return arena_protect(arenas, 1, report_missing, faults) == ARENA_OK ? PETRI_UNSUPPORTED : PETRI_OUT_OF_MEMORY;
}

PetriStatus draw_encode(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width, int height,
                        Encoded *out, DiagSink *faults) {
    (void)painter, (void)picture, (void)format, (void)width, (void)height, (void)out;
    return report_no_cairo(faults);
}

PetriStatus draw_encode_record(PetriPainter *painter, const CanvasPicture *picture, const Recorded *record,
                               CanvasFormat format, Encoded *out, DiagSink *faults) {
    (void)painter, (void)picture, (void)record, (void)format, (void)out;
    return report_no_cairo(faults);
}

PetriStatus petri_painter_draw_labels(PetriPainter *painter, const PetriLabel *labels, size_t count, size_t size,
                                      double scale, uint32_t *pixels, int width, int height, size_t stride) {
    (void)painter, (void)labels, (void)count, (void)size, (void)scale, (void)pixels, (void)width, (void)height,
        (void)stride;
    return PETRI_UNSUPPORTED;
}

// The arguments and result of drawing with the host's backend.
typedef struct BackendDrawing {
    PetriPainter *painter;
    const CanvasPicture *picture;
    const DrawNode *canvas; // NULL: draw the whole picture, which needs no shaders
    int width;
    int height;
    uint32_t *pixels;
    DiagSink *faults;
    bool done;
} BackendDrawing;

static void call_backend(void *context) {
    BackendDrawing *hosted = context;
    Arena *arena = &hosted->painter->arena;
    const PetriCanvasBackend *backend = &hosted->painter->backend;
    size_t count;
    const double *numbers =
        hosted->canvas
            ? draw_canvas_display_list(hosted->painter, hosted->canvas, hosted->width, hosted->height, &count)
            : draw_picture_display_list(arena, hosted->picture, hosted->width / hosted->picture->width, &count);
    hosted->done = backend->draw(backend->user_data, numbers, count, hosted->width, hosted->height, hosted->pixels);
    if (!hosted->done)
        draw_report(hosted->faults, NULL, DIAG_ERROR, "cannot-draw", "the picture cannot be drawn");
}

static PetriStatus draw_with_backend(BackendDrawing *hosted) {
    PetriPainter *painter = hosted->painter;
    if (!painter->backend.draw)
        return report_no_cairo(hosted->faults);
    Arena *arenas[] = {&painter->arena, hosted->faults->arena};
    ArenaMark mark = arena_mark(&painter->arena);
    ArenaOutcome end = arena_protect(arenas, 2, call_backend, hosted);
    arena_rewind(&painter->arena, mark);
    if (end == ARENA_MEMORY_LIMIT)
        return draw_report_limit(hosted->faults);
    return end != ARENA_OK ? PETRI_OUT_OF_MEMORY : hosted->done ? PETRI_OK : PETRI_INVALID;
}

PetriStatus draw_canvas(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, int width,
                        int height, Texture *texture, DiagSink *faults) {
    (void)width; // backends always draw at full detail
    (void)height;
    Texture *bytes = texture->bytes ? texture : texture_new(&painter->budget, texture->width, texture->height, false);
    if (!bytes)
        return painter->budget.memory_refused ? draw_report_limit(faults) : PETRI_OUT_OF_MEMORY;
    PetriStatus status = draw_with_backend(&(BackendDrawing){.painter = painter,
                                                             .picture = picture,
                                                             .canvas = node,
                                                             .width = texture->width,
                                                             .height = texture->height,
                                                             .pixels = bytes->bytes,
                                                             .faults = faults});
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
    double left, top, scale = draw_fit(picture->width, picture->height, width, height, &left, &top);
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

PetriStatus draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width, int height,
                        size_t stride, DiagSink *faults) {
    draw_clear(pixels, width, height, stride);
    if (!painter->backend.draw)
        return report_no_cairo(faults);
    PetriStatus status = draw_render_pixels(painter, picture, faults);
    const Texture *shown = status == PETRI_OK ? draw_rendered(painter, picture) : NULL;
    if (shown && shown->width == width && shown->height == height) {
        draw_texture(shown, picture->opaque, pixels, stride);
    } else if (shown) {
        scale_texture(shown, picture, pixels, width, height, stride);
    } else if (status == PETRI_OK && (picture->direct || picture->automatic)) {
        if (stride != (size_t)width * sizeof *pixels)
            return PETRI_INVALID;
        status = draw_with_backend(&(BackendDrawing){.painter = painter,
                                                     .picture = picture,
                                                     .width = width,
                                                     .height = height,
                                                     .pixels = pixels,
                                                     .faults = faults});
    }
    return status;
}

Texture *draw_picture_image(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node,
                            DiagSink *faults) {
    (void)picture;
    const AttrValue *name = draw_attr(node, ATTR_FILENAME);
    const PetriCanvasBackend *backend = &painter->backend;
    int width = 0, height = 0;
    if (!name || name->as.text.len == 0)
        return NULL;
    const uint32_t *pixels =
        backend->image ? backend->image(backend->user_data, str_to_c(&painter->arena, name->as.text), &width, &height)
                       : NULL;
    if (!pixels || width < 1 || height < 1) {
        draw_report(faults, &node->origin, DIAG_WARNING, "cannot-read", "!image: cannot read '%s': no such picture",
                    name->as.text.bytes);
        return NULL;
    }
    return draw_sized_image(painter, node, pixels, width, height, (size_t)width * sizeof *pixels, true, faults);
}

const char *draw_measure_text(void *user_data, const BuiltinText *text, double *width, bool *loaded) {
    PetriPainter *painter = user_data;
    const PetriCanvasBackend *backend = &painter->backend;
    TextStyle style;
    const char *problem = draw_read_style(text, &style);
    (void)loaded;
    if (problem)
        return problem;
    double unit = NAN;
    if (backend->measure) {
        ArenaMark mark = arena_mark(&painter->arena);
        const char *bytes = str_to_c(&painter->arena, text->text);
        unit = backend->measure(backend->user_data, bytes, style.family, style.weight, style.width, style.slant);
        arena_rewind(&painter->arena, mark);
    }
    if (isnan(unit))
        return "not supported: there are no fonts";
    *width = unit * style.size;
    return NULL;
}
