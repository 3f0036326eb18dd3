// paint.h: drawings become pixels and files. What draws is Cairo; without it everything here says PETRI_MISSING.
//
// A picture is plain data that nobody changes while it is drawn. A painter holds what is worth keeping from picture to
// picture: fonts and images. Both are used by one thread at a time; there is nothing global.
#ifndef PETRI_DRAW_PAINT_H
#define PETRI_DRAW_PAINT_H

#include "petri-draw.h"

#include "base/diag.h"
#include "base/reach.h"
#include "canvas/drawing.h"
#include "draw/automatic.h"

// One of `window` and `automatic` is there.
typedef struct CanvasPicture {
    const DrawNode *window;
    const AutoPicture *automatic;
    double width; // in the script's units
    double height;
    bool opaque; // nothing is transparent: black where nothing is drawn
    Reach reach; // of the files that it names
} CanvasPicture;

typedef enum CanvasFormat { CANVAS_PNG, CANVAS_SVG, CANVAS_PDF, CANVAS_FORMAT_COUNT } CanvasFormat;

// Draws into premultiplied ARGB32 pixels. Whatever is wrong is reported to `faults`; after PETRI_INVALID one of them
// is an error.
PetriStatus draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width, int height,
                        size_t stride, DiagSink *faults);
// The bytes of a file that shows the picture, width x height pixels large, in the arena.
PetriStatus draw_encode(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width, int height,
                        Arena *arena, Str *bytes, DiagSink *faults);

#endif
