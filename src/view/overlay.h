// overlay.h: draws the texts of an overlay over a picture.
#pragma once

#include "petri-draw.h"
#include "view/overlay_text.h"

// Draws the overlay on width x height opaque pixels in the format of petri_picture_draw. `scale` is the number of
// pixels per unit of text size. Labels that cannot be drawn are omitted.
void overlay_draw(PetriPainter *painter, const Overlay *overlay, double scale, uint32_t *pixels, int width, int height);

// Shows a picture (NULL: black) and the text over it in the painter's window (petri_painter_present).
PetriStatus overlay_show(PetriPainter *painter, PetriPicture *picture, const Overlay *overlay, double scale, int width,
                         int height);
