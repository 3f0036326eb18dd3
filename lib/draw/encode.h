// encode.h: files of pixels.
#ifndef PETRI_DRAW_ENCODE_H
#define PETRI_DRAW_ENCODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The bytes of a file, on the heap: Cairo and libpng are in the middle of their work when memory is used up, and must
// not be left by a jump. `bytes` is to be freed by whoever has it, even after a failure.
typedef struct Encoded {
    unsigned char *bytes;
    size_t length, capacity;
} Encoded;

// False if memory is used up; then nothing has changed.
bool encode_add(Encoded *out, const void *bytes, size_t length);

// Adds the bytes of a PNG or JPEG file. Colours are written as they are, so multiplied by alpha; without `alpha` that
// is the picture over black. False if memory is used up or the library refuses.
bool encode_png_pixels(Encoded *out, const uint32_t *pixels, int width, int height, bool alpha);
bool encode_jpeg_pixels(Encoded *out, const uint32_t *pixels, int width, int height, int quality);

#endif
