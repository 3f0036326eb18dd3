// hdr_paint.h: paint sources of HDR canvases, computed in floats: colours, gradients, blends and images (spec canvas.md
// 5, 8.2).
#pragma once

#include "cairo/canvas.h"

typedef struct HdrPaint {
    const double *source;    // the paint in the list; not used if `texture` or `file` is set
    const Texture *texture;  // the rendered picture of a node
    cairo_surface_t *file;   // an image file; 32-bit sRGB pixels
    bool repeats;            // true if the image is repeated beyond its edges
    cairo_matrix_t to_units; // maps target pixels to the units of the source, or to the pixels of its image
    float alpha;
} HdrPaint;

// Fills *shade with a paint of the list, placed by the current transform. Returns false if Cairo must render this kind
// of paint, or if the image of the paint does not exist.
bool hdr_paint_from_source(Canvas *canvas, const double *source, double alpha, HdrPaint *shade);
// Returns the premultiplied colour at a point of the target.
void hdr_paint_at(const HdrPaint *shade, double x, double y, float color[4]);
