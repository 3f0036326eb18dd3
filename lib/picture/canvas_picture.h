// canvas_picture.h: the content of a picture, as plain data that is not modified while it is drawn.
#pragma once

#include "base/diag.h"
#include "base/file_access.h"
#include "canvas/drawing.h"
#include "petri-draw.h"
#include "picture/automatic.h"
#include "picture/texture.h"

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
