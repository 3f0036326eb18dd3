// hdr_composite.h: HDR canvases, which have more than 8 bits per channel (spec canvas.md 1.5). Cairo renders only 8-bit
// coverage masks; hdr_paint.h computes colours, and this file composites them as linear floats.
#pragma once

#include "cairo/hdr_paint.h"
#include "picture/float_image.h"

// These functions draw onto the target within the clip: the current path, an image, or a float image at x, y.
void hdr_draw_path(Canvas *canvas, const PATHOperands *shape, const DisplayPaint *paint);
void hdr_draw_image(Canvas *canvas, const DisplayPaint *paint, const HdrPaint *image);
void hdr_composite(Canvas *canvas, const FloatImage *image, double x, double y, int composite);
// Begins a layer and returns the image below it. hdr_end_layer composites the layer over that image.
FloatImage hdr_begin_layer(Canvas *canvas);
void hdr_end_layer(Canvas *canvas, FloatImage below, double alpha);
