// cairo_canvas.h: drawings become pixels and files. What draws is Cairo; without it everything here says
// PETRI_UNSUPPORTED.
//
// A picture is plain data that nobody changes while it is drawn. A painter holds what is worth keeping from picture to
// picture: fonts and images. Both are used by one thread at a time; there is nothing global.
#ifndef PETRI_DRAW_CAIRO_CANVAS_H
#define PETRI_DRAW_CAIRO_CANVAS_H

#include "base/diag.h"
#include "base/file_access.h"
#include "canvas/drawing.h"
#include "draw/automatic.h"
#include "draw/encode.h"
#include "draw/texture.h"
#include "petri-draw.h"

enum { PICTURE_NAMES = 64 };

// One of `window` and `automatic` is there.
typedef struct CanvasPicture {
    const DrawNode *const *tops; // all windows of the frame
    uint32_t top_count;
    const DrawNode *window; // the one that is shown
    const DrawNode *direct; // the canvas that is all of it; or NULL
    bool needs_history;     // some window needs the frames before
    double beat;
    const char *names[PICTURE_NAMES]; // beat, time and the like, for programs
    double numbers[PICTURE_NAMES];
    uint32_t name_count;
    uint64_t serial; // no other picture has this number
    const AutoPicture *automatic;
    double width; // in the script's units
    double height;
    double detail;    // pixels per unit of the pictures that are made
    bool opaque;      // nothing is transparent: black where nothing is drawn
    FileAccess reach; // of the files that it names
    size_t memory;    // bytes that drawing it may take, those included that the painter keeps
    uint64_t work;    // units that the frame may take (budget.h), of which drawing has a share of its own
} CanvasPicture;

typedef enum CanvasFormat { CANVAS_PNG, CANVAS_SVG, CANVAS_PDF, CANVAS_JPEG } CanvasFormat;

// A `!record` node, and what goes into its file.
typedef struct Recorded {
    const DrawNode *node;
    const DrawNode *direct; // the canvas that is all of it; or NULL
    Texture *texture;       // an sRGB picture
} Recorded;

// Makes the tree of pictures if that is needed, once for each picture: then the painter has its records.
PetriStatus draw_render(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults);
// What was made of the picture's window; NULL: nothing, or it is drawn otherwise.
const Texture *draw_rendered(const PetriPainter *painter, const CanvasPicture *picture);
// How much larger width x height are drawn so that they fill a box, keeping their proportions, and where in it.
double draw_fit(double width, double height, double box_width, double box_height, double *left, double *top);
// Draws into premultiplied ARGB32 pixels. Whatever is wrong is reported to `faults`; after PETRI_INVALID one of them
// is an error.
PetriStatus draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width, int height,
                        size_t stride, DiagSink *faults);
// The bytes of a file that shows the picture, width x height pixels large.
PetriStatus draw_encode(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width, int height,
                        Encoded *out, DiagSink *faults);
// The records of the picture that was made last; none if it was another one.
const Recorded *draw_records(const PetriPainter *painter, const CanvasPicture *picture, uint32_t *count);
// The bytes of the file of one of them.
PetriStatus draw_encode_record(PetriPainter *painter, const CanvasPicture *picture, const Recorded *record,
                               CanvasFormat format, Encoded *out, DiagSink *faults);

#endif
