// functions.c: the table of functions; see functions.h.
#include "gl/functions.h"

const GlFunctions gl_call = {
#define MEMBER(name) .name = gl_##name,
    GL_FUNCTIONS(MEMBER)
#undef MEMBER
};
