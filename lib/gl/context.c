// context.c: EGL contexts; see context.h.
#include "gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

// The contexts of a process are not independent. With Mesa 22.3, a thread that draws also reads internal data of other
// contexts, and crashes if another thread is drawing in one of them. Therefore this lock lets only one thread at a time
// use OpenGL.
static pthread_mutex_t one_thread = PTHREAD_MUTEX_INITIALIZER;

// Returns Mesa's surfaceless platform if it is available, else the default display.
static EGLDisplay find_display(void) {
    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (extensions && strstr(extensions, "EGL_MESA_platform_surfaceless"))
        return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    return eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

static bool find_own(Gl *gl, const char **problem) {
    static const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
    static const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    EGLConfig config;
    EGLint count;
    gl->display = find_display();
    *problem = "EGL cannot be initialised";
    if (gl->display == EGL_NO_DISPLAY || !eglInitialize(gl->display, NULL, NULL))
        return false;
    *problem = "EGL has no OpenGL ES 3 context for drawing without a window";
    if (!eglBindAPI(EGL_OPENGL_ES_API) || !eglChooseConfig(gl->display, wanted, &config, 1, &count) || count < 1)
        return false;
    gl->context = eglCreateContext(gl->display, config, EGL_NO_CONTEXT, version);
    return gl->context != EGL_NO_CONTEXT;
}

static bool find_current(Gl *gl, const char **problem) {
    *problem = "the window has no EGL context";
    gl->context = eglGetCurrentContext();
    gl->adopted = true;
    if (gl->context == EGL_NO_CONTEXT)
        return false;
    *problem = "the window's context is not an OpenGL ES 3 context";
    return !epoxy_is_desktop_gl() && epoxy_gl_version() >= 30;
}

// libepoxy aborts the process if one of these libraries is missing. The libraries stay loaded, so that libepoxy finds
// them.
static bool are_installed(const char **problem) {
    *problem = "EGL or OpenGL ES is not installed (Debian: libegl1, libgles2)";
    return dlopen("libEGL.so.1", RTLD_LAZY) && dlopen("libGLESv2.so.2", RTLD_LAZY);
}

static bool open_context(Gl *gl, bool (*find_context)(Gl *gl, const char **problem), const char **problem) {
    // If a driver is missing, Mesa prints long messages to standard error. They are suppressed, because *problem
    // describes the problem.
    if (!getenv("EGL_LOG_LEVEL"))
        setenv("EGL_LOG_LEVEL", "fatal", 0);
    pthread_mutex_lock(&one_thread);
    bool good = are_installed(problem) && find_context(gl, problem);
    pthread_mutex_unlock(&one_thread);
    return good;
}

bool gl_context_open(Gl *gl, const char **problem) {
    return open_context(gl, find_own, problem);
}

bool gl_context_adopt(Gl *gl, const char **problem) {
    return open_context(gl, find_current, problem);
}

void gl_context_close(Gl *gl) {
    pthread_mutex_lock(&one_thread);
    if (!gl->adopted)
        eglDestroyContext(gl->display, gl->context);
    pthread_mutex_unlock(&one_thread);
}

bool gl_context_has(const Gl *gl, const char *extension) {
    (void)gl;
    bool drawn = strcmp(extension, "GL_EXT_color_buffer_float") == 0; // the extension is part of OpenGL ES 3.2
    return (drawn && epoxy_gl_version() >= 32) || epoxy_has_gl_extension(extension);
}

bool gl_context_is(const Gl *gl, const char *renderer) {
    (void)gl;
    const char *name = (const char *)glGetString(GL_RENDERER);
    return name && strstr(name, renderer);
}

// Works around a use-after-free in Mesa's llvmpipe (Mesa 22.3: lp_fence_signalled and lp_fence_signal in lp_fence.c).
// llvmpipe checks without a lock whether its threads have signalled a fence, and frees the fence when the next one is
// created. If the last of these threads is still using the freed fence, it waits forever or corrupts memory. As a
// workaround, each fence is given a GLsync, because llvmpipe frees no fence to which a GLsync refers. Threads signal
// fences in order, so after waiting for the newest fence, all older ones can be deleted. The newest fence is deleted
// with its context. llvmpipe splits a draw of more than 36 MB of triangles. No GLsync refers to the fences between the
// parts of such a draw, but llvmpipe does not free these fences soon either.
static void delete_fences(Gl *gl) {
    for (int i = 0; i + 1 < gl->fence_count; i++)
        glDeleteSync(gl->fences[i]);
    if (gl->fence_count > 1)
        gl->fences[0] = gl->fences[gl->fence_count - 1];
    gl->fence_count = gl->fence_count > 0;
}

void gl_after_draw(Gl *gl) {
    if (!gl->retains_fences)
        return;
    if (gl->fence_count == GL_MAX_FENCES) {
        glFinish();
        delete_fences(gl);
    }
    GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (fence)
        gl->fences[gl->fence_count++] = fence;
}

bool gl_enter(Gl *gl, const char **problem) {
    *problem = "the OpenGL context cannot be used";
    pthread_mutex_lock(&one_thread);
    gl->shader_seconds = 0;
    if (gl->adopted ? eglGetCurrentContext() == gl->context
                    : eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, gl->context)) {
        gl_after_draw(gl); // the host may have drawn since the last fence
        return true;
    }
    pthread_mutex_unlock(&one_thread);
    return false;
}

void gl_leave(Gl *gl) {
    gl_after_draw(gl);
    glFinish();
    delete_fences(gl);
    if (!gl->adopted)
        eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    pthread_mutex_unlock(&one_thread);
}
