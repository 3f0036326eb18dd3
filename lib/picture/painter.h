// painter.h: a painter, which renders pictures and keeps fonts, images and the last frame's pictures.
//
// A painter or picture must be used by only one thread at a time. There is no global state.
#pragma once

#include "base/host_struct.h"
#include "builtin/pictures.h"
#include "picture/backend.h"
#include "picture/display_list.h"
#include "picture/render_graph.h"

enum { IMAGE_MAX_SIDE = 16384, IMAGE_MAX_PIXELS = 1 << 26 }; // maximum side and area of an image, in pixels

typedef struct TextContext TextContext; // fonts of the Cairo backend
typedef struct CachedImage CachedImage; // an image file of the Cairo backend

struct PetriPainter {
    Arena arena;                  // reset for each picture
    Budget budget;                // memory and work limits of drawing
    uint64_t total_work;          // work units of all render graphs
    const CanvasBackend *backend; // draws canvases; all functions are NULL if there is no backend
    PetriCanvasBackend host;      // the host's functions, if it is the backend
    TextContext *text_context;
    CachedImage *images;
    DisplayListSizes sizes; // array lengths of the last display list
    RenderGraph *render_graph;
    Gl *gl;                 // opened when first needed; NULL: not open
    const char *gl_problem; // why `gl` cannot be opened (borrowed); NULL if `gl` is open or has not been needed yet
    bool lacks_memory;      // true if the memory limit was reported since painter_limit
    PetriShaderTest *shader_test; // tests the shaders of scripts; NULL: they are not tested
    void *shader_test_data;
    bool on_window;   // true if `gl` is the context of the host's window
    uint32_t *window; // pixel buffer for the window
    size_t window_capacity;
    BuiltinPictures pictures; // for the session that the painter serves (petri_painter_serve)
    PetriSession *served;     // NULL: none
    int64_t rendered_frame;   // number of the frame of the last picture whose render graph was rendered
    uint64_t rendered;        // serial number of the last picture whose render graph was rendered
    Texture *shown;           // the window's picture, as rendered in picture `rendered`; NULL: none
};

// reports.c
// Reports a diagnostic. `place` may be NULL.
__attribute__((format(printf, 5, 6))) void painter_report(DiagSink *diags, const Origin *place, DiagLevel level,
                                                          const char *code, const char *format, ...);
void painter_report_args(DiagSink *diags, const Origin *place, DiagLevel level, const char *code, const char *format,
                         va_list args);
// Called after a failed allocation. If the memory limit was the cause, reports that the node is left out and returns
// true. Returns false if the machine is out of memory.
bool painter_report_refused(PetriPainter *painter, DiagLevel level, const Origin *place, const char *node, int width,
                            int height, DiagSink *diags);
// Sets the painter's limits for memory and work to those of the picture.
void painter_limit(PetriPainter *painter, const CanvasPicture *picture);
// After drawing, reports the limits that suffice for what was left out because of a limit.
void painter_report_needed(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags);
// Reports that drawing was aborted because of a limit. Returns PETRI_INVALID, or PETRI_OUT_OF_MEMORY if there is no
// memory for the report.
PetriStatus painter_report_limit(DiagSink *diags);
// Reports that there is no backend. Returns PETRI_UNSUPPORTED, or PETRI_OUT_OF_MEMORY if there is no memory for the
// report.
PetriStatus painter_report_no_backend(DiagSink *diags);

// painter_gl.c
// Returns the painter's Gl, which the first call opens. On failure, returns NULL and sets *problem to the reason, or to
// NULL if out of memory.
Gl *painter_gl(PetriPainter *painter, const char **problem);

// painter.c
// Implements petri_painter_open. NULL: there is no backend.
PetriPainter *painter_open(const CanvasBackend *backend);
// Renders the render graph of a picture, unless the painter has already done so. After that, painter_records returns
// the picture's records.
PetriStatus painter_render(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags);
// Like painter_render, and downloads the window's picture if it is on the GPU.
PetriStatus painter_render_pixels(PetriPainter *painter, const CanvasPicture *picture, DiagSink *diags);
// Returns the rendered picture of the window. Returns NULL if there is none, or if the window's canvas is drawn
// directly.
const Texture *painter_rendered(const PetriPainter *painter, const CanvasPicture *picture);
// Returns the scale at which width x height fits into a box without changing its aspect ratio. *left and *top receive
// the offset that centres the scaled area in the box.
double painter_fit(double width, double height, double box_width, double box_height, double *left, double *top);
// Draws the picture into premultiplied ARGB32 pixels. Problems are reported to `diags`. If the result is
// PETRI_INVALID, at least one of the reports is an error.
PetriStatus painter_draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width,
                                int height, size_t stride, DiagSink *diags);
// Copies a texture to ARGB32 pixels of the same size. If `opaque` is true, composites it over black.
void painter_copy_texture(const Texture *texture, bool opaque, uint32_t *pixels, size_t stride);
void painter_clear(uint32_t *pixels, int width, int height, size_t stride);
// Returns the records of `picture`. If another picture was rendered after it, or none, *count is 0.
const Recorded *painter_records(const PetriPainter *painter, const CanvasPicture *picture, uint32_t *count);
// Returns a label from an array of a host, in which each label has `size` bytes.
static inline PetriLabel painter_label_at(const PetriLabel *labels, size_t size, size_t index) {
    PetriLabel label;
    host_struct_write(&label, sizeof label, (const char *)labels + index * size, size);
    return label;
}

// display_list_export.c
// Return a display list for a host, of a canvas or of a picture that needs no shaders. `scale` is the number of pixels
// per unit of the picture.
DisplayNumbers display_list_of_canvas(PetriPainter *painter, const DrawNode *canvas, double width, double height);
DisplayNumbers display_list_of_picture(Arena *arena, const CanvasPicture *picture, double scale);
