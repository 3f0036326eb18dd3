// gl.c: opens and closes a Gl, and tries out programs; see gl.h.
#include "base/heap.h"
#include "gl/context.h"

#include <math.h>
#include <stdio.h>

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
        if (gl->close_scenes)
            gl->close_scenes(gl);
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

// Draws a few pixels, because drivers also compile when a program first draws.
static void draw_few_pixels(Gl *gl, unsigned program) {
    uint32_t pixels[GL_TRY_SIDE * GL_TRY_SIDE];
    GlImage image = gl_image_new(gl, GL_TRY_SIDE, GL_TRY_SIDE, GL_FORMAT_SRGB8);
    if (!image.texture)
        return;
    // Programs of groups get unit matrices.
    static const float unit[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (GLuint i = 0; i < 4; i++)
        glVertexAttrib4fv(3 + i, unit + (size_t)4 * i);
    gl_target(gl, image);
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "pv_matrix"), 1, GL_FALSE, unit);
    gl_draw_quad(gl, program);
    gl_read_bytes(gl, image, pixels);
    gl_image_free(gl, image);
}

// A program that is tried out.
typedef struct Trial {
    Gl *gl;
    Str vertex;
    Str fragment;
    Arena arena; // holds the message of the compiler
    GlShaderError error;
    unsigned program; // 0: it does not compile
} Trial;

static void compile(void *context) {
    Trial *trial = context;
    trial->program = gl_program(trial->gl, &trial->arena, trial->vertex, trial->fragment, &trial->error);
}

bool gl_try_program(const char *vertex, const char *fragment, GlShaderProblem *problem) {
    const char *reason;
    Gl *gl = gl_open(&reason);
    if (!gl || !gl_enter(gl, &reason)) {
        gl_close(gl);
        *problem = (GlShaderProblem){.failed = true};
        snprintf(problem->text, sizeof problem->text, "%s", reason ? reason : "out of memory");
        return false;
    }
    Trial trial = {.gl = gl, .vertex = str_from(vertex), .fragment = str_from(fragment)};
    arena_init(&trial.arena, "shader", SIZE_MAX);
    Arena *arenas[] = {&trial.arena};
    if (arena_protect(arenas, 1, compile, &trial) != ARENA_OK)
        trial.error = (GlShaderError){.text = STR("out of memory"), .failed = true};
    if (trial.program)
        draw_few_pixels(gl, trial.program);
    *problem = (GlShaderProblem){.failed = trial.error.failed, .in_vertex = trial.error.in_vertex};
    snprintf(problem->text, sizeof problem->text, "%.*s", STR_ARGS(trial.error.text));
    arena_free(&trial.arena);
    gl_leave(gl);
    gl_close(gl);
    return trial.program != 0;
}
