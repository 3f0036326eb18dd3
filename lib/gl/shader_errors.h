// shader_errors.h: finds the position in a script that a shader compiler's message refers to.
#ifndef PETRI_GL_SHADER_ERRORS_H
#define PETRI_GL_SHADER_ERRORS_H

#include "canvas/drawing.h"
#include "gl/gl.h"

// Reports a compiler's message about a node's shader. If the shader text is written literally in the script, the
// position is its line and column there. Otherwise it is the attribute, and the message has the line in the file or
// text.
void gl_report_shader_error(DiagSink *faults, const DrawNode *node, const GlShaderError *fault);

#endif
