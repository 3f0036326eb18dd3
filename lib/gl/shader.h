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
GlImage gl_shader(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *diags);

// Appends the source of a script's shader. Replaces ${HEADER} or a line `#version 330` by gl_header. Adds #line
// directives, so that compiler messages contain the line numbers of the original text. Returns false if the text
// contains other templates; canvas_read reports them.
bool gl_expand_template(Text *out, Str text);
// Reports that the program of a node was rejected.
void gl_report_shader(DiagSink *diags, const DrawNode *node, const GlShaderError *error);
// Reports that the program of a node exceeded the work limit, so that `what` is left out.
void gl_report_limit(DiagSink *diags, const DrawNode *node, const char *what);

// passes.c
// Returns the processor time that the programs of scripts may still take in this picture, in seconds.
double gl_seconds_left(const Gl *gl);
// Notes that a shader needs `seconds` for each of the remaining passes. Its pixels may differ in cost.
void gl_refuse_passes(Gl *gl, double seconds, uint32_t passes);
typedef struct GlPass {
    unsigned program;
    bool reduced; // true if the pass renders to a target that is smaller by the factor `downsample` in each direction
} GlPass;
// Runs the passes in order and stores the result of the last pass in *out. Returns false if the GPU is out of memory.
bool gl_run_passes(Gl *gl, Arena *arena, const GlEffect *effect, const GlPass *passes, uint32_t count, GlImage *out);
