// backend.h: the functions that draw canvases, as a table. Cairo or a host (host_backend.c) fills it.
#pragma once

#include "picture/canvas_picture.h"

// The bytes of an encoded file, on the heap. They are not in an arena: if out of memory, an arena calls longjmp, which
// must not skip stack frames of Cairo or libpng. The owner frees `bytes`, even after a failure.
typedef struct Encoded {
    unsigned char *bytes;
    size_t length, capacity;
} Encoded;

// The pixels of an image file: premultiplied ARGB32, rows of `stride` bytes. They are borrowed from the backend.
typedef struct ImagePixels {
    const uint32_t *pixels;
    int width;
    int height;
    size_t stride;
    bool alpha; // false: all pixels are opaque, whatever their alpha
} ImagePixels;

enum { MAX_TEXT_LENGTH = 10000, MAX_FONT_SIZE = 4000 }; // maximum length of a text in bytes, and font size in pixels

// The style of a text that is measured, with the defaults filled in. `family` is a list of names, separated by commas.
typedef struct TextStyle {
    double size;
    double weight;
    int width;
    int slant;
    char family[1000];
} TextStyle;

// Functions that a backend lacks are NULL. Those that return a status return PETRI_OK, PETRI_INVALID after an error was
// reported, or PETRI_OUT_OF_MEMORY.
typedef struct CanvasBackend {
    // Draws a canvas of width x height units into a cleared sRGB or linear picture. The canvas is scaled to fill the
    // picture.
    PetriStatus (*draw_canvas)(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, int width,
                               int height, Texture *texture, DiagSink *diags);
    // Draws the picture into cleared pixels, scaled to fit and centred: `shown`, the rendered picture of its window, or
    // if that is NULL, its direct canvas or automatic picture.
    PetriStatus (*draw_pixels)(PetriPainter *painter, const CanvasPicture *picture, const Texture *shown,
                               uint32_t *pixels, int width, int height, size_t stride, DiagSink *diags);
    // Finds the image file that an image node in the render graph names. If it cannot be read, reports this and returns
    // false.
    bool (*find_image)(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, ImagePixels *image,
                       DiagSink *diags);
    // Stores the width of a text. Returns NULL, or the reason why it cannot be measured. Sets *loaded to true if a font
    // was loaded for this.
    const char *(*measure_text)(PetriPainter *painter, Str text, const TextStyle *style, double *width, bool *loaded);
    // As petri_painter_draw_labels.
    PetriStatus (*draw_labels)(PetriPainter *painter, const PetriLabel *labels, size_t count, size_t size, double scale,
                               uint32_t *pixels, int width, int height, size_t stride);
    // Encodes a file that shows the picture, whose render graph is rendered, at width x height pixels.
    PetriStatus (*encode)(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width,
                          int height, Encoded *out, DiagSink *diags);
    // Encodes the file of one record.
    PetriStatus (*encode_record)(PetriPainter *painter, const CanvasPicture *picture, const Recorded *record,
                                 CanvasFormat format, Encoded *out, DiagSink *diags);
    // Frees what the backend keeps in the painter.
    void (*close)(PetriPainter *painter);
} CanvasBackend;
