// merge.h: the part that all programs have in common: reading the pictures inside and combining them (spec pictures.md
// 1.5, 3.3, 3.5), as text of a fragment shader.
#ifndef PETRI_GL_MERGE_H
#define PETRI_GL_MERGE_H

#include "canvas/drawing.h"
#include "gl/gl.h"

typedef enum GlEdge { GL_EDGE_BORDER, GL_EDGE_REPEAT, GL_EDGE_CLAMP } GlEdge;

// How a node's pictures are read beyond their edges; `usual` is what the effect says.
GlEdge gl_edge(const DrawNode *node, GlEdge usual);

// Adds to a shader: version and precision; `in vec2 coord`, `out vec4 color`; uniforms texture0, …, first, last,
// border; vec4 take(sampler2D t, vec2 uv), which reads a picture with the node's edges; vec4 merged(vec2 uv), all
// inputs laid over each other. False if the node's word for that is unknown and there are several.
bool gl_add_merge(Text *out, const DrawNode *node, uint32_t inputs, GlEdge edge);

#endif
