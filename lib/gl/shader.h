// shader.h: programs that scripts bring along (spec pictures.md 8), and what effects share with them.
#ifndef PETRI_GL_SHADER_H
#define PETRI_GL_SHADER_H

#include "gl/effect.h"

#include <string.h>

// Runs the program in the attributes `fragment` and `vertex`.
GlImage gl_shader(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *faults);

// effect.c
typedef struct GlPass {
    unsigned program;
    bool reduced; // its target is `downsample` times smaller
} GlPass;
// Runs passes one after the other; false if the GPU's memory is used up.
bool gl_run_passes(Gl *gl, const GlEffect *effect, const GlPass *passes, uint32_t count, GlImage *out);
int gl_downsample(const DrawNode *node);
void gl_report(DiagSink *faults, const DrawNode *node, const char *code, Str problem);

#endif
