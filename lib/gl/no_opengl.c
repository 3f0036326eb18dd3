// no_opengl.c: implements gl.h in builds without OpenGL. gl_open and gl_adopt fail, so functions that need a Gl are
// never called.
#include "gl/effect.h"
#include "gl/scene.h"

Gl *gl_open(const char **problem) {
    *problem = "this build of petri has no OpenGL (Debian: libepoxy-dev libegl-dev)";
    return NULL;
}

Gl *gl_adopt(const char **problem) {
    return gl_open(problem);
}

void gl_charge(Gl *gl, Budget *budget) {
    (void)gl, (void)budget;
}

uint64_t gl_shader_work(const Gl *gl) {
    (void)gl;
    return 0;
}

void gl_test_shaders(Gl *gl, GlShaderTest *test, void *user_data) {
    (void)gl, (void)test, (void)user_data;
}

bool gl_try_program(const char *vertex, const char *fragment, GlShaderProblem *problem) {
    (void)vertex, (void)fragment;
    *problem = (GlShaderProblem){.failed = true, .text = "this build of petri has no OpenGL"};
    return false;
}

void gl_close(Gl *gl) {
    (void)gl;
}

bool gl_enter(Gl *gl, const char **problem) {
    (void)gl, (void)problem;
    return false;
}

void gl_leave(Gl *gl) {
    (void)gl;
}

GlFormat gl_format(const Gl *gl, int bits) {
    (void)gl, (void)bits;
    return GL_FORMAT_SRGB8;
}

int gl_max_size(const Gl *gl) {
    (void)gl;
    return 0;
}

GlImage gl_image_new(Gl *gl, int width, int height, GlFormat format) {
    (void)gl, (void)width, (void)height, (void)format;
    return (GlImage){0};
}

void gl_image_free(Gl *gl, GlImage image) {
    (void)gl, (void)image;
}

void gl_upload_bytes(Gl *gl, GlImage image, const uint32_t *pixels) {
    (void)gl, (void)image, (void)pixels;
}

void gl_upload_linear(Gl *gl, GlImage image, const float *pixels) {
    (void)gl, (void)image, (void)pixels;
}

bool gl_read_bytes(Gl *gl, GlImage image, uint32_t *pixels) {
    (void)gl, (void)image, (void)pixels;
    return false;
}

bool gl_read_linear(Gl *gl, GlImage image, float *pixels) {
    (void)gl, (void)image, (void)pixels;
    return false;
}

uint64_t gl_readback_count(const Gl *gl) {
    (void)gl;
    return 0;
}

bool gl_present_image(Gl *gl, Arena *arena, GlImage image, const GlBox *box, int width, int height,
                      const float thresholds[256], bool opaque) {
    (void)gl, (void)arena, (void)image, (void)box, (void)width, (void)height, (void)thresholds, (void)opaque;
    return false;
}

bool gl_present_pixels(Gl *gl, Arena *arena, const uint32_t *pixels, int x, int y, int width, int height, bool over) {
    (void)gl, (void)arena, (void)pixels, (void)x, (void)y, (void)width, (void)height, (void)over;
    return false;
}

double gl_effect_cost(const GlEffect *effect) {
    (void)effect;
    return 0;
}

GlImage gl_effect(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *faults) {
    (void)gl, (void)arena, (void)effect, (void)faults;
    return (GlImage){0};
}

GlImage gl_scene(Gl *gl, const Scene *scene, const SceneCamera *camera, const ScenePictures *pictures) {
    (void)gl, (void)scene, (void)camera, (void)pictures;
    return (GlImage){0};
}
