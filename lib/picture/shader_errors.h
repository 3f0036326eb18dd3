// shader_errors.h: finds the position in a script that a shader compiler's message refers to.
#pragma once

#include "base/diag.h"

// Replaces a compiler's message, the text of `diag`, by a text for users, which is written to `out` and stays valid as
// long as `out`. If the shader is a string literal in the script, sets diag->at to the position of the error within the
// literal. Otherwise, adds the line number in the shader to the text. Reads the script, which must still be loaded,
// unless diag->at.source is NULL.
void picture_place_shader_error(Diag *diag, Text *out);
