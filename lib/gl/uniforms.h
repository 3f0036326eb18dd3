// uniforms.h: sets the uniforms of shaders by name (spec pictures.md 8.3).
#pragma once

#include "gl/effect.h"

// The state of a pass that is about to run.
typedef struct GlState {
    const GlEffect *effect;
    GlImage first; // result of pass 0; during pass 0, its `texture` is 0
    GlImage last;  // result of the previous pass; during pass 0, the result of the previous frame
    GlImage target;
    int pass;
    int passes;
    int downsample; // factor by which the target of this pass is smaller; 1 if it is not reduced
} GlState;

// Sets a uniform of the current program, at a location and of a type that OpenGL has returned; `count` is the number of
// elements of an array. A list of matching length is used as it is. One number fills all elements, and a vector fills
// each element of an array. Other lists are treated as 0. Does nothing if the type is not supported.
void gl_set_uniform(int at, unsigned type, int count, const double *numbers, uint32_t length);
void gl_set_uniforms(const Gl *gl, unsigned program, const GlState *state);
