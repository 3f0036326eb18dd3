// draw.h: internal declarations of the files that draw with Cairo.
#pragma once

#include "draw/float_image.h"
#include "draw/painter.h"

#include <pango/pangocairo.h>

// Pango's objects. `family` and `font` are the font that was last set in the layout.
struct TextContext {
    PangoFontMap *fonts;
    PangoContext *context;
    PangoLayout *layout;
    const char *family; // reset to NULL at the start of each picture; NULL: no font set
    DisplayText font;
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
    DiagSink *faults;
    bool vector;         // true if the target is a vector surface, false if it is an image
    uint32_t layers;     // number of open layers
    double layer_pixels; // total number of pixels of the open layers
    double columns;      // width of the target in pixels; `rows` is its height
    double rows;
    double path_work;              // sum over the edges of the current path: 1 + number of rows that the edge crosses
    PathSize size;                 // extent of the current path
    const DisplayList *list;       // the list being drawn; NULL: none
    const DisplayCommand *path_of; // the command whose path is Cairo's current path; NULL: none
    cairo_matrix_t base;           // transform from the list's units to the target
    bool failed;                   // true after an error was reported
    FloatImagePool pool;           // float images; also charges other memory to the painter's budget
    // On an HDR canvas: drawn on instead of the pixels of `cr`. On other canvases, the image's `pixels` is NULL.
    FloatImage hdr_target;
    // While drawing is redirected offscreen: the previous targets, and the surface that is drawn on.
    cairo_t *outer;
    FloatImage outer_hdr_target;
    cairo_surface_t *offscreen;
} Canvas;

// Reports a diagnostic of drawing. Each message is reported only once.
__attribute__((format(printf, 4, 5))) void draw_report_canvas(Canvas *canvas, DiagLevel level, const char *code,
                                                              const char *format, ...);

// Like draw_report_canvas, with a position in the script.
__attribute__((format(printf, 5, 6))) void draw_report_canvas_at(Canvas *canvas, const Origin *place, DiagLevel level,
                                                                 const char *code, const char *format, ...);

// offscreen.c
// Redirects drawing to a new surface whose top left corner is at x, y of the target. Returns NULL if out of memory.
cairo_surface_t *draw_push_offscreen(Canvas *canvas, int width, int height, double x, double y);
void draw_pop_offscreen(Canvas *canvas);
// Charges work, in nanoseconds, to the picture. If that would exceed the limit, reports this and returns false. The
// message ends with `outcome`, which describes what is drawn instead.
extern const char draw_omitted[]; // an `outcome`: the rest of the drawing is left out
bool draw_charge(Canvas *canvas, const Origin *place, double work, const char *outcome);
// If `lacking` is false, does nothing. Otherwise, memory could not be allocated for `what`. If the memory limit is the
// cause, reports that the drawing lacks `what`. If the machine is out of memory, aborts the drawing.
void draw_report_degraded(Canvas *canvas, const Origin *place, const char *what, bool lacking);
// Frees everything that the canvas still holds.
void draw_close(Canvas *canvas);

// cairo_backend.c
// Draws a list. The current transform must map the list's units to the target.
void cairo_draw_list(Canvas *canvas, const DisplayList *list);
// Draws a command, but ignores the paint's filter.
void draw_unfiltered(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// Returns true if the matrix is invertible. Other matrices must not be passed to Cairo, because they put it into a
// permanent error state.
bool draw_is_invertible(const cairo_matrix_t *m);
// Returns the number of pixels per unit of the current transform, averaged over directions.
double draw_scale_of(cairo_t *cr);

// cairo_path.c
// Clamps a point to the range of Cairo's coordinates, and adds it to the extent and cost of the current path.
void draw_clamp_point(Canvas *canvas, double *x, double *y);
void draw_ellipse_path(Canvas *canvas, double x, double y, double rx, double ry, double start, double sweep, bool join);
// Makes the command's path Cairo's current path, in the current transform.
void draw_set_path(Canvas *canvas, const DisplayCommand *command);
void draw_add_element(Canvas *canvas, PathElement kind, const double *numbers);
// Adds path elements in the format of DisplayList.numbers.
void draw_add_elements(Canvas *canvas, const double *numbers, uint32_t count);
void draw_forget_path(Canvas *canvas);

// cairo_paint.c
cairo_operator_t draw_operator(int composite);
// Sets antialiasing and fill rule for filling and clipping. Cairo keeps these settings, so they must be set before each
// use.
void draw_set_edges(Canvas *canvas, bool antialias, int fill_type);
// Fills or strokes the current path. If the command does both, paints them as one shape.
void draw_current_path(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// Returns the command's shape as a mask. The caller destroys it.
cairo_pattern_t *draw_make_mask(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// Stores the bounding box of the painted path, in pixels of the target, in `box`: left, top, right, bottom. Returns
// false if the box is unbounded or unknown.
bool draw_find_box(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint, double box[4]);
// Clips to the bounding box of the painted path.
void draw_clip_to_box(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// Returns true if the current path can be drawn in reasonable time. If not, reports an error, and the picture fails.
bool draw_is_drawable(Canvas *canvas);

// cost_model.c
// Charges the cost of drawing the current path. If that exceeds the limit, reports this and returns false.
bool draw_charge_path(Canvas *canvas, const DisplayPaint *paint, bool fill, bool stroke);
// Like draw_charge_path, for `count` filled boxes of width x height units. Assumes that the boxes are on the target.
bool draw_charge_box(Canvas *canvas, const DisplayPaint *paint, double width, double height, double count);

// cairo_source.c
void draw_set_source(Canvas *canvas, const DisplayPaint *paint);

// path_effects.c
// Returns true if the paint has an effect that changes the path. Returns false if it only dashes strokes, because Cairo
// draws dashes.
bool draw_has_effect(const Canvas *canvas, const DisplayPaint *paint);
// Applies the effect to a path and makes the result the current path. If `lines` is true, the result is for stroking,
// otherwise for filling. Returns false if out of memory.
bool draw_apply_effect(Canvas *canvas, const DisplayPaint *paint, const cairo_path_t *path, bool lines);

// cairo_filters.c
// Draws a command through the paint's filter.
void draw_filtered(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);

// text.c
// Returns the painter's fonts, which the first call opens. Returns NULL if out of memory.
TextContext *draw_text_context(PetriPainter *painter);
void draw_text_close(PetriPainter *painter);
void draw_text(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);

// images.c
void draw_image(Canvas *canvas, const DisplayImage *image, const DisplayPaint *paint);
// Returns a surface with the pixels of an image; the caller destroys the surface. Returns NULL if the image does not
// exist. A file that cannot be read is reported.
cairo_surface_t *draw_find_image(Canvas *canvas, const DisplayImage *image);
// Like draw_find_image, but does not copy the pixels. Sets *texture to the rendered picture of a node, or *file to the
// cached pixels of a file. The pointer that does not apply is set to NULL. Returns false if both are NULL.
bool draw_find_pixels(Canvas *canvas, const DisplayImage *image, const Texture **texture, cairo_surface_t **file);
void draw_images_close(PetriPainter *painter);
// Decodes a JPEG file. Pixels and decoder together take at most `memory` bytes. After a failure, returns NULL and sets
// *problem to the reason, or to NULL if out of memory.
cairo_surface_t *draw_read_jpeg(Str bytes, size_t memory, const char **problem);

// cairo_automatic.c
void draw_automatic(Canvas *canvas, const AutoPicture *picture);
