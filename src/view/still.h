// still.h: the picture of a session's last frame as text for the terminal that standard output is.
#ifndef PETRI_SRC_STILL_H
#define PETRI_SRC_STILL_H

#include "petri-draw.h"

// Writes it, and a newline, as large as leaves `below` rows for what comes after it; what drawing tells goes to the
// session's callback. Without colour: in black and white. PETRI_OUT_OF_MEMORY also without libchafa; else as
// petri_picture.
PetriStatus still_show(PetriSession *session, PetriPainter *painter, bool colour, int below, PetriWriteCallback *write,
                       void *user_data);

// Writes opaque pixels to standard output, a terminal, as a picture that leaves `below` lines free. False if out of
// memory, or without libchafa.
bool still_show_pixels(const uint32_t *pixels, int width, int height, bool colour, int below);

#endif
