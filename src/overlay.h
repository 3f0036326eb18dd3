// overlay.h: the text over a picture, and how it is drawn into pixels: by petri itself, as one more scene.
#ifndef PETRI_SRC_OVERLAY_H
#define PETRI_SRC_OVERLAY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Texts that are shown over a picture; empty ones are not. UTF-8 without control characters but newlines.
typedef struct Overlay {
    char status[400];   // frame rate and clocks, some lines
    char notice[400];   // what was done just now, one line
    char trouble[4000]; // what is wrong with the script, some lines
} Overlay;

// Sets one of them from any text: escape sequences and what is no UTF-8 are left out, tabs become blanks, and what does
// not fit is cut off. True if the text is another one than before.
bool overlay_set(char *text, size_t size, const char *from);

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
