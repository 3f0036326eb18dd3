// gl.c: the context; see gl.h.
#include "gl/internal.h"

#include "base/heap.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

// Samplers are of low precision unless told otherwise, and then give halves.
const char gl_header[] = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";

// Contexts of one process share more than they should: with Mesa 22.3 a thread that draws looks into the scenes of
// other contexts, and crashes while another thread draws there. So one thread at a time has OpenGL.
static pthread_mutex_t one_thread = PTHREAD_MUTEX_INITIALIZER;

// Mesa can do without any display. Else the usual one, without a surface.
static EGLDisplay find_display(void) {
    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (extensions && strstr(extensions, "EGL_MESA_platform_surfaceless"))
        return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

static bool open_context(Gl *gl, const char **problem) {
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
    static const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    EGLConfig config;
    EGLint count;
    gl->display = find_display();
    *problem = "EGL does not start";
    if (gl->display == EGL_NO_DISPLAY || !eglInitialize(gl->display, NULL, NULL))
        return false;
    *problem = "EGL has no OpenGL ES 3 that works without a window";
    if (!eglBindAPI(EGL_OPENGL_ES_API) || !eglChooseConfig(gl->display, wanted, &config, 1, &count) || count < 1)
        return false;
    gl->context = eglCreateContext(gl->display, config, EGL_NO_CONTEXT, version);
    return gl->context != EGL_NO_CONTEXT;
}

static void look_at_limits(Gl *gl) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    gl->largest = most;
    bool es32 = epoxy_gl_version() >= 32;
    gl->floats = es32 || epoxy_has_gl_extension("GL_EXT_color_buffer_float");
    gl->halves = gl->floats || epoxy_has_gl_extension("GL_EXT_color_buffer_half_float");
    gl->float_filter = epoxy_has_gl_extension("GL_OES_texture_float_linear");
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

static bool adopt_context(Gl *gl, const char **problem) {
    *problem = "no context of EGL is current";
    gl->context = eglGetCurrentContext();
    gl->adopted = true;
    if (gl->context == EGL_NO_CONTEXT)
        return false;
    *problem = "the window's context is not one of OpenGL ES 3";
    return !epoxy_is_desktop_gl() && epoxy_gl_version() >= 30;
}

// libepoxy ends the process where one of them is missing. They stay loaded, for it to find.
static bool are_installed(const char **problem) {
    *problem = "EGL or OpenGL ES is not installed (Debian: libegl1, libgles2)";
    return dlopen("libEGL.so.1", RTLD_LAZY) && dlopen("libGLESv2.so.2", RTLD_LAZY);
}

static Gl *open_with(bool (*find_context)(Gl *gl, const char **problem), const char **problem) {
    Gl *gl = heap_zeroed(1, sizeof *gl);
    *problem = NULL;
    if (!gl)
        return NULL;
    gl->display = EGL_NO_DISPLAY;
    gl->context = EGL_NO_CONTEXT;
    // A driver that is not there says so at length on standard error; *problem is enough.
    if (!getenv("EGL_LOG_LEVEL"))
        setenv("EGL_LOG_LEVEL", "fatal", 0);
    pthread_mutex_lock(&one_thread);
    bool good = are_installed(problem) && find_context(gl, problem);
    pthread_mutex_unlock(&one_thread);
    if (good && gl_enter(gl, problem)) {
        look_at_limits(gl);
        gl_leave(gl);
        return gl;
    }
    gl_close(gl);
    return NULL;
}

Gl *gl_open(const char **problem) {
    return open_with(open_context, problem);
}

Gl *gl_adopt(const char **problem) {
    return open_with(adopt_context, problem);
}

void gl_close(Gl *gl) {
    const char *problem;
    if (!gl)
        return;
    if (gl->context != EGL_NO_CONTEXT) {
        gl->lost = !gl_enter(gl, &problem);
        gl_programs_close(gl);
        gl_store_close(gl);
        if (!gl->lost) {
            gl_images_close(gl);
            glDeleteFramebuffers(1, &gl->framebuffer);
            glDeleteVertexArrays(1, &gl->strip);
            glDeleteBuffers(1, &gl->corners);
            glDeleteTextures(1, &gl->nothing);
            glDeleteTextures(1, &gl->curve);
            gl_leave(gl);
        }
        pthread_mutex_lock(&one_thread);
        if (!gl->adopted)
            eglDestroyContext(gl->display, gl->context);
        pthread_mutex_unlock(&one_thread);
    }
    heap_give(gl);
}

bool gl_enter(Gl *gl, const char **problem) {
    *problem = "OpenGL's context cannot be used";
    pthread_mutex_lock(&one_thread);
    if (gl->adopted ? eglGetCurrentContext() == gl->context
                    : eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, gl->context))
        return true;
    pthread_mutex_unlock(&one_thread);
    return false;
}

void gl_leave(Gl *gl) {
    glFinish();
    if (!gl->adopted)
        eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    pthread_mutex_unlock(&one_thread);
}

void gl_charge(Gl *gl, Meter *meter) {
    gl->meter = meter;
}

int gl_largest(const Gl *gl) {
    return gl->largest;
}
