// input_composite.h: generates the part of a fragment shader that reads and composites the input pictures (spec
// pictures.md 1.5, 3.3, 3.5).
#pragma once

#include "gl/effect.h"

typedef enum GlEdge { GL_EDGE_BORDER, GL_EDGE_REPEAT, GL_EDGE_CLAMP } GlEdge;

// Returns how the input pictures of a node are read beyond their edges. `default_edge` applies if the node does not set
// this.
GlEdge gl_edge(const DrawNode *node, GlEdge default_edge);

// Adds the following declarations to a shader. Returns false if the node's composite mode is unknown and there are
// several inputs.
// - the version and precision lines, `in vec2 coord` and `out vec4 color`
// - the uniforms texture0 and so on, first, last and border
// - vec4 take(sampler2D t, vec2 uv) and vec4 texel(sampler2D t, ivec2 p), which read a picture and apply the node's
//   edge mode
// - ivec2 here(), the position of this pixel
// - vec4 merged(vec2 uv), the composite of all inputs
// - vec4 merged_here(), only for full-size passes: like merged(coord), but does not interpolate inputs that have the
//   size of the node
bool gl_add_input_composite(Text *out, const GlEffect *effect, GlEdge edge);
// Returns true if the picture has the size of the node.
static inline bool gl_fits(const GlEffect *effect, GlImage image) {
    return image.width == effect->width && image.height == effect->height;
}
