// picture.h: a picture as its two halves share it: making it and drawing it. The drawing is apart because it needs the
// libraries that draw: a program that only makes frames links without them.
#ifndef PETRI_SESSION_PICTURE_H
#define PETRI_SESSION_PICTURE_H

#include "session/session.h"

#include "draw/paint.h"

struct PetriPicture {
    Arena arena; // all that follows
    CanvasPicture picture;
    AutoPicture automatic;
    int width; // in pixels
    int height;
    int64_t frame;
    const char *title;
    const char **records;
    uint32_t record_count;
    DiagSink faults; // found since, by whoever draws
};

// Can a picture have so many pixels?
static inline bool picture_is_good_size(double width, double height) {
    return width >= 1 && height >= 1 && width <= PETRI_MOST_PIXELS && height <= PETRI_MOST_PIXELS;
}

#endif
