// cairo_canvas.h: drawing of pictures to pixels and files with Cairo. Builds without Cairo can draw only to pixels, and
// only if the host provides a backend (no_cairo.c). In all other cases, these functions return PETRI_UNSUPPORTED.
//
// A picture is plain data and is not modified while it is drawn. A painter caches fonts and images between pictures.
// A picture or painter must be used by only one thread at a time. There is no global state.
#pragma once

#include "base/diag.h"
#include "base/file_access.h"
#include "canvas/drawing.h"
#include "draw/automatic.h"
#include "draw/encode.h"
#include "draw/texture.h"
#include "petri-draw.h"

enum { PICTURE_NAMES = 64 };

// Exactly one of `window` and `automatic` is set.
typedef struct CanvasPicture {
    const DrawNode *const *tops; // all windows of the frame
    uint32_t top_count;
    const DrawNode *window; // the window to show; NULL: none
    const DrawNode *direct; // the window's only canvas, if it fills the window; NULL: the window must be composited
    bool needs_history;     // true if a window refers to earlier frames
    double beat;
    // Names of global values that shaders can use, such as beat and time. `numbers` holds the values.
    const char *names[PICTURE_NAMES];
    double numbers[PICTURE_NAMES];
    uint32_t name_count;
    uint64_t serial; // unique number of the picture
    int64_t frame;   // number of the frame
    const AutoPicture *automatic;
    double width; // size in the script's units
    double height;
    double detail;         // pixels per unit of pictures in the render graph
    bool opaque;           // true for a black background, false for a transparent one
    FileAccess reach;      // which files the script is allowed to read and write
    size_t memory;         // limit in bytes, including what the painter caches
    size_t session_memory; // the session's limit, of which the session uses a part
    uint64_t work;         // work limit of a frame (budget.h); the separate limit for drawing is computed from it
} CanvasPicture;

typedef enum CanvasFormat { CANVAS_PNG, CANVAS_SVG, CANVAS_PDF, CANVAS_JPEG } CanvasFormat;

// A `!record` node and the picture that is written to its file.
typedef struct Recorded {
    const DrawNode *node;
    const DrawNode *direct; // the record's only canvas, if it fills the picture; NULL: the picture must be composited
    Texture *texture;       // an sRGB picture
} Recorded;

// Renders the render graph of a picture, unless the painter has already done so. After that, draw_records returns the
// picture's records.
PetriStatus draw_render(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults);
// Returns the rendered picture of the window. Returns NULL if there is none, or if the window's canvas is drawn
// directly.
const Texture *draw_rendered(const PetriPainter *painter, const CanvasPicture *picture);
// Returns the scale at which width x height fits into a box without changing its aspect ratio. *left and *top receive
// the offset that centres the scaled area in the box.
double draw_fit(double width, double height, double box_width, double box_height, double *left, double *top);
// Draws the picture into premultiplied ARGB32 pixels. Problems are reported to `faults`. If the result is
// PETRI_INVALID, at least one of the reports is an error.
PetriStatus draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width, int height,
                        size_t stride, DiagSink *faults);
// Encodes a file that shows the picture at width x height pixels.
PetriStatus draw_encode(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width, int height,
                        Encoded *out, DiagSink *faults);
// Returns the records of `picture`. If another picture was rendered after it, or none, *count is 0.
const Recorded *draw_records(const PetriPainter *painter, const CanvasPicture *picture, uint32_t *count);
// Encodes the file of one record.
PetriStatus draw_encode_record(PetriPainter *painter, const CanvasPicture *picture, const Recorded *record,
                               CanvasFormat format, Encoded *out, DiagSink *faults);
