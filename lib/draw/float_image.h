// float_image.h: pixels as numbers, for what Cairo does not do: filters, canvases of more than 8 bits.
#ifndef PETRI_DRAW_FLOAT_IMAGE_H
#define PETRI_DRAW_FLOAT_IMAGE_H

#include "draw/draw.h"

enum { FLOAT_IMAGE_MAX_SIGMA = 256 }; // standard deviation of a blur, pixels

// A cleared one, charged to the picture's memory. Without memory, and of what has none, `pixels` is NULL; what follows
// then does nothing. What is not freed is freed when the drawing ends.
FloatImage float_image_new(Canvas *canvas, int width, int height);
void float_image_free(Canvas *canvas, FloatImage *image);
void float_image_free_all(Canvas *canvas);
FloatImage float_image_copy(Canvas *canvas, const FloatImage *image);

// From and to ARGB32 pixels.
FloatImage float_image_read(Canvas *canvas, cairo_surface_t *surface);
void float_image_write(const FloatImage *image, cairo_surface_t *surface);

// In place; lengths in pixels. What they cost does not grow with them.
void float_image_blur(Canvas *canvas, FloatImage *image, const double sigma[2]);
void float_image_morphology(Canvas *canvas, FloatImage *image, const double radius[2], bool erode);
void float_image_move(Canvas *canvas, FloatImage *image, double dx, double dy);
// Gives all of it one colour, and leaves its alpha, times that of the colour.
void float_image_tint(FloatImage *image, const double color[4]);
void float_image_composite_over(FloatImage *below, const FloatImage *above);
void float_image_fill(FloatImage *image, const double color[4]);
// Four rows of five numbers, on colours that are not multiplied by alpha.
void float_image_recolor(FloatImage *image, const double *matrix);
// k: of the product, of s, of d, and what is added. Without k the mode counts. Into d.
void float_image_combine(FloatImage *d, const FloatImage *s, const double *k, CompositeMode mode);

#endif
