// shader_errors.h: where in a script a shader is wrong, out of what the driver's compiler says of it.
#ifndef PETRI_GL_SHADER_ERRORS_H
#define PETRI_GL_SHADER_ERRORS_H

#include "canvas/drawing.h"
#include "gl/gl.h"

// Reports what a compiler says of a program of the node: at the line and column in the script if the text of the shader
// that is wrong is there as it is; else at the attribute, with the line in the file that it reads, or in the text.
void gl_report_shader_error(DiagSink *faults, const DrawNode *node, const GlShaderError *fault);

#endif
