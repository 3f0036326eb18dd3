// filters.h: filters of float images (spec canvas.md 6).
#pragma once

#include "picture/display_list.h"
#include "picture/float_image.h"

// The requirements of a filter.
typedef struct FilterNeeds {
    double margin;   // number of pixels by which the image must extend beyond the visible area
    double work;     // time in nanoseconds per pixel of the image
    bool everywhere; // true if the filter changes transparent pixels
} FilterNeeds;

// These functions do not look at the inputs of the filter. `table` has its 20 matrix elements or 4 factors; NULL: none.
// `m` maps the lengths of the filter to pixels.
void filter_add_needs(const DisplayFilter *filter, const double *table, const DisplayMatrix *m, FilterNeeds *needs);
// Stores the radii of the filter in pixels.
void filter_radius(const DisplayFilter *filter, const DisplayMatrix *m, double radius[2]);
// Applies a filter, except FILTER_PAINT, to the result of its first input. `other` is that of the second; NULL: none.
void filter_apply(FloatImagePool *pool, const DisplayFilter *filter, const double *table, const DisplayMatrix *m,
                  FloatImage *image, const FloatImage *other);
