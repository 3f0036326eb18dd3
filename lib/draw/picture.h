// picture.h: a picture: a copy of the visible nodes of a frame (picture.c), ready to be drawn (painter.c).
#pragma once

#include "draw/cairo_canvas.h"

struct PetriPicture {
    Arena arena; // holds all other data
    CanvasPicture picture;
    AutoPicture automatic;
    int width; // size in pixels
    int height;
    int64_t frame;
    const char *title;
    uint64_t work;   // units of work of petri_picture_render that petri_picture_report has not added to the session
    DiagSink faults; // diagnostics reported so far while the picture was drawn
};

// Returns true if this size in pixels is allowed for a picture.
static inline bool picture_is_good_size(double width, double height) {
    return width >= 1 && height >= 1 && width <= PETRI_MAX_PICTURE_SIDE && height <= PETRI_MAX_PICTURE_SIDE;
}
