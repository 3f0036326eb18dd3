// filters.h: filters of display lists, which are applied to float images (spec canvas.md 6).
#pragma once

#include "picture/display_list.h"
#include "picture/float_image.h"

// The requirements of a filter.
typedef struct FilterNeeds {
    double margin;   // number of pixels by which the image must extend beyond the visible area
    double work;     // time in nanoseconds per pixel of the image
    bool everywhere; // true if the filter changes transparent pixels
} FilterNeeds;

// A filter of a display list, and what it is applied to. The numbers can come from a host, so they are checked.
typedef struct FilterTask {
    DisplayReader reader;        // the caller sets `failed` to make filter_apply stop
    const DisplayMatrix *matrix; // maps the lengths of the filter to pixels
    FloatImagePool *pool;
    const FloatImage *drawn; // the unfiltered drawing
    // Returns a new image of the size of `drawn`, filled with the paint that the commands set.
    FloatImage (*paint)(void *context, DisplayNumbers commands);
    // Called if the radius of the filter at `filter` exceeds FLOAT_IMAGE_MAX_SIGMA. NULL: not called.
    void (*exceeds)(void *context, const double *filter);
    void *context;
    int depth; // initially 0
} FilterTask;

// Returns the needs of a filter and of those inside it.
FilterNeeds filter_measure(FilterTask *task);
// Returns the result of a filter as a new image.
FloatImage filter_apply(FilterTask *task);
