// context.h: the state of a Gl, for files that call OpenGL directly, and the platform part of its context.
#pragma once

#include "gl/gl.h"

#ifdef __EMSCRIPTEN__
#include <GLES3/gl3.h>
#else
#include <epoxy/gl.h>
#endif

typedef struct GlProgram GlProgram;
typedef struct GpuCache GpuCache; // GPU resources of scenes, defined by lib/scene3d

enum { GL_SPARE_IMAGES = 32, GL_MAX_FENCES = 16 };

struct Gl {
    void *display;     // EGLDisplay
    void *context;     // EGLContext; NULL: not opened
    bool adopted;      // true if the context belongs to the host
    bool lost;         // true if the context is lost: its objects no longer exist, so only memory is freed
    bool floats;       // can render to 32-bit floats
    bool halves;       // can render to 16-bit floats
    bool float_filter; // 32-bit floats can be sampled with linear filtering
    GLuint framebuffer;
    GLuint strip; // vertex array: attribute 0 is the four corners of gl_quad
    GLuint corners;
    GLuint nothing; // texture of one transparent pixel
    GLuint curve;   // texture of the table that encodes colours for windows; 0: not created yet
    uint64_t readback_count;
    bool retains_fences; // true if fences must be retained; see delete_fences in context.c
    int fence_count;
    GLsync fences[GL_MAX_FENCES]; // fences after recent drawing, oldest first
    GlShaderTest *shader_test;    // NULL: the programs of scripts are not tested
    void *shader_test_data;
    double shader_seconds; // time that the programs of scripts have taken since gl_enter; infinite: too much
    Budget *budget;        // charged for images and scenes; NULL: nothing is charged
    GlImage spare[GL_SPARE_IMAGES];
    int spare_count;
    GlProgram *programs;
    GpuCache *cache;              // NULL until the first scene is drawn
    void (*close_scenes)(Gl *gl); // frees `cache`; NULL until the first scene is drawn
};

// context.c or context_web.c: the platform part of gl_open, gl_adopt and gl_close. These files also define gl_enter and
// gl_leave.
bool gl_context_open(Gl *gl, const char **problem);
bool gl_context_adopt(Gl *gl, const char **problem);
void gl_context_close(Gl *gl);
bool gl_context_has(const Gl *gl, const char *extension);
// Returns true if the name of OpenGL's renderer contains the string `renderer`.
bool gl_context_is(const Gl *gl, const char *renderer);
// Must be called after drawing, before the target changes or the context is released. In context.c, it creates a fence.
void gl_after_draw(Gl *gl);

void gl_images_close(Gl *gl);
// Returns the bytes of a pixel.
size_t gl_pixel_size(GlFormat format);
// Returns true if the budget has refused memory. The owner of the budget reports this.
static inline bool gl_is_refused(const Gl *gl) {
    return gl->budget && gl->budget->memory_refused;
}
void gl_programs_close(Gl *gl);
