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

void gl_set_uniforms(const Gl *gl, unsigned program, const GlState *state);
