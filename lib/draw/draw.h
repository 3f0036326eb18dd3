// draw.h: what the files that draw with Cairo share.
#ifndef PETRI_DRAW_DRAW_H
#define PETRI_DRAW_DRAW_H

#include <pango/pangocairo.h>

#include "draw/pictures.h"

typedef struct Picture Picture; // of an image file: images.c

struct PetriPainter {
    Arena arena; // reset with each picture
    PangoFontMap *fonts;
    PangoContext *text_context;
    PangoLayout *layout;
    const char *family; // what the layout is set to; NULL at first in each picture
    Look font;
    Picture *images;
    Pictures *pictures;
    Gl *gl;                 // opened when it is needed
    const char *gl_problem; // why it cannot be; borrowed
    uint64_t made;          // serial number of the picture whose tree was made last
    Texture *shown;         // of its window; or NULL
};

// A picture being drawn.
typedef struct Canvas {
    PetriPainter *painter;
    const CanvasPicture *picture;
    cairo_t *cr;
    DiagSink *faults;
    bool vector;         // the target is no array of pixels
    uint32_t layers;     // that are open
    double layer_pixels; // in them
    double rows;         // of the target
    double path_work;    // rows that the edges of the current path cross
    double last_y;       // of its last point, on the target
    bool failed;         // an error was reported
} Canvas;

// Reports what drawing has found, each text once.
__attribute__((format(printf, 4, 5))) void draw_fault(Canvas *canvas, DiagLevel level, const char *code,
                                                      const char *format, ...);

__attribute__((format(printf, 4, 5))) void draw_report(DiagSink *faults, DiagLevel level, const char *code,
                                                       const char *format, ...);

// paint.c
// Draws a canvas into a cleared sRGB picture of its size. PETRI_OK, PETRI_INVALID after an error was reported, or
// PETRI_MEMORY.
PetriStatus draw_canvas(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, Texture *texture,
                        DiagSink *faults);

// tree.c
void draw_tree(Canvas *canvas, const DrawNode *canvas_node);

// looks.c
// Takes a node's attributes, and the gradient or colour among its children, into a look.
void draw_take_look(Look *look, const DrawNode *node);
// Applies translate, scale and rotate in their order. False if nothing of what follows can be seen: it is squeezed to
// nothing, or beyond all numbers.
bool draw_transform(cairo_t *cr, const DrawNode *node);
bool draw_is_invertible(const cairo_matrix_t *m);
// How many pixels a unit is, about.
double draw_scale_of(cairo_t *cr);

// paths.c
// Moves a point that is too far away for Cairo's coordinates to where it can be reckoned with.
void draw_tame(Canvas *canvas, double *x, double *y);
void draw_ellipse_path(Canvas *canvas, double x, double y, double rx, double ry, double start, double sweep, bool join);
// Adds what a node stands for to the path. False if the node is none that adds to paths.
bool draw_add_path(Canvas *canvas, const DrawNode *node);

// paints.c
cairo_operator_t draw_operator(int composite);
// How the edges of what is filled or clipped are; Cairo keeps what was set last, for whatever it was.
void draw_set_edges(Canvas *canvas, const Look *look);
void draw_fill(Canvas *canvas, const Look *look);   // the path is kept
void draw_stroke(Canvas *canvas, const Look *look); // the path is kept
void draw_clip(Canvas *canvas, const Look *look);   // the path is kept
// Paints what is in the clip with the source that is set.
void draw_paint(Canvas *canvas, int composite, double alpha);

// text.c
bool draw_text_open(PetriPainter *painter);
void draw_text_close(PetriPainter *painter);
void draw_text(Canvas *canvas, const DrawNode *node, const Look *look);

// images.c
void draw_image(Canvas *canvas, const DrawNode *node, const Look *look);
// The picture of an image that stands among pictures, to be freed; NULL, after a report, if there is none.
Texture *draw_picture_image(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node,
                            DiagSink *faults);
void draw_images_close(PetriPainter *painter);
// The pixels of a JPEG file; NULL with a reason.
cairo_surface_t *draw_read_jpeg(Str bytes, const char **problem);

// automatic.c
void draw_automatic(Canvas *canvas, const AutoPicture *picture);

// A path that is put aside while another is drawn.
typedef struct KeptPath {
    cairo_path_t *path; // NULL: there was none
    double work;
} KeptPath;
KeptPath draw_keep_path(Canvas *canvas);
void draw_put_back_path(Canvas *canvas, KeptPath kept);

#endif
