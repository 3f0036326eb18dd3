// effect.h: program nodes: what turns the pictures inside a node into its own (spec pictures.md 3, 6, 7).
#ifndef PETRI_GL_EFFECT_H
#define PETRI_GL_EFFECT_H

#include "canvas/drawing.h"
#include "gl/gl.h"

// What a program may know of the frame.
typedef struct GlFrame {
    double beats;             // since the node's frame before; 0 in its first
    const char *const *names; // of numbers: beat, time, …, and what was defined
    const double *numbers;
    uint32_t name_count;
} GlFrame;

typedef struct GlEffect {
    const DrawNode *node;
    const GlImage *inputs;
    uint32_t count;
    GlImage last; // the node's picture of the frame before; texture 0: none
    int width;    // in pixels
    int height;
    double detail; // pixels per unit of the node's attributes
    GlFormat format;
    const GlFrame *frame;
} GlEffect;

// Runs a node's program. The picture is the caller's; texture 0, after a report, if there is none.
GlImage gl_effect(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *faults);

#endif
