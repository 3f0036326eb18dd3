// input_composite.h: generates the part of a fragment shader that reads and composites the input pictures (spec
// pictures.md 1.5, 3.3, 3.5).
#ifndef PETRI_GL_INPUT_COMPOSITE_H
#define PETRI_GL_INPUT_COMPOSITE_H

#include "gl/effect.h"

typedef enum GlEdge { GL_EDGE_BORDER, GL_EDGE_REPEAT, GL_EDGE_CLAMP } GlEdge;

// Returns how a node's pictures are read beyond their edges; `default_edge` is the default of the effect.
GlEdge gl_edge(const DrawNode *node, GlEdge default_edge);

// Adds these declarations to a shader, and returns false if the node's composite mode is unknown and there are several
// inputs: version and precision; `in vec2 coord`, `out vec4 color`; uniforms texture0 and so on, first, last, border;
// vec4 take(sampler2D t, vec2 uv) and vec4 texel(sampler2D t, ivec2 p), which read a picture with the node's edges;
// ivec2 here(), this pixel; vec4 merged(vec2 uv), all inputs composited; vec4 merged_here(), the same at coord in a
// pass of full size, where inputs of the node's size are read without interpolation.
bool gl_add_input_composite(Text *out, const GlEffect *effect, GlEdge edge);
// Returns true if the picture has the size of the node.
static inline bool gl_fits(const GlEffect *effect, GlImage image) {
    return image.width == effect->width && image.height == effect->height;
}

#endif
