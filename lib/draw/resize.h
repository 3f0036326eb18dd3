// resize.h: images of another size (spec pictures.md 5.1).
#ifndef PETRI_DRAW_RESIZE_H
#define PETRI_DRAW_RESIZE_H

#include "draw/texture.h"

#include <stddef.h>

// A copy of premultiplied ARGB32 pixels (without `alpha`: opaque) in another size, by a triangle filter on colours that
// are not multiplied; then turned over (FLIP_NOT …). NULL if memory is used up.
Texture *resize_pixels(Budget *meter, const uint32_t *pixels, int width, int height, size_t stride, bool alpha,
                       int new_width, int new_height, int flip);

#endif
