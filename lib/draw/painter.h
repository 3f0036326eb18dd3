// painter.h: a painter, and what drawing does whoever draws the canvases: Cairo (draw.h) or the host (no_cairo.c).
#ifndef PETRI_DRAW_PAINTER_H
#define PETRI_DRAW_PAINTER_H

#include "draw/display_list.h"
#include "draw/render_graph.h"

enum { DRAW_MAX_SIDE = 16384, DRAW_MAX_PIXELS = 1 << 26 }; // of an image

typedef struct TextContext TextContext; // fonts: text.c
typedef struct CachedImage CachedImage; // of an image file: images.c

struct PetriPainter {
    Arena arena;  // reset with each picture
    Budget meter; // of the memory that drawing may have, and of its work
    TextContext *text_context;
    DisplayListSizes sizes; // of the list that was built last
    CachedImage *images;
    PetriCanvasBackend backend; // that draws canvases where Cairo does not; no functions: none
    RenderGraph *render_graph;
    Gl *gl;                 // opened when it is needed
    const char *gl_problem; // why it cannot be; borrowed
    bool on_window;         // gl draws on a host's window
    uint32_t *window;       // pixels for it
    size_t window_capacity;
    uint64_t made;  // serial number of the picture whose tree was made last
    Texture *shown; // of its window; or NULL
};

// renderer.c
// Reports what is wrong; the place may be NULL.
__attribute__((format(printf, 5, 6))) void draw_report(DiagSink *faults, const Origin *place, DiagLevel level,
                                                       const char *code, const char *format, ...);
void draw_report_args(DiagSink *faults, const Origin *place, DiagLevel level, const char *code, const char *format,
                      va_list args);
// Whether memory was lacking because of the limit and not of the machine; tells that a node is left out then.
bool draw_report_refused(PetriPainter *painter, const Origin *place, const char *node, int width, int height,
                         DiagSink *faults);
// Sets how much memory the painter may take from here on, and how much work.
void draw_limit(PetriPainter *painter, const CanvasPicture *picture);
// Reports that a drawing was given up because of that: PETRI_INVALID, or PETRI_OUT_OF_MEMORY without room for it.
PetriStatus draw_report_limit(DiagSink *faults);
// Makes the pictures, and has the window's in memory if it is made of them.
PetriStatus draw_render_pixels(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults);
// The rows of a picture in pixels of its size.
void draw_texture(const Texture *texture, bool opaque, uint32_t *pixels, size_t stride);
void draw_clear(uint32_t *pixels, int width, int height, size_t stride);
// An image that stands among pictures, in the size and the direction that its node wants; NULL after a report.
Texture *draw_sized_image(PetriPainter *painter, const DrawNode *node, const uint32_t *pixels, int width, int height,
                          size_t stride, bool alpha, DiagSink *faults);

// display_list_export.c: what petri_picture_display_list writes, of a canvas or of all that is drawn without programs.
const double *draw_canvas_display_list(PetriPainter *painter, const DrawNode *canvas, double width, double height,
                                       size_t *count);
const double *draw_picture_display_list(Arena *arena, const CanvasPicture *picture, size_t *count);

// cairo_canvas.c, or no_cairo.c
void draw_tools_close(PetriPainter *painter);
// Draws a canvas of width x height units into a cleared picture, which it fills: sRGB, or linear light. PETRI_OK,
// PETRI_INVALID after an error was reported, or PETRI_OUT_OF_MEMORY.
PetriStatus draw_canvas(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, int width,
                        int height, Texture *texture, DiagSink *faults);
// The picture of an image that stands among pictures, to be freed; NULL, after a report, if there is none.
Texture *draw_picture_image(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node,
                            DiagSink *faults);

#endif
