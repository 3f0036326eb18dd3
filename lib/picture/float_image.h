// float_image.h: floating-point images, for filters and for canvases of more than 8 bits per channel.
#pragma once

#include "base/budget.h"
#include "schema/table.h"

enum { FLOAT_IMAGE_MAX_SIGMA = 256 }; // maximum standard deviation of a blur, in pixels

// An image of floats: premultiplied red, green, blue and alpha, rows from the top. Values range from 0 to 1, except
// that colours on HDR canvases (more than 8 bits per channel) can exceed 1.
typedef struct FloatImage {
    int width;
    int height;
    float *pixels; // NULL: empty image
    int x;         // if the image is `hdr_target`: position of its top left corner on the target
    int y;
} FloatImage;

typedef struct FloatImageMemory FloatImageMemory; // float_image.c

// The memory of a drawing's float images.
typedef struct FloatImagePool {
    Budget *budget;           // what memory is charged to
    size_t charged;           // bytes charged to the budget, which may include other memory
    FloatImageMemory *images; // all allocated images
} FloatImagePool;

// Charges memory to the pool's budget. Returns false, and charges nothing, if that would exceed the limit.
bool float_image_reserve(FloatImagePool *pool, size_t bytes);
void float_image_release(FloatImagePool *pool, size_t bytes);
// Returns a cleared image. `pixels` is NULL if out of memory; all operations ignore such images.
FloatImage float_image_new(FloatImagePool *pool, int width, int height);
void float_image_free(FloatImagePool *pool, FloatImage *image);
// Frees the images that are left, and releases all memory that is charged.
void float_image_free_all(FloatImagePool *pool);
FloatImage float_image_copy(FloatImagePool *pool, const FloatImage *image);

// Convert from and to premultiplied ARGB32 pixels, rows without gaps.
FloatImage float_image_read(FloatImagePool *pool, const uint32_t *pixels, int width, int height);
void float_image_write(const FloatImage *image, uint32_t *pixels);

// Modify the image in place. Lengths are in pixels. Large lengths hardly increase the cost.
void float_image_blur(FloatImagePool *pool, FloatImage *image, const double sigma[2]);
void float_image_morphology(FloatImagePool *pool, FloatImage *image, const double radius[2], bool erode);
void float_image_move(FloatImagePool *pool, FloatImage *image, double dx, double dy);
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
