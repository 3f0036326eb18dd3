// functions.h: the functions of lib/gl that need a Gl, as a table. Only builds with OpenGL contain them.
#pragma once

#include "gl/effect.h"

// clang-format off
#define GL_FUNCTIONS(ROW)                                                                                              \
    ROW(charge) ROW(close) ROW(effect) ROW(effect_cost) ROW(enter) ROW(format) ROW(image_free) ROW(image_new)          \
    ROW(leave) ROW(present_image) ROW(present_pixels) ROW(read_bytes) ROW(read_linear) ROW(readback_count)             \
    ROW(shader_work) ROW(test_shaders) ROW(upload_bytes) ROW(upload_linear)
// clang-format on

// `gl_call.enter` is gl_enter, and so on. Without OpenGL, all are NULL, and gl_open and gl_adopt fail, so no caller has
// a Gl.
typedef struct GlFunctions {
#define MEMBER(name) __typeof__(gl_##name) *name;
    GL_FUNCTIONS(MEMBER)
#undef MEMBER
} GlFunctions;
extern const GlFunctions gl_call;
