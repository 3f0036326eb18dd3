// painter.c: opens painters, renders pictures, and draws them to pixels; see painter.h.
//
// A picture is rendered once: `rendered` is the serial number of the picture whose textures the render graph has. A
// picture that does not use the graph clears it, because the next one then has nothing to continue.
#include "picture/painter.h"

#include "base/heap.h"
#include "gl/functions.h"
#include "picture/picture.h"

#include <math.h>
#include <string.h>

PetriPainter *painter_open(const CanvasBackend *backend) {
    static const CanvasBackend none;
    PetriPainter *painter = heap_calloc(1, sizeof *painter);
    if (!painter)
        return NULL;
    arena_init(&painter->arena, "painter", SIZE_MAX);
    painter->budget.memory_limit = SIZE_MAX;
    budget_begin(&painter->budget, UINT64_MAX, NULL);
    painter->arena.budget = &painter->budget;
    painter->backend = backend ? backend : &none;
    painter->render_graph = render_graph_new();
    if (painter->render_graph)
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
    if (painter->backend->close)
        painter->backend->close(painter);
    render_graph_free(painter);
    if (painter->gl)
        gl_call.close(painter->gl);
    heap_free(painter->window);
    arena_free(&painter->arena);
    heap_free(painter);
}

double painter_fit(double width, double height, double box_width, double box_height, double *left, double *top) {
    double scale = fmin(box_width / width, box_height / height);
    *left = (box_width - width * scale) / 2;
    *top = (box_height - height * scale) / 2;
    return scale;
}

void painter_clear(uint32_t *pixels, int width, int height, size_t stride) {
    for (int y = 0; y < height; y++)
        memset((unsigned char *)pixels + (size_t)y * stride, 0, (size_t)width * sizeof *pixels);
}

// Renders the render graph unless it was already rendered for this picture.
static PetriStatus make_pictures(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags) {
    if (painter->rendered == picture->serial) {
        // petri_picture_select may have changed it
        painter->shown = render_graph_window(painter->render_graph, picture);
        return PETRI_OK;
    }
    painter->shown = NULL;
    PetriStatus result = render_graph_run(painter, picture, diags, &painter->shown);
    painter->rendered = result == PETRI_OK ? picture->serial : 0;
    painter->rendered_frame = picture->frame;
    painter->total_work += painter->budget.work + (painter->gl ? gl_call.shader_work(painter->gl) : 0);
    return result;
}

PetriStatus painter_render(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags) {
    if (picture->window && (picture->needs_history || !picture->direct))
        return make_pictures(painter, picture, diags);
    if (painter->rendered > 0 && painter->rendered != picture->serial) {
        render_graph_clear(painter);
        painter->rendered = 0;
        painter->shown = NULL;
    }
    return PETRI_OK;
}

const Texture *painter_rendered(const PetriPainter *painter, const CanvasPicture *picture) {
    return picture->window && painter->rendered == picture->serial ? painter->shown : NULL;
}

typedef struct Fetching {
    PetriPainter *painter;
    const CanvasPicture *picture;
    DiagSink *diags;
} Fetching;

// Downloads the window's picture from the GPU. If the memory limit does not allow this, reports it and removes the
// picture.
static void download_shown(void *context) {
    Fetching *fetching = context;
    PetriPainter *painter = fetching->painter;
    Texture *shown = painter->shown;
    const char *problem;
    bool good = gl_call.enter(painter->gl, &problem);
    if (good) {
        good = texture_download(painter->gl, shown);
        gl_call.leave(painter->gl);
    }
    if (good)
        return;
    painter->shown = NULL;
    if (!painter_report_refused(painter, DIAG_ERROR, &fetching->picture->window->origin, "!window", shown->width,
                                shown->height, fetching->diags))
        arena_exhausted(fetching->diags->arena);
}

PetriStatus painter_render_pixels(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags) {
    PetriStatus result = painter_render(painter, picture, diags);
    const Texture *rendered = result == PETRI_OK ? painter_rendered(painter, picture) : NULL;
    Fetching fetching = {painter, picture, diags};
    if (rendered && !rendered->bytes && !rendered->linear &&
        arena_protect(&diags->arena, 1, download_shown, &fetching) != ARENA_OK)
        result = PETRI_OUT_OF_MEMORY;
    return result;
}

void painter_copy_texture(const Texture *texture, bool opaque, uint32_t *pixels, size_t stride) {
    for (int y = 0; y < texture->height; y++) {
        uint32_t *row = (uint32_t *)(void *)((unsigned char *)pixels + (size_t)y * stride);
        texture_row(texture, y, opaque, row);
    }
}

const Recorded *painter_records(const PetriPainter *painter, const CanvasPicture *picture, uint32_t *count) {
    *count = 0;
    return painter->rendered == picture->serial ? render_graph_records(painter->render_graph, count) : NULL;
}

PetriStatus painter_draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width,
                                int height, size_t stride, DiagSink *diags) {
    painter_clear(pixels, width, height, stride);
    if (!painter->backend->draw_pixels)
        return painter_report_no_backend(diags);
    PetriStatus status = painter_render_pixels(painter, picture, diags);
    if (status != PETRI_OK)
        return status;
    const Texture *shown = painter_rendered(painter, picture);
    if (!shown || shown->width != width || shown->height != height)
        return painter->backend->draw_pixels(painter, picture, shown, pixels, width, height, stride, diags);
    painter_copy_texture(shown, picture->opaque, pixels, stride);
    return PETRI_OK;
}

PetriStatus petri_picture_draw(PetriPicture *picture, PetriPainter *painter, uint32_t *pixels, int width, int height,
                               size_t stride) {
    if (!picture || !painter || !pixels || !picture_is_good_size(width, height) || stride % sizeof *pixels ||
        stride < (size_t)width * sizeof *pixels)
        return PETRI_INVALID;
    return painter_draw_pixels(painter, &picture->picture, pixels, width, height, stride, &picture->diags);
}

PetriStatus petri_picture_render(PetriPicture *picture, PetriPainter *painter) {
    if (!picture || !painter)
        return PETRI_INVALID;
    uint64_t before = painter->total_work;
    PetriStatus status = painter_render(painter, &picture->picture, &picture->diags);
    picture->work += painter->total_work - before;
    return status;
}

PetriStatus petri_painter_draw_labels(PetriPainter *painter, const PetriLabel *labels, size_t count, size_t size,
                                      double scale, uint32_t *pixels, int width, int height, size_t stride) {
    if (!painter || !pixels || (!labels && count > 0))
        return PETRI_INVALID;
    return painter->backend->draw_labels
               ? painter->backend->draw_labels(painter, labels, count, size, scale, pixels, width, height, stride)
               : PETRI_UNSUPPORTED;
}
