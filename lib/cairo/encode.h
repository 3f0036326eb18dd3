// encode.h: encoders for PNG and JPEG files.
#pragma once

#include "picture/backend.h"

// Appends bytes. Returns false, and changes nothing, if out of memory.
bool encode_add(Encoded *out, const void *bytes, size_t length);

// Appends a PNG or JPEG file. Colours are not unpremultiplied. If `alpha` is false, alpha is not written, so the file
// shows the picture over black. Returns false if out of memory or if the library fails.
bool encode_png_pixels(Encoded *out, const uint32_t *pixels, int width, int height, bool alpha);
bool encode_jpeg_pixels(Encoded *out, const uint32_t *pixels, int width, int height, int quality);
