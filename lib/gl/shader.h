// shader.h: custom shaders of scripts (spec pictures.md 8), and the functions that they share with effects.
#pragma once

#include "gl/effect.h"

#include <string.h>

// Returns true if the node has a shader of the script.
static inline bool gl_has_shader(const DrawNode *node) {
    return draw_attr(node, ATTR_FRAGMENT) || draw_attr(node, ATTR_VERTEX);
}
// Returns how many times the node's shader runs.
uint32_t gl_shader_passes(const DrawNode *node);
// Runs the shaders in the attributes `fragment` and `vertex`.
GlImage gl_shader(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *faults);

// effect.c
typedef struct GlPass {
    unsigned program;
    bool reduced; // true if the pass renders to a target that is smaller by the factor `downsample` in each direction
} GlPass;
// Runs the passes in order and stores the result of the last pass in *out. Returns false if the GPU is out of memory.
bool gl_run_passes(Gl *gl, const GlEffect *effect, const GlPass *passes, uint32_t count, GlImage *out);
int gl_downsample(const DrawNode *node);
void gl_report(DiagSink *faults, const DrawNode *node, const char *code, Str problem);
