// resize.h: resizing of images (spec pictures.md 5.1).
#pragma once

#include "picture/texture.h"

#include <stddef.h>

// Resizes and flips premultiplied ARGB32 pixels; if `alpha` is false, all pixels are treated as opaque. Uses a triangle
// filter on colours that are not premultiplied. `flip` is FLIP_NOT and so on. Returns NULL if out of memory.
Texture *resize_pixels(Budget *budget, const uint32_t *pixels, int width, int height, size_t stride, bool alpha,
                       int new_width, int new_height, int flip);
