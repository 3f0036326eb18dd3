// float_image.h: floating-point images, for filters and for canvases of more than 8 bits per channel.
#pragma once

#include "draw/draw.h"

enum { FLOAT_IMAGE_MAX_SIGMA = 256 }; // maximum standard deviation of a blur, in pixels

// Returns a cleared image, charged to the picture's memory. `pixels` is NULL if out of memory; all operations ignore
// such images. When the drawing ends, draw_close frees the images that are left.
FloatImage float_image_new(Canvas *canvas, int width, int height);
void float_image_free(Canvas *canvas, FloatImage *image);
void float_image_free_all(Canvas *canvas);
FloatImage float_image_copy(Canvas *canvas, const FloatImage *image);

// Convert from and to ARGB32 pixels.
FloatImage float_image_read(Canvas *canvas, cairo_surface_t *surface);
void float_image_write(const FloatImage *image, cairo_surface_t *surface);

// Modify the image in place. Lengths are in pixels. Large lengths hardly increase the cost.
void float_image_blur(Canvas *canvas, FloatImage *image, const double sigma[2]);
void float_image_morphology(Canvas *canvas, FloatImage *image, const double radius[2], bool erode);
void float_image_move(Canvas *canvas, FloatImage *image, double dx, double dy);
// Replaces the colour of all pixels, but keeps the shape: the alpha of each pixel is multiplied by the alpha of
// `color`.
void float_image_tint(FloatImage *image, const double color[4]);
void float_image_composite_over(FloatImage *below, const FloatImage *above);
void float_image_fill(FloatImage *image, const double color[4]);
// Applies a colour matrix, four rows of five numbers, to colours that are not premultiplied.
void float_image_recolor(FloatImage *image, const double *matrix);
// Combines s with d and stores the result in d: k[0] s d + k[1] s + k[2] d + k[3]. If k is NULL, composites s onto d
// with `mode` instead.
void float_image_combine(FloatImage *d, const FloatImage *s, const double *k, CompositeMode mode);
