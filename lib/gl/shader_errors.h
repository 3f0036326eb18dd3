// shader_errors.h: finds the position in a script that a shader compiler's message refers to.
#pragma once

#include "canvas/drawing.h"
#include "gl/gl.h"

// Reports a compiler's message about a node's shader. If the shader is a string literal in the script, reports the
// position of the error within the literal. Otherwise, reports the position of the attribute, and adds the line number
// in the shader to the message.
void gl_report_shader_error(DiagSink *faults, const DrawNode *node, const GlShaderError *fault);
