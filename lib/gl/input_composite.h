// input_composite.h: the part that all programs have in common: reading the pictures inside and combining them (spec
// pictures.md 1.5, 3.3, 3.5), as text of a fragment shader.
#ifndef PETRI_GL_INPUT_COMPOSITE_H
#define PETRI_GL_INPUT_COMPOSITE_H

#include "gl/effect.h"

typedef enum GlEdge { GL_EDGE_BORDER, GL_EDGE_REPEAT, GL_EDGE_CLAMP } GlEdge;

// How a node's pictures are read beyond their edges; `usual` is what the effect says.
GlEdge gl_edge(const DrawNode *node, GlEdge default_edge);

// Adds to a shader: version and precision; `in vec2 coord`, `out vec4 color`; uniforms texture0, …, first, last,
// border; vec4 take(sampler2D t, vec2 uv) and vec4 texel(sampler2D t, ivec2 p), which read a picture with the node's
// edges; ivec2 here(), this pixel; vec4 merged(vec2 uv), all inputs laid over each other; vec4 merged_here(), the same
// at coord in a full pass, where a picture of the node's own size needs no mixing. False if the node's word for
// combining is unknown and there are several.
bool gl_add_input_composite(Text *out, const GlEffect *effect, GlEdge edge);
// Has the picture the size of the node?
static inline bool gl_fits(const GlEffect *effect, GlImage image) {
    return image.width == effect->width && image.height == effect->height;
}

#endif
