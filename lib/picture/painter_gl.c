// painter_gl.c: the OpenGL context of a painter, and the test of shaders; see painter.h.
#include "gl/functions.h"
#include "picture/painter.h"

#include <string.h>

// A GlShaderTest. `user_data` is the painter.
static bool test_shader(void *user_data, const char *vertex, const char *fragment, GlShaderProblem *problem) {
    const PetriPainter *painter = user_data;
    PetriShaderProblem found = {.size = sizeof found};
    if (painter->shader_test(painter->shader_test_data, vertex, fragment, &found))
        return true;
    found.text[sizeof found.text - 1] = '\0';
    *problem = (GlShaderProblem){.failed = found.failed, .in_vertex = found.in_vertex};
    memcpy(problem->text, found.text, sizeof problem->text);
    return false;
}

static void set_shader_test(PetriPainter *painter) {
    gl_call.test_shaders(painter->gl, painter->shader_test ? test_shader : NULL, painter);
}

void petri_painter_test_shaders(PetriPainter *painter, PetriShaderTest *test, void *user_data) {
    if (!painter)
        return;
    painter->shader_test = test;
    painter->shader_test_data = user_data;
    if (painter->gl)
        set_shader_test(painter);
}

bool petri_shader_try(const char *vertex, const char *fragment, PetriShaderProblem *problem, size_t size) {
    GlShaderProblem found = {0};
    if (!vertex || !fragment || !problem)
        return false;
    if (gl_try_program(vertex, fragment, &found))
        return true;
    PetriShaderProblem reported = {size < sizeof reported ? size : sizeof reported, found.failed, found.in_vertex, ""};
    memcpy(reported.text, found.text, sizeof reported.text);
    host_struct_write(problem, size, &reported, sizeof reported);
    return false;
}

PetriStatus petri_painter_use_gl(PetriPainter *painter) {
    const char *problem;
    if (!painter || painter->gl || painter->rendered > 0)
        return PETRI_INVALID;
    painter->gl = gl_adopt(&problem);
    painter->on_window = painter->gl;
    if (painter->gl) {
        gl_call.charge(painter->gl, &painter->budget);
        set_shader_test(painter);
    }
    return painter->gl ? PETRI_OK : problem ? PETRI_UNSUPPORTED : PETRI_OUT_OF_MEMORY;
}

uint64_t petri_painter_readback_count(const PetriPainter *painter) {
    return painter && painter->gl ? gl_call.readback_count(painter->gl) : 0;
}

Gl *painter_gl(PetriPainter *painter, const char **problem) {
    *problem = painter->gl_problem;
    if (!painter->gl && !*problem) {
        painter->gl = gl_open(problem);
        if (painter->gl)
            set_shader_test(painter);
    }
    if (painter->gl)
        gl_call.charge(painter->gl, &painter->budget);
    return painter->gl;
}
