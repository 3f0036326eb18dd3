// texture.h: pictures of a render graph (spec pictures.md 1): premultiplied red, green, blue and alpha.
#pragma once

#include "gl/gl.h"

// A picture in one or more of three forms: `bytes`, `linear` and, on the GPU, `image`. Its content is immutable;
// several nodes and frames can hold references.
typedef struct Texture {
    uint32_t references;
    int width;
    int height;
    uint32_t *bytes; // sRGB picture: ARGB32 as in Cairo, rows from the top
    float *linear;   // linear light: r, g, b, a, rows from the top
    GlImage image;
    Gl *gl;         // context of `image`; NULL: not on the GPU
    Budget *budget; // charged for the memory of the picture
    size_t charged;
} Texture;

// Returns a cleared picture with one reference; NULL if out of memory. The budget must outlive the picture.
Texture *texture_new(Budget *budget, int width, int height, bool linear);
// Creates a picture that exists only on the GPU and owns the image. If out of memory, frees the image and returns NULL.
Texture *texture_from_image(Budget *budget, Gl *gl, GlImage image);
// Ensures that the picture is on the GPU, whose context must be current. Returns false if out of memory.
bool texture_upload(Gl *gl, Texture *texture);
// Ensures that the picture is in memory: an sRGB picture in `bytes`, a linear picture in `linear`. Returns false if out
// of memory.
bool texture_download(Gl *gl, Texture *texture);
Texture *texture_retain(Texture *texture);
// Drops a reference; NULL is ignored. If the picture is on the GPU, the GPU context must be current.
void texture_free(Texture *texture);

// Returns the byte round(255 enc(c)) of a linear value c (pictures.md 1.4).
unsigned texture_encode(float c);
// Returns 256 thresholds: for each byte, the smallest linear value that texture_encode maps to a larger byte.
const float *texture_thresholds(void);
// Returns the linear value lin(byte/255) (pictures.md 1.4).
float texture_decode(unsigned byte);

// Returns a premultiplied byte divided by its alpha.
unsigned texture_unpremultiply(unsigned byte, unsigned alpha);

// Writes a row as ARGB32 pixels. If `opaque`, the picture is composited over black. Otherwise, linear colours are
// unpremultiplied, encoded and premultiplied again.
void texture_row(const Texture *texture, int y, bool opaque, uint32_t *row);

// Like texture_row, but the result is linear light in bytes. sRGB values are decoded without unpremultiplying them.
void texture_linear_row(const Texture *texture, int y, uint32_t *row);
// Converts a pixel of an image file from sRGB to linear light. Unpremultiplies it before decoding.
uint32_t texture_linear_pixel(uint32_t pixel);
// Convert a picture whose `bytes` hold linear light, instead of sRGB. The first function writes floats to `linear`. The
// second returns a new linear picture, or NULL if out of memory.
void texture_copy_linear(const Texture *bytes, float *linear);
Texture *texture_from_linear_bytes(Budget *budget, const Texture *bytes);

// How a picture is sampled between its pixels and beyond its edges (pictures.md 1.5).
typedef struct Sampler {
    float border[4];
    bool repeat[2];
    bool clamped; // true: the edge pixels continue beyond the edges, and `border` and `repeat` are not used
    bool nearest;
} Sampler;
// Computes the colour at u, v. u runs from 0 to 1 from left to right, v from top to bottom.
void texture_sample(const Texture *texture, const Sampler *sampler, double u, double v, float color[4]);
