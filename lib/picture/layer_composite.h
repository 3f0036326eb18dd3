// layer_composite.h: compositing of pictures on the CPU, without shaders (spec pictures.md 3.5, 3.6).
#pragma once

#include "picture/texture.h"

typedef struct LayerComposite {
    Texture *const *inputs;
    uint32_t count;
    int width; // size of the result in pixels
    int height;
    int how; // composite operation, MIX_OVER and so on
    float alpha;
    Sampler sampler;
    int bits;  // bits per channel: 8, 16 or 32
    bool srgb; // true: the result has 8-bit sRGB channels, whatever `bits` is
    Budget *budget;
} LayerComposite;

// Returns an estimate of the time that layer_composite takes, in nanoseconds.
double layer_composite_cost(const LayerComposite *mix);
// Returns a new picture, or another reference to the only input if the result would equal that input. Returns NULL if
// out of memory.
Texture *layer_composite(const LayerComposite *mix);
