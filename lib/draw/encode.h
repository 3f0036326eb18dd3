// encode.h: files of pixels.
#ifndef PETRI_DRAW_ENCODE_H
#define PETRI_DRAW_ENCODE_H

#include "base/str.h"

#include <stdint.h>

// Adds the bytes of a PNG or JPEG file. Colours are written as they are, so multiplied by alpha; without `alpha` that
// is the picture over black. False if memory is used up or the library refuses.
bool encode_png_pixels(Text *out, const uint32_t *pixels, int width, int height, bool alpha);
bool encode_jpeg_pixels(Text *out, const uint32_t *pixels, int width, int height, int quality);

#endif
