// layer_composite.h: pictures laid over each other, without a program of the GPU (spec pictures.md 3.5, 3.6).
#ifndef PETRI_DRAW_LAYER_COMPOSITE_H
#define PETRI_DRAW_LAYER_COMPOSITE_H

#include "draw/texture.h"

typedef struct LayerComposite {
    Texture *const *inputs;
    uint32_t count;
    int width; // of the result
    int height;
    int how; // MIX_OVER …
    float alpha;
    Sampler sampler;
    int bits;  // 8, 16, 32
    bool srgb; // of 8 bits, encoded
    Budget *meter;
} LayerComposite;

// A new picture, or another reference to the only input if that is what would come out. NULL if memory is used up.
Texture *layer_composite(const LayerComposite *mix);

#endif
