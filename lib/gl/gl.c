// gl.c: opening and closing of a Gl; see gl.h.
#include "base/heap.h"
#include "gl/functions.h"
#include "gl/internal.h"

#include <math.h>

// By default, samplers have low precision and can return 16-bit floats, so the header ends with a precision for them.
const char gl_header[] = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";

const GlFunctions gl_call = {
#define MEMBER(name) .name = gl_##name,
    GL_FUNCTIONS(MEMBER)
#undef MEMBER
};

static void read_limits(Gl *gl) {
    gl->retains_fences = gl_context_is(gl, "llvmpipe");
    gl->floats = gl_context_has(gl, "GL_EXT_color_buffer_float");
    gl->halves = gl->floats || gl_context_has(gl, "GL_EXT_color_buffer_half_float");
    gl->float_filter = gl_context_has(gl, "GL_OES_texture_float_linear");
    glGenFramebuffers(1, &gl->framebuffer);
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    static const unsigned char nothing[4];
    glGenTextures(1, &gl->nothing);
    glBindTexture(GL_TEXTURE_2D, gl->nothing);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, nothing);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glGenVertexArrays(1, &gl->strip);
    glGenBuffers(1, &gl->corners);
    glBindVertexArray(gl->strip);
    glBindBuffer(GL_ARRAY_BUFFER, gl->corners);
    glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray(0);
}

static Gl *open_context(bool (*find_context)(Gl *gl, const char **problem), const char **problem) {
    Gl *gl = heap_calloc(1, sizeof *gl);
    *problem = NULL;
    if (!gl)
        return NULL;
    if (find_context(gl, problem) && gl_enter(gl, problem)) {
        read_limits(gl);
        gl_leave(gl);
        return gl;
    }
    gl_close(gl);
    return NULL;
}

Gl *gl_open(const char **problem) {
    return open_context(gl_context_open, problem);
}

Gl *gl_adopt(const char **problem) {
    return open_context(gl_context_adopt, problem);
}

void gl_close(Gl *gl) {
    const char *problem;
    if (!gl)
        return;
    if (gl->context) {
        gl->lost = !gl_enter(gl, &problem);
        gl_programs_close(gl);
        gpu_cache_close(gl);
        if (!gl->lost) {
            gl_images_close(gl);
            glDeleteFramebuffers(1, &gl->framebuffer);
            glDeleteVertexArrays(1, &gl->strip);
            glDeleteBuffers(1, &gl->corners);
            glDeleteTextures(1, &gl->nothing);
            glDeleteTextures(1, &gl->curve);
            gl_leave(gl);
        }
        gl_context_close(gl);
    }
    heap_free(gl);
}

void gl_charge(Gl *gl, Budget *budget) {
    gl->budget = budget;
}

uint64_t gl_shader_work(const Gl *gl) {
    uint64_t left = gl->budget ? gl->budget->work_limit - gl->budget->work : UINT64_MAX / 2;
    return (uint64_t)fmin(gl->shader_seconds * 1e9 / BUDGET_UNIT_TIME, (double)left);
}

void gl_test_shaders(Gl *gl, GlShaderTest *test, void *user_data) {
    gl->shader_test = test;
    gl->shader_test_data = user_data;
}
