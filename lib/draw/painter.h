// painter.h: a painter, and the functions that builds with Cairo (draw.h) and without it (no_cairo.c) share.
#pragma once

#include "base/host_struct.h"
#include "builtin/pictures.h"
#include "draw/display_list.h"
#include "draw/render_graph.h"

enum { DRAW_MAX_SIDE = 16384, DRAW_MAX_PIXELS = 1 << 26 }; // maximum side and area of an image, in pixels

enum { RECENT_FONTS = 16 };

typedef struct TextContext TextContext; // defined in text.c
typedef struct CachedImage CachedImage; // an image file; defined in images.c

struct PetriPainter {
    Arena arena;         // reset for each picture
    Budget budget;       // memory and work limits of drawing
    uint64_t total_work; // work units of all render graphs
    TextContext *text_context;
    DisplayListSizes sizes; // array lengths of the last display list
    CachedImage *images;
    PetriCanvasBackend backend; // draws canvases in builds without Cairo; all functions NULL: none
    RenderGraph *render_graph;
    Gl *gl;                 // opened when first needed; NULL: not open
    const char *gl_problem; // why `gl` cannot be opened (borrowed); NULL if `gl` is open or has not been needed yet
    bool lacks_memory;      // true if the memory limit was reported since draw_limit
    PetriShaderTest *shader_test; // tests the shaders of scripts; NULL: they are not tested
    void *shader_test_data;
    bool on_window;   // true if `gl` is the context of the host's window
    uint32_t *window; // pixel buffer for the window
    size_t window_capacity;
    uint64_t recent_fonts[RECENT_FONTS]; // hashes of fonts that measured texts; 0: none
    uint32_t font_count;                 // number of fonts that were not recent when they were used
    BuiltinPictures pictures;            // for the session that the painter serves (petri_painter_serve)
    PetriSession *served;                // NULL: none
    int64_t made_frame;                  // number of the frame of the last picture whose render graph was rendered
    uint64_t made;                       // serial number of the last picture whose render graph was rendered
    Texture *shown;                      // the window's picture, as rendered in picture `made`; NULL: none
};

// Returns a label from an array of a host, in which each label has `size` bytes.
static inline PetriLabel draw_label_at(const PetriLabel *labels, size_t size, size_t index) {
    PetriLabel label;
    host_struct_write(&label, sizeof label, (const char *)labels + index * size, size);
    return label;
}

// renderer.c
// Reports a diagnostic. `place` may be NULL.
__attribute__((format(printf, 5, 6))) void draw_report(DiagSink *faults, const Origin *place, DiagLevel level,
                                                       const char *code, const char *format, ...);
void draw_report_args(DiagSink *faults, const Origin *place, DiagLevel level, const char *code, const char *format,
                      va_list args);
// Called after a failed allocation. If the memory limit was the cause, reports that the node is left out and returns
// true. Returns false if the machine is out of memory.
bool draw_report_refused(PetriPainter *painter, DiagLevel level, const Origin *place, const char *node, int width,
                         int height, DiagSink *faults);
// Passes the painter's test of shaders to its Gl.
void draw_test_shaders(PetriPainter *painter);
// Sets the painter's limits for memory and work to those of the picture.
void draw_limit(PetriPainter *painter, const CanvasPicture *picture);
// After drawing, reports the limits that suffice for what was left out because of a limit.
void draw_report_needed(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults);
// Reports that drawing was aborted because of a limit. Returns PETRI_INVALID, or PETRI_OUT_OF_MEMORY if there is no
// memory for the report.
PetriStatus draw_report_limit(DiagSink *faults);
// Renders the render graph, and downloads the window's picture if it is on the GPU.
PetriStatus draw_render_pixels(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults);
// Copies a texture to ARGB32 pixels of the same size. If `opaque` is true, composites it over black.
void draw_texture(const Texture *texture, bool opaque, uint32_t *pixels, size_t stride);
void draw_clear(uint32_t *pixels, int width, int height, size_t stride);
// Returns an image, resized and flipped according to the node's attributes. If that is too large, reports this and
// returns NULL.
Texture *draw_sized_image(PetriPainter *painter, const DrawNode *node, const uint32_t *pixels, int width, int height,
                          size_t stride, bool alpha, DiagSink *faults);

// display_list_export.c
// Return an array of numbers in the format of petri_picture_display_list, for a canvas or for a picture that needs no
// shaders. `scale` is the number of pixels per unit of the picture.
const double *draw_canvas_display_list(PetriPainter *painter, const DrawNode *canvas, double width, double height,
                                       size_t *count);
const double *draw_picture_display_list(Arena *arena, const CanvasPicture *picture, double scale, size_t *count);

// text.c, or no_cairo.c
enum { MAX_TEXT_LENGTH = 10000, MAX_FONT_SIZE = 4000 }; // maximum length of a text in bytes, and font size in pixels

// The style of a text that is measured, with the defaults filled in. `family` is a list of names, separated by commas.
typedef struct TextStyle {
    double size;
    double weight;
    int width;
    int slant;
    char family[1000];
} TextStyle;
// Reads the style of a text. Returns NULL, or the reason if an argument is not valid.
const char *draw_read_style(const BuiltinText *text, TextStyle *out);
// A BuiltinPictures.measure. `user_data` is the painter.
const char *draw_measure_text(void *user_data, const BuiltinText *text, double *width, bool *loaded);

// cairo_canvas.c, or no_cairo.c
void draw_tools_close(PetriPainter *painter);
// Draws a canvas of width x height units into a cleared sRGB or linear picture. The canvas is scaled to fill the
// picture. Returns PETRI_OK, PETRI_INVALID after an error was reported, or PETRI_OUT_OF_MEMORY.
PetriStatus draw_canvas(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, int width,
                        int height, Texture *texture, DiagSink *faults);
// Loads the image file of an image node in the render graph. The caller frees the picture. If no file is named, returns
// NULL. If the file cannot be loaded, reports this and returns NULL.
Texture *draw_picture_image(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node,
                            DiagSink *faults);
