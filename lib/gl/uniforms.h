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

// An active uniform of a program. `count` is the number of elements of an array.
typedef struct GlUniform {
    char name[1024]; // without the index of array elements. OpenGL ES 3 limits names to 1024 bytes
    int at;
    int count;
    unsigned type;
} GlUniform;

// Returns uniform number `index` of a program.
GlUniform gl_uniform(unsigned program, unsigned index);
// Returns the attribute of a node that the schema does not have, or NULL if it is not set.
const AttrValue *gl_custom_attr(const DrawNode *node, const char *name);
// Sets a uniform of the current program. A list of matching length is used as it is. One number fills all elements, and
// a vector fills each element of an array. Other lists are treated as 0. Does nothing if the type is not supported.
// Temporary data of large arrays is allocated from the arena.
void gl_set_uniform(Arena *arena, const GlUniform *uniform, const double *numbers, uint32_t length);
void gl_set_uniforms(const Gl *gl, Arena *arena, unsigned program, const GlState *state);
