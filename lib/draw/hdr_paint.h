// hdr_paint.h: what is painted on canvases whose light does not end at 1, as numbers: colours, gradients, mixtures of
// them, and images (spec canvas.md 5, 8.2).
#ifndef PETRI_DRAW_HDR_PAINT_H
#define PETRI_DRAW_HDR_PAINT_H

#include "draw/draw.h"

typedef struct HdrPaint {
    const DisplayList *list;
    uint32_t source;         // in the list; or
    const Texture *texture;  // a picture in memory, of a node; or
    cairo_surface_t *file;   // of 32 bits, encoded
    bool repeats;            // the pixels do
    cairo_matrix_t to_units; // from the target
    float alpha;
} HdrPaint;

// A source of the list in the matrix that is in force. False if it is of a kind that Cairo makes, or there is no image.
bool hdr_paint_from_source(Canvas *canvas, uint32_t source, double alpha, HdrPaint *shade);
// The colour at a point of the target, multiplied by alpha.
void hdr_paint_at(const HdrPaint *shade, double x, double y, float color[4]);

#endif
