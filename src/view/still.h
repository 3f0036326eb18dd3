// still.h: writes the picture of a session's last frame to a terminal as text.
#pragma once

#include "petri-draw.h"

// Writes the picture and a newline. The picture is as large as possible, but leaves `below` rows of the terminal free.
// Drawing diagnostics go to the session's callback. If `colour` is false, the picture is black and white. Returns the
// status of petri_picture, or PETRI_OUT_OF_MEMORY if petri was built without libchafa.
PetriStatus still_show(PetriSession *session, PetriPainter *painter, bool colour, int below, PetriWriteCallback *write,
                       void *user_data);

// Writes opaque pixels as a picture to standard output, which must be a terminal. Leaves `below` rows free.
// Returns false if out of memory or if petri was built without libchafa.
bool still_show_pixels(const uint32_t *pixels, int width, int height, bool colour, int below);
