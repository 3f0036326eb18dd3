// overlay.h: draws the text over a picture into pixels: by petri itself, as one more scene.
#ifndef PETRI_SRC_OVERLAY_H
#define PETRI_SRC_OVERLAY_H

#include <stdint.h>

#include "view/overlay_text.h"

// Draws overlays; keeps what it has drawn while the texts stay the same.
typedef struct OverlayPainter OverlayPainter;

// NULL if memory is used up.
OverlayPainter *overlay_painter_new(void);
// NULL is fine.
void overlay_painter_free(OverlayPainter *painter);
// Draws over width x height opaque pixels (as petri_picture_draw has them); `scale` is the number of pixels for each
// unit of text sizes. What cannot be drawn is left out.
void overlay_draw(OverlayPainter *painter, const Overlay *overlay, double scale, uint32_t *pixels, int width,
                  int height);

#endif
