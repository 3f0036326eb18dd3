// hdr_composite.h: canvases whose light does not end at 1 (spec canvas.md 1.5): Cairo makes figures, of 8 bits; colours
// are made (hdr_paint.h) and combined here, as numbers.
#ifndef PETRI_DRAW_HDR_COMPOSITE_H
#define PETRI_DRAW_HDR_COMPOSITE_H

#include "draw/float_image.h"
#include "draw/hdr_paint.h"

// Draws the current path; an image within the clip; a sheet at x, y of the target, within
// it.
void hdr_draw_path(Canvas *canvas, const DisplayCommand *command, const DisplayPaint *paint);
void hdr_draw_image(Canvas *canvas, const DisplayPaint *paint, const HdrPaint *image);
void hdr_composite(Canvas *canvas, const FloatImage *image, double x, double y, int composite);
// Begins a layer; what was there before. Lays it over that.
FloatImage hdr_begin_layer(Canvas *canvas);
void hdr_end_layer(Canvas *canvas, FloatImage below, double alpha);

#endif
