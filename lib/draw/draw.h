// draw.h: what the files that draw with Cairo share.
#ifndef PETRI_DRAW_DRAW_H
#define PETRI_DRAW_DRAW_H

#include "draw/painter.h"

#include <pango/pangocairo.h>

typedef struct FloatImageMemory FloatImageMemory; // float_image.c

// Red, green, blue and alpha of each pixel, multiplied by alpha, 0 to 1; rows from the top.
typedef struct FloatImage {
    int width;
    int height;
    float *pixels; // NULL: none
    int x;         // where it lies on the target, if it is drawn on
    int y;
} FloatImage;

// Fonts, and what the layout is set to.
struct TextContext {
    PangoFontMap *fonts;
    PangoContext *context;
    PangoLayout *layout;
    const char *family; // NULL at first in each picture
    DisplayText font;
};

// How much of the target a path covers, from its points and control points there, all as one figure.
typedef struct PathSize {
    double left, right, top, bottom;
    double last_x, last_y;
    double length; // across and down
    double area;   // twice; what runs the other way round counts against it
} PathSize;

// A picture being drawn.
typedef struct Canvas {
    PetriPainter *painter;
    const CanvasPicture *picture;
    cairo_t *cr;
    DiagSink *faults;
    bool vector;         // the target is no array of pixels
    uint32_t layers;     // that are open
    double layer_pixels; // in them
    double columns;      // of the target
    double rows;
    double path_work;               // rows that the edges of the current path cross
    PathSize size;                  // of that path
    const DisplayList *list;        // or NULL
    const DisplayCommand *path_of;  // the command whose path is the current one; or NULL
    cairo_matrix_t base;            // of the list's units
    bool failed;                    // an error was reported
    size_t charged;                 // bytes that are charged
    FloatImageMemory *float_images; // all there are
    FloatImage hdr_target;          // what is drawn on in place of the target's pixels; or none
    // While something is drawn apart: what was drawn on before, and the surface.
    cairo_t *outer;
    FloatImage outer_hdr_target;
    cairo_surface_t *offscreen;
} Canvas;

// Reports what drawing has found, each text once.
__attribute__((format(printf, 4, 5))) void draw_report_canvas(Canvas *canvas, DiagLevel level, const char *code,
                                                              const char *format, ...);

// The same about what stands at a place.
__attribute__((format(printf, 5, 6))) void draw_report_canvas_at(Canvas *canvas, const Origin *place, DiagLevel level,
                                                                 const char *code, const char *format, ...);

// offscreen.c
// Charges bytes to the picture; false if it may not have so many.
bool draw_reserve(Canvas *canvas, size_t bytes);
void draw_release(Canvas *canvas, size_t bytes);
// Draws on a surface of its own from here on, whose top left corner is at x, y of the target; NULL without memory.
cairo_surface_t *draw_push_offscreen(Canvas *canvas, int width, int height, double x, double y);
void draw_pop_offscreen(Canvas *canvas);
// Charges work, in nanoseconds, to the picture; false, after a report, if it is too much: then what comes of it is
// told.
extern const char draw_omitted[]; // all that comes now
bool draw_charge(Canvas *canvas, const Origin *place, double work, const char *outcome);
// If memory was lacking: tells that something is drawn without this, or leaves if it is the machine's.
void draw_report_degraded(Canvas *canvas, const Origin *place, const char *what, bool lacking);
// Gives back whatever is still held.
void draw_close(Canvas *canvas);

// cairo_backend.c
// Draws a list. The matrix in force is that of its units.
void cairo_draw_list(Canvas *canvas, const DisplayList *list);
// Draws without the paint's filter.
void draw_unfiltered(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// Cairo would fail for good with another matrix.
bool draw_is_invertible(const cairo_matrix_t *m);
// How many pixels a unit is, about.
double draw_scale_of(cairo_t *cr);

// cairo_path.c
// Moves a point that is too far away for Cairo's coordinates to where it can be reckoned with.
void draw_clamp_point(Canvas *canvas, double *x, double *y);
void draw_ellipse_path(Canvas *canvas, double x, double y, double rx, double ry, double start, double sweep, bool join);
// Makes the command's path the current one, in the matrix that is in force.
void draw_set_path(Canvas *canvas, const DisplayCommand *command);
void draw_add_element(Canvas *canvas, PathElement kind, const double *numbers);
void draw_forget_path(Canvas *canvas);

// cairo_paint.c
cairo_operator_t draw_operator(int composite);
// How the edges of what is filled or clipped are; Cairo keeps what was set last, for whatever it was.
void draw_set_edges(Canvas *canvas, bool antialias, int fill_type);
// Fills or strokes the current path, or both as one figure.
void draw_current_path(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// A figure as a mask, to be destroyed.
cairo_pattern_t *draw_make_mask(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// The box on the target that the current path is drawn in: left, top, right, bottom; false if that is not known.
bool draw_find_box(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint, double box[4]);
// What is drawn next touches no more than that.
void draw_clip_to_box(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
// Can the path be drawn in reasonable time? If not, the picture fails.
bool draw_is_drawable(Canvas *canvas);

// cost_model.c
// Charges what the current path takes to be drawn; false, after a report, if it is too much.
bool draw_charge_path(Canvas *canvas, const DisplayPaint *paint, bool fill, bool stroke);
// The same for so many boxes of the script's units, wherever they are.
bool draw_charge_box(Canvas *canvas, const DisplayPaint *paint, double width, double height, double count);

// cairo_source.c
void draw_set_source(Canvas *canvas, const DisplayPaint *paint);

// path_effects.c
// Has the paint an effect that changes the path, other than dashes of its lines?
bool draw_has_effect(const Canvas *canvas, const DisplayPaint *paint);
// Makes what becomes of a path the current one, for its lines or for what is inside. False without memory.
bool draw_apply_effect(Canvas *canvas, const DisplayPaint *paint, const cairo_path_t *path, bool lines);

// noise.c
// A pattern of noise within the clip.
cairo_pattern_t *draw_noise(Canvas *canvas, const DisplaySource *source, double alpha);

// filters.c
// Draws through the paint's filter.
void draw_filtered(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);

// text.c
// Fonts, from the first call on; NULL if memory is lacking.
TextContext *draw_text_context(PetriPainter *painter);
void draw_text_close(PetriPainter *painter);
void draw_text(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);

// images.c
void draw_image(Canvas *canvas, const DisplayImage *image, const DisplayPaint *paint);
// The pixels of an image and how many there are, to be given back; NULL, after a report, if there is none.
cairo_surface_t *draw_find_image(Canvas *canvas, const DisplayImage *image);
// The same without a copy: the picture of a node, in memory, or what a file has; false if there is neither.
bool draw_find_pixels(Canvas *canvas, const DisplayImage *image, const Texture **texture, cairo_surface_t **file);
void draw_images_close(PetriPainter *painter);
// The pixels of a JPEG file; NULL with a reason, or without one if memory is used up.
cairo_surface_t *draw_read_jpeg(Str bytes, const char **problem);

// automatic.c
void draw_automatic(Canvas *canvas, const AutoPicture *picture);

#endif
