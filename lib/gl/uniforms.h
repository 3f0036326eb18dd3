// uniforms.h: sets the uniforms of shaders by name (spec pictures.md 8.3).
#ifndef PETRI_GL_UNIFORMS_H
#define PETRI_GL_UNIFORMS_H

#include "gl/effect.h"

// The state of a pass that is about to run.
typedef struct GlState {
    const GlEffect *effect;
    GlImage first; // result of pass 0; texture 0 during pass 0
    GlImage last;  // result of the previous pass, or of the previous frame in pass 0
    GlImage target;
    int pass;
    int passes;
    int downsample; // of this pass
} GlState;

void gl_set_uniforms(const Gl *gl, unsigned program, const GlState *state);

#endif
