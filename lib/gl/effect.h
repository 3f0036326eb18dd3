// effect.h: effect nodes, which process the pictures inside them on the GPU (spec pictures.md 3, 6, 7).
#pragma once

#include "canvas/drawing.h"
#include "gl/gl.h"

// The values of a frame that a shader can use.
typedef struct GlFrame {
    double beats;             // beats since the node's previous frame; 0 in its first frame
    const char *const *names; // names of the values in `numbers`: beat, time and so on, and the script's definitions
    const double *numbers;
    uint32_t name_count;
} GlFrame;

typedef struct GlEffect {
    const DrawNode *node;
    const GlImage *inputs;
    uint32_t count;
    GlImage last; // the node's picture in the previous frame; its `texture` is 0 if there is none
    int width;    // size of the result in pixels
    int height;
    double detail; // pixels per unit of the node's attributes
    GlFormat format;
    const GlFrame *frame;
} GlEffect;

// Returns an estimate of the time that gl_effect takes, in nanoseconds.
double gl_effect_cost(const GlEffect *effect);
// Runs the shader of a node. Returns the resulting picture, which the caller owns. On failure, reports the problem and
// returns an image with texture 0.
GlImage gl_effect(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *diags);
