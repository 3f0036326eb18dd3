// internal.h: what the files of this room share.
#ifndef PETRI_GL_INTERNAL_H
#define PETRI_GL_INTERNAL_H

#include "gl/gl.h"

#ifdef __EMSCRIPTEN__
#include <GLES3/gl3.h>
#else
#include <epoxy/gl.h>
#endif

typedef struct GlProgram GlProgram;
typedef struct GpuCache GpuCache; // of scenes

enum { GL_SPARE_IMAGES = 32, GL_MAX_FENCES = 16 };

struct Gl {
    void *display; // EGLDisplay
    void *context; // EGLContext; NULL: none yet
    bool adopted;  // it is the host's
    bool lost;     // and gone: what it has is gone with it, and only memory is given back
    int max_size;
    bool floats; // can be drawn to
    bool halves;
    bool float_filter; // floats can be read between pixels
    GLuint framebuffer;
    GLuint strip; // vertex array of four corners: attribute 0
    GLuint corners;
    GLuint nothing; // a texture of one transparent pixel
    GLuint curve;   // a texture of the table that windows' bytes are encoded by; 0: none yet
    uint64_t readback_count;
    bool retains_fences; // see gl_after_draw
    int fence_count;
    GLsync fences[GL_MAX_FENCES]; // of what was drawn, the oldest first
    Budget *meter;                // or NULL
    GlImage spare[GL_SPARE_IMAGES];
    int spare_count;
    GlProgram *programs;
    GpuCache *cache; // made by the first scene
};

// context.c, or context_web.c: what gl_open, gl_adopt and gl_close do first or last; gl_enter and gl_leave are there,
// too.
bool gl_context_open(Gl *gl, const char **problem);
bool gl_context_adopt(Gl *gl, const char **problem);
void gl_context_close(Gl *gl);
bool gl_context_has(const Gl *gl, const char *extension);
// Whether what draws has this in its name.
bool gl_context_is(const Gl *gl, const char *renderer);
// To be called when something was drawn and another target, or nothing, comes next: context.c keeps its fence.
void gl_after_draw(Gl *gl);

void gl_images_close(Gl *gl);
// Bytes of a pixel.
size_t gl_pixel_size(GlFormat format);
// Whether the meter has refused something, which is for its owner to tell.
static inline bool gl_is_refused(const Gl *gl) {
    return gl->meter && gl->meter->memory_refused;
}
void gl_programs_close(Gl *gl);
void gpu_cache_close(Gl *gl);

#endif
