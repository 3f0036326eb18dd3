// window.c: pictures on a host's window, by its own OpenGL.
#include "draw/painter.h"

#include "base/heap.h"
#include "draw/picture.h"

#include <math.h>
#include <string.h>

PetriStatus petri_painter_use_gl(PetriPainter *painter) {
    const char *problem;
    if (!painter || painter->gl || painter->made > 0)
        return PETRI_INVALID;
    painter->gl = gl_adopt(&problem);
    painter->on_window = painter->gl != NULL;
    if (painter->gl)
        gl_charge(painter->gl, &painter->meter);
    return painter->gl ? PETRI_OK : problem ? PETRI_MISSING : PETRI_MEMORY;
}

uint64_t petri_painter_read_backs(const PetriPainter *painter) {
    return painter && painter->gl ? gl_reads(painter->gl) : 0;
}

// What is drawn on a window.
typedef struct Showing {
    PetriPainter *painter;
    PetriPicture *picture; // or NULL
    const PetriLabel *labels;
    size_t count;
    double scale;
    int width;
    int height;
    const Texture *texture; // the picture's, on the GPU; NULL: the painter's pixels
    bool done;
} Showing;

static uint32_t *window_pixels(PetriPainter *painter, int width, int height) {
    size_t size = (size_t)width * (size_t)height * sizeof(uint32_t);
    if (size > painter->window_room) {
        heap_give(painter->window);
        painter->window = heap_take(size);
        painter->window_room = painter->window ? size : 0;
    }
    return painter->window;
}

// A label by itself, so that what is shown without its pixels can lie below it.
static bool show_label(const Showing *showing, const PetriLabel *label) {
    PetriPainter *painter = showing->painter;
    double scale = showing->scale, left = floor(label->x * scale), top = floor(label->y * scale);
    double right = fmin(ceil((label->x + label->width) * scale), showing->width);
    double bottom = fmin(ceil((label->y + label->height) * scale), showing->height);
    left = fmax(left, 0);
    top = fmax(top, 0);
    if (!(right > left) || !(bottom > top))
        return true;
    int width = (int)(right - left), height = (int)(bottom - top);
    uint32_t *pixels = window_pixels(painter, width, height);
    if (!pixels)
        return false;
    memset(pixels, 0, (size_t)width * (size_t)height * sizeof *pixels);
    PetriLabel moved = *label;
    moved.x -= left / scale;
    moved.y -= top / scale;
    return petri_painter_labels(painter, &moved, 1, scale, pixels, width, height, (size_t)width * sizeof *pixels) ==
               PETRI_OK &&
           gl_show_pixels(painter->gl, &painter->arena, pixels, (int)left, showing->height - (int)bottom, width, height,
                          true);
}

static void show(void *context) {
    Showing *showing = context;
    PetriPainter *painter = showing->painter;
    if (showing->texture) {
        const CanvasPicture *picture = &showing->picture->picture;
        GlBox box;
        double scale = draw_fit(picture->width, picture->height, showing->width, showing->height, &box.x, &box.y);
        box.width = picture->width * scale;
        box.height = picture->height * scale;
        showing->done = gl_show_image(painter->gl, &painter->arena, showing->texture->image, &box, showing->width,
                                      showing->height, texture_thresholds(), picture->opaque);
    } else {
        showing->done =
            gl_show_pixels(painter->gl, &painter->arena, painter->window, 0, 0, showing->width, showing->height, false);
    }
    for (size_t i = 0; i < showing->count; i++)
        showing->done = showing->done && show_label(showing, &showing->labels[i]);
}

// Makes the picture: its texture if that is what can be shown, else the window's pixels.
static PetriStatus prepare(Showing *showing) {
    PetriPainter *painter = showing->painter;
    PetriPicture *picture = showing->picture;
    PetriStatus status = picture ? draw_make(painter, &picture->picture, &picture->faults) : PETRI_OK;
    const Texture *made = picture && status == PETRI_OK ? draw_made(painter, &picture->picture) : NULL;
    if (made && made->gl && !picture->picture.direct) {
        showing->texture = made;
        return PETRI_OK;
    }
    uint32_t *pixels = window_pixels(painter, showing->width, showing->height);
    size_t stride = (size_t)showing->width * sizeof *pixels;
    if (!pixels)
        return PETRI_MEMORY;
    if (!picture || status != PETRI_OK) {
        memset(pixels, 0, stride * (size_t)showing->height);
        return status;
    }
    return petri_picture_draw(picture, painter, pixels, showing->width, showing->height, stride);
}

PetriStatus petri_painter_show(PetriPainter *painter, PetriPicture *picture, const PetriLabel *labels, size_t count,
                               double scale, int width, int height) {
    const char *problem;
    if (!painter || !painter->on_window || (count > 0 && !labels) || !picture_is_good_size(width, height))
        return PETRI_INVALID;
    Showing showing = {.painter = painter,
                       .picture = picture,
                       .labels = labels,
                       .count = count,
                       .scale = scale,
                       .width = width,
                       .height = height};
    PetriStatus status = prepare(&showing);
    if (!painter->window && !showing.texture)
        return status;
    if (!gl_enter(painter->gl, &problem))
        return PETRI_INVALID;
    Arena *arenas[] = {&painter->arena};
    ArenaMark mark = arena_mark(&painter->arena);
    bool done = arena_protect(arenas, 1, show, &showing) == ARENA_DONE && showing.done;
    arena_rewind(&painter->arena, mark);
    gl_leave(painter->gl);
    return done ? status : PETRI_MEMORY;
}
