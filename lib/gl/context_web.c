// context_web.c: the WebGL 2 context of a page, which has one thread and shares the context between all painters; see
// context.h.
#include "gl/context.h"

#define HOST(name) __attribute__((import_module("petri"), import_name(#name)))

// Returns true if the context exists and is not lost. JavaScript creates it on the first call.
HOST(gl_ready) bool gl_web_ready(void);
HOST(gl_has) bool gl_web_has(const char *extension);

bool gl_context_open(Gl *gl, const char **problem) {
    *problem = "WebGL 2 is not available";
    gl->context = gl_web_ready() ? gl : NULL;
    return gl->context;
}

bool gl_context_adopt(Gl *gl, const char **problem) {
    return gl_context_open(gl, problem);
}

void gl_context_close(Gl *gl) {
    (void)gl;
}

bool gl_context_has(const Gl *gl, const char *extension) {
    (void)gl;
    return gl_web_has(extension);
}

// Returns false, because browsers do not report the renderer.
bool gl_context_is(const Gl *gl, const char *renderer) {
    (void)gl;
    (void)renderer;
    return false;
}

void gl_after_draw(Gl *gl) {
    (void)gl;
}

bool gl_enter(Gl *gl, const char **problem) {
    gl->shader_seconds = 0;
    *problem = "the WebGL context was lost";
    return gl_web_ready();
}

void gl_leave(Gl *gl) {
    (void)gl;
}
