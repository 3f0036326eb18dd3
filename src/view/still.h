// still.h: writes the picture of a session's last frame to a terminal as text.
#ifndef PETRI_SRC_STILL_H
#define PETRI_SRC_STILL_H

#include "petri-draw.h"

// Writes the picture and a newline, as large as fits above `below` free rows. Drawing diagnostics go to the session's
// callback. Without `colour` it is black and white. Returns a status as petri_picture does, and PETRI_OUT_OF_MEMORY
// also without libchafa.
PetriStatus still_show(PetriSession *session, PetriPainter *painter, bool colour, int below, PetriWriteCallback *write,
                       void *user_data);

// Writes opaque pixels to standard output, a terminal, as a picture above `below` free lines. Returns false if out of
// memory or without libchafa.
bool still_show_pixels(const uint32_t *pixels, int width, int height, bool colour, int below);

#endif
