// canvas.h: a drawing with Cairo in progress, and the declarations of the files that draw it, from the lowest to the
// highest.
#pragma once

#include "picture/float_image.h"
#include "picture/painter.h"

#include <pango/pangocairo.h>

enum { RECENT_FONTS = 16 };

typedef struct TextFont {
    const char *family; // a list of names
    double size;
    double weight;
    int width;
    int slant;
} TextFont;

// Pango's objects.
struct TextContext {
    PangoFontMap *fonts;
    PangoContext *context;
    PangoLayout *layout;
    TextFont font;                       // that was last set in the layout; reset at the start of each picture
    uint64_t recent_fonts[RECENT_FONTS]; // hashes of fonts that measured texts; 0: none
    uint32_t font_count;                 // number of fonts that were not recent when they were used
};

// The extent of a path on the target, computed from its end points and control points.
typedef struct PathSize {
    double left, right, top, bottom;
    double first_x, first_y; // start of the current subpath
    double last_x, last_y;
    bool starts;   // true if the next point starts a subpath
    double length; // sum of the horizontal and vertical distances between successive points
    double area;   // twice the signed area; parts of opposite orientation cancel
} PathSize;

// A drawing in progress.
typedef struct Canvas {
    PetriPainter *painter;
    const CanvasPicture *picture;
    cairo_t *cr;
    DiagSink *diags;
    bool vector;         // true if the target is a vector surface, false if it is an image
    uint32_t layers;     // number of open layers
    double layer_pixels; // total number of pixels of the open layers
    double columns;      // width of the target in pixels; `rows` is its height
    double rows;
    double path_work;          // sum over the edges of the current path: 1 + number of rows that the edge crosses
    PathSize size;             // extent of the current path
    const DisplayList *list;   // the list being drawn; NULL: none
    DisplayMatrix matrix;      // the list's current matrix
    cairo_matrix_t base;       // transform from the list's units to the target
    DisplayNumbers path;       // the path that is Cairo's current path; `at` is NULL: none
    DisplayMatrix path_matrix; // the list's matrix when it became the current path
    bool failed;               // true after an error was reported
    FloatImagePool pool;       // float images; also charges other memory to the painter's budget
    // On an HDR canvas: drawn on instead of the pixels of `cr`. On other canvases, the image's `pixels` is NULL.
    FloatImage hdr_target;
    // While drawing is redirected offscreen: the previous targets, and the surface that is drawn on.
    cairo_t *outer;
    FloatImage outer_hdr_target;
    cairo_surface_t *offscreen;
} Canvas;

// canvas.c
// Reports a diagnostic of drawing. `place` may be NULL. Each message is reported only once.
__attribute__((format(printf, 5, 6))) void draw_report(Canvas *canvas, const Origin *place, DiagLevel level,
                                                       const char *code, const char *format, ...);
// Charges work, in nanoseconds, to the picture. If that would exceed the limit, reports this and returns false. The
// message ends with `outcome`, which describes what is drawn instead.
extern const char draw_omitted[]; // an `outcome`: the rest of the drawing is left out
bool draw_charge(Canvas *canvas, const Origin *place, double work, const char *outcome);
// If `lacking` is false, does nothing. Otherwise, memory could not be allocated for `what`. If the memory limit is the
// cause, reports that the drawing lacks `what`. If the machine is out of memory, aborts the drawing.
void draw_report_degraded(Canvas *canvas, const Origin *place, const char *what, bool lacking);
// Redirects drawing to a new surface whose top left corner is at x, y of the target. Returns NULL if out of memory.
cairo_surface_t *draw_push_offscreen(Canvas *canvas, int width, int height, double x, double y);
void draw_pop_offscreen(Canvas *canvas);
// Frees everything that the canvas still holds.
void draw_close(Canvas *canvas);
// Returns true if the matrix is invertible. Other matrices must not be passed to Cairo, because they put it into a
// permanent error state.
bool draw_is_invertible(const cairo_matrix_t *m);
// Returns the number of pixels per unit of the current transform, averaged over directions.
double draw_scale_of(cairo_t *cr);
// Makes the current path empty.
void draw_forget_path(Canvas *canvas);
// Returns a string of the list as UTF-8, with a NUL at the end, in the painter's arena.
Str draw_string(Canvas *canvas, const DisplayString *string);

// path.c
// Clamps a point to the range of Cairo's coordinates, and adds it to the extent and cost of the current path.
void draw_clamp_point(Canvas *canvas, double *x, double *y);
// Makes a path of the list Cairo's current path, in the current transform.
void draw_set_path(Canvas *canvas, DisplayNumbers path);
void draw_add_element(Canvas *canvas, PathElement kind, const double *numbers);
void draw_add_elements(Canvas *canvas, DisplayNumbers path);

