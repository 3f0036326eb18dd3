// uniforms.h: what programs are told (spec pictures.md 8.3): each uniform that a program has is looked up by its name.
#ifndef PETRI_GL_UNIFORMS_H
#define PETRI_GL_UNIFORMS_H

#include "gl/effect.h"

// A pass that is about to be run.
typedef struct GlState {
    const GlEffect *effect;
    GlImage first; // result of pass 0; texture 0 during it
    GlImage last;  // of the pass before, or of the frame before
    GlImage target;
    int pass;
    int passes;
    int downsample; // of this pass
} GlState;

void gl_set_uniforms(const Gl *gl, unsigned program, const GlState *state);

#endif
