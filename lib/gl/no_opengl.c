// no_opengl.c: replaces lib/gl in builds without OpenGL.
#include "gl/functions.h"

const GlFunctions gl_call = {.charge = NULL};

Gl *gl_open(const char **problem) {
    *problem = "this build of petri has no OpenGL (Debian: libepoxy-dev libegl-dev)";
    return NULL;
}

Gl *gl_adopt(const char **problem) {
    return gl_open(problem);
}

bool gl_try_program(const char *vertex, const char *fragment, GlShaderProblem *problem) {
    (void)vertex, (void)fragment;
    *problem = (GlShaderProblem){.failed = true, .text = "this build of petri has no OpenGL"};
    return false;
}