// cost.c
// Charges the cost of drawing the current path. If that exceeds the limit, reports this and returns false.
bool draw_charge_path(Canvas *canvas, const DisplayPaint *paint, bool fill, bool stroke);
// Like draw_charge_path, for `count` filled boxes of width x height units. Assumes that the boxes are on the target.
bool draw_charge_box(Canvas *canvas, const DisplayPaint *paint, double width, double height, double count);

// image_cache.c
// An image of a list: a file, or the picture of another node.
typedef struct DrawImage {
    Str file; // empty: use `id`
    Str id;
    NodeKind kind; // kind of the image's node, for messages
    Origin place;
} DrawImage;

// Returns the image of the command at `at`, whose operand `file` is empty if it is the picture of another node.
DrawImage draw_image_at(Canvas *canvas, const double *at, const DisplayString *file);
// Returns a surface with the pixels of an image; the caller destroys the surface. Returns NULL if the image does not
// exist. A file that cannot be read is reported.
cairo_surface_t *draw_find_image(Canvas *canvas, const DrawImage *image);
// Like draw_find_image, but does not copy the pixels. Sets *texture to the rendered picture of a node, or *file to the
// cached pixels of a file. The pointer that does not apply is set to NULL. Returns false if both are NULL.
bool draw_find_pixels(Canvas *canvas, const DrawImage *image, const Texture **texture, cairo_surface_t **file);
// A CanvasBackend.find_image.
bool draw_find_file(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, ImagePixels *image,
                    DiagSink *diags);
void draw_images_close(PetriPainter *painter);

// jpeg.c
// Decodes a JPEG file. Pixels and decoder together take at most `memory` bytes. After a failure, returns NULL and sets
// *problem to the reason, or to NULL if out of memory.
cairo_surface_t *draw_read_jpeg(Str bytes, size_t memory, const char **problem);

// source.c
cairo_operator_t draw_operator(int composite);
void draw_set_source(Canvas *canvas, const DisplayPaint *paint);

// shape.c
// Sets antialiasing and fill rule for filling and clipping. Cairo keeps these settings, so they must be set before each
// use.
void draw_set_edges(Canvas *canvas, bool antialias, int fill_type);
// Returns true if the current path can be drawn in reasonable time. If not, reports an error, and the picture fails.
bool draw_is_drawable(Canvas *canvas);
// Returns true if the current path is so long that it is stroked in segments, which overlap.
bool draw_strokes_in_segments(const Canvas *canvas);
// Applies the paint's path effect to the current path, then fills and strokes it with the current source and operator.
void draw_fill_and_stroke(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint);
// Stores the bounding box of the painted path, in pixels of the target, in `box`: left, top, right, bottom. Returns
// false if the box is unbounded or unknown.
bool draw_find_box(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint, double box[4]);
// Clips to the bounding box of the painted path.
void draw_clip_to_box(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint);
// Returns the shape as a mask. The caller destroys it.
cairo_pattern_t *draw_make_mask(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint);

// paint.c
// Fills or strokes the current path. If the shape is both, paints them as one.
void draw_current_path(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint);

// text.c
// Returns the painter's fonts, which the first call opens. Returns NULL if out of memory.
TextContext *draw_text_context(PetriPainter *painter);
void draw_text_close(PetriPainter *painter);
// Makes the outline of a text the current path. Returns false if the text is not drawn.
bool draw_set_text_path(Canvas *canvas, const TEXTOperands *text, const DisplayPaint *paint);
// A CanvasBackend.measure_text.
const char *draw_measure_text(PetriPainter *painter, Str text, const TextStyle *style, double *width, bool *loaded);

// labels.c
// A CanvasBackend.draw_labels.
PetriStatus draw_labels(PetriPainter *painter, const PetriLabel *labels, size_t count, size_t size, double scale,
                        uint32_t *pixels, int width, int height, size_t stride);

// image.c
// Draws a PETRI_DRAW_IMAGE or PETRI_DRAW_PIXELS.
void draw_image(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint);

// filters.c
// Draws a path, text or image, through the paint's filter if it has one.
void draw_command(Canvas *canvas, const DisplayRow *row, const DisplayPaint *paint);

// list.c
// Draws a list. The current transform must map the list's units to the target.
void draw_display_list(Canvas *canvas, const DisplayList *list);

// automatic_shapes.c
void draw_automatic(Canvas *canvas, const AutoPicture *picture);
