// texture.h: the pictures of which the tree of a frame is made (spec pictures.md 1): pixels of four channels, red,
// green and blue multiplied by alpha.
#ifndef PETRI_DRAW_TEXTURE_H
#define PETRI_DRAW_TEXTURE_H

#include "gl/gl.h"

// In one or several of three forms, `image` being that on the GPU. It never changes; several nodes and frames may hold
// it.
typedef struct Texture {
    uint32_t references;
    int width;
    int height;
    uint32_t *bytes; // an sRGB picture: ARGB32, rows from the top, as Cairo has it
    float *linear;   // linear light: r, g, b, a, rows from the top
    GlImage image;
    Gl *gl;        // of the image; NULL: there is none
    Budget *meter; // that what it takes in memory is charged to
    size_t charged;
} Texture;

// A cleared one, with one reference; NULL if memory is used up. The meter outlives it.
Texture *texture_new(Budget *meter, int width, int height, bool linear);
// One that is only on the GPU, and takes the image over; NULL if memory is used up.
Texture *texture_from_image(Budget *meter, Gl *gl, GlImage image);
// Sees to it that it is on the GPU, which is current; false if there is no room.
bool texture_upload(Gl *gl, Texture *texture);
// Sees to it that it is in memory; false if that is used up. For an sRGB picture `bytes`, else `linear`.
bool texture_download(Gl *gl, Texture *texture);
Texture *texture_retain(Texture *texture);
// Gives a reference back; NULL is fine. The GPU of one that has an image is current then.
void texture_free(Texture *texture);

// The byte round(255 enc(c)) of a linear c (pictures.md 1.4).
unsigned texture_encode(float c);
// For each byte the linear c from which on texture_encode gives a larger one; 256 of them.
const float *texture_thresholds(void);
// lin(byte/255).
float texture_decode(unsigned byte);

// A byte that was multiplied by its alpha, without it.
unsigned texture_unpremultiply(unsigned byte, unsigned alpha);

// A row as ARGB32 pixels. Of a picture that is shown opaquely, over black; otherwise a linear one is encoded without
// alpha, which then multiplies it again.
void texture_row(const Texture *texture, int y, bool opaque, uint32_t *row);

// The same as linear light, in bytes; and such a pixel of an sRGB one.
void texture_linear_row(const Texture *texture, int y, uint32_t *row);
uint32_t texture_linear_pixel(uint32_t pixel);
// Such pixels as numbers; and as a picture, NULL if memory is used up.
void texture_copy_linear(const Texture *bytes, float *linear);
Texture *texture_from_linear_bytes(Budget *meter, const Texture *bytes);

// How a picture is read beyond its edges, and between its pixels (pictures.md 1.5).
typedef struct Sampler {
    float border[4];
    bool repeat[2];
    bool clamped; // neither border nor repeat
    bool nearest;
} Sampler;
// The colour at u, v (from the top), 0 to 1 over the picture.
void texture_sample(const Texture *texture, const Sampler *sampler, double u, double v, float color[4]);

#endif
