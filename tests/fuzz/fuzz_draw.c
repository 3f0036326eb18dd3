// fuzz_draw.c: fuzzes drawing without OpenGL. The input is a script. Each frame is drawn as its nodes specify, and as
// an automatic picture. fuzz_effects.c and fuzz_scene.c draw with OpenGL.
#include "gl/gl.h"
#include "pictures.h"

static bool without_gl; // true once this harness runs; other harnesses in its program use OpenGL

// The linker uses __wrap_gl_open instead of gl_open (meson.build).
Gl *__real_gl_open(const char **problem);
Gl *__wrap_gl_open(const char **problem);
Gl *__wrap_gl_open(const char **problem) {
    if (!without_gl)
        return __real_gl_open(problem);
    *problem = "this harness draws without OpenGL";
    return NULL;
}

FUZZ_HARNESS(draw) {
    without_gl = true;
    static PetriPainter *painter; // reused for all inputs, because finding fonts takes long
    painter = painter ? painter : petri_painter_open();
    pictures_draw(painter, (const char *)data, size, true);
    return 0;
}
