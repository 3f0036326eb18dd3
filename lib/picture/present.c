// present.c: presents pictures on a window of the host, using the host's OpenGL context.
#include "base/heap.h"
#include "gl/functions.h"
#include "picture/painter.h"
#include "picture/picture.h"

#include <math.h>
#include <string.h>

// The content of a window.
typedef struct Presentation {
    PetriPainter *painter;
    PetriPicture *picture; // the picture to show; NULL: the window becomes black
    const PetriLabel *labels;
    size_t count;
    size_t label_size; // size of a label in the host's header
    double scale;
    int width;
    int height;
    const Texture *texture; // the rendered picture on the GPU; NULL: show the pixels in `painter->window`
    bool done;
} Presentation;

static uint32_t *window_pixels(PetriPainter *painter, int width, int height) {
    size_t size = (size_t)width * (size_t)height * sizeof(uint32_t);
    if (size > painter->window_capacity) {
        heap_free(painter->window);
        painter->window = heap_alloc(size);
        painter->window_capacity = painter->window ? size : 0;
    }
    return painter->window;
}

// Draws a label to separate pixels, which are then composited over the window.
static bool present_label(const Presentation *presentation, PetriLabel label) {
    PetriPainter *painter = presentation->painter;
    double scale = presentation->scale, left = floor(label.x * scale), top = floor(label.y * scale);
    double right = fmin(ceil((label.x + label.width) * scale), presentation->width);
    double bottom = fmin(ceil((label.y + label.height) * scale), presentation->height);
    left = fmax(left, 0);
    top = fmax(top, 0);
    if (!(right > left) || !(bottom > top))
        return true;
    int width = (int)(right - left), height = (int)(bottom - top);
    uint32_t *pixels = window_pixels(painter, width, height);
    if (!pixels)
        return false;
    memset(pixels, 0, (size_t)width * (size_t)height * sizeof *pixels);
    label.x -= left / scale;
    label.y -= top / scale;
    return petri_painter_draw_labels(painter, &label, 1, sizeof label, scale, pixels, width, height,
                                     (size_t)width * sizeof *pixels) == PETRI_OK &&
           gl_call.present_pixels(painter->gl, &painter->arena, pixels, (int)left, presentation->height - (int)bottom,
                                  width, height, true);
}

static void present_protected(void *context) {
    Presentation *presentation = context;
    PetriPainter *painter = presentation->painter;
    if (presentation->texture) {
        const CanvasPicture *picture = &presentation->picture->picture;
        GlBox box;
        double scale =
            painter_fit(picture->width, picture->height, presentation->width, presentation->height, &box.x, &box.y);
        box.width = picture->width * scale;
        box.height = picture->height * scale;
        presentation->done =
            gl_call.present_image(painter->gl, &painter->arena, presentation->texture->image, &box, presentation->width,
                                  presentation->height, texture_thresholds(), picture->opaque);
    } else {
        presentation->done = gl_call.present_pixels(painter->gl, &painter->arena, painter->window, 0, 0,
                                                    presentation->width, presentation->height, false);
    }
    for (size_t i = 0; i < presentation->count && presentation->done; i++)
        presentation->done =
            present_label(presentation, painter_label_at(presentation->labels, presentation->label_size, i));
}

// Renders the picture: to a texture if possible, else to the pixels in `painter->window`.
static PetriStatus prepare_picture(Presentation *presentation) {
    PetriPainter *painter = presentation->painter;
    PetriPicture *picture = presentation->picture;
    PetriStatus status = picture ? painter_render(painter, &picture->picture, &picture->diags) : PETRI_OK;
    const Texture *rendered = picture && status == PETRI_OK ? painter_rendered(painter, &picture->picture) : NULL;
    if (rendered && rendered->gl && !picture->picture.direct) {
        presentation->texture = rendered;
        return PETRI_OK;
    }
    uint32_t *pixels = window_pixels(painter, presentation->width, presentation->height);
    size_t stride = (size_t)presentation->width * sizeof *pixels;
    if (!pixels)
        return PETRI_OUT_OF_MEMORY;
    if (!picture || status != PETRI_OK) {
        memset(pixels, 0, stride * (size_t)presentation->height);
        return status;
    }
    return petri_picture_draw(picture, painter, pixels, presentation->width, presentation->height, stride);
}

PetriStatus petri_painter_present(PetriPainter *painter, PetriPicture *picture, const PetriLabel *labels, size_t count,
                                  size_t size, double scale, int width, int height) {
    const char *problem;
    if (!painter || !painter->on_window || (count > 0 && !labels) || !picture_is_good_size(width, height))
        return PETRI_INVALID;
    Presentation presentation = {.painter = painter,
                                 .picture = picture,
                                 .labels = labels,
                                 .count = count,
                                 .label_size = size,
                                 .scale = scale,
                                 .width = width,
                                 .height = height};
    PetriStatus status = prepare_picture(&presentation);
    if (!painter->window && !presentation.texture)
        return status;
    if (!gl_call.enter(painter->gl, &problem))
        return PETRI_INVALID;
    Arena *arenas[] = {&painter->arena};
    ArenaMark mark = arena_mark(&painter->arena);
    bool done = arena_protect(arenas, 1, present_protected, &presentation) == ARENA_OK && presentation.done;
    arena_rewind(&painter->arena, mark);
    gl_call.leave(painter->gl);
    return done ? status : PETRI_OUT_OF_MEMORY;
}
