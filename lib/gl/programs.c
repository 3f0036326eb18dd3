// programs.c: compiles shader programs and caches them by their source.
#include "base/heap.h"
#include "gl/internal.h"

#include <string.h>

const char gl_quad[] = "#version 300 es\n"
                       "in vec2 position;\n"
                       "out vec2 coord;\n"
                       "void main() {\n"
                       "    coord = 0.5 * position + 0.5;\n"
                       "    gl_Position = vec4(position, 0.0, 1.0);\n"
                       "}\n";

struct GlProgram {
    GlProgram *next;
    char *vertex;
    char *fragment;
    char *problem; // message of the compiler or linker; NULL: none
    bool in_vertex;
    GLuint program;
};

static char *copy_text(Str text) {
    char *out = heap_alloc(text.len + 1);
    if (out) {
        memcpy(out, text.bytes, text.len);
        out[text.len] = 0;
    }
    return out;
}

static void free_program(const Gl *gl, GlProgram *program) {
    if (!gl->lost)
        glDeleteProgram(program->program);
    heap_free(program->vertex);
    heap_free(program->fragment);
    heap_free(program->problem);
    heap_free(program);
}

void gl_programs_close(Gl *gl) {
    for (GlProgram *program = gl->programs, *next; program; program = next) {
        next = program->next;
        free_program(gl, program);
    }
    gl->programs = NULL;
}

// Compiles and attaches a shader. If it does not compile, sets *problem to the compiler's message and returns false.
static bool attach_shader(GLuint program, GLenum kind, const char *text, char **problem) {
    GLuint shader = glCreateShader(kind);
    GLint good = 0, length = 0;
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    if (!good && (*problem = heap_calloc((size_t)length + 1, 1)))
        glGetShaderInfoLog(shader, length, NULL, *problem);
    glAttachShader(program, shader);
    glDeleteShader(shader); // OpenGL keeps the shader until the program is deleted
    return good;
}

static void link_program(GlProgram *program) {
    GLint good = 0, length = 0;
    program->program = glCreateProgram();
    program->in_vertex = !attach_shader(program->program, GL_VERTEX_SHADER, program->vertex, &program->problem);
    if (!program->in_vertex &&
        attach_shader(program->program, GL_FRAGMENT_SHADER, program->fragment, &program->problem)) {
        glBindAttribLocation(program->program, 0, "position");
        glLinkProgram(program->program);
        glGetProgramiv(program->program, GL_LINK_STATUS, &good);
        glGetProgramiv(program->program, GL_INFO_LOG_LENGTH, &length);
        if (!good && (program->problem = heap_calloc((size_t)length + 1, 1)))
            glGetProgramInfoLog(program->program, length, NULL, program->problem);
    }
    if (!good) {
        glDeleteProgram(program->program);
        program->program = 0;
    }
}

static GlProgram *find_program(Gl *gl, Str vertex, Str fragment) {
    for (GlProgram *program = gl->programs; program; program = program->next)
        if (str_equal(str_from(program->fragment), fragment) && str_equal(str_from(program->vertex), vertex))
            return program;
    return NULL;
}

unsigned gl_program(Gl *gl, Arena *arena, Str vertex, Str fragment, GlShaderError *fault) {
    enum { MAX_PROGRAMS = 200 }; // the cache is limited because a script can create a new shader in each frame
    GlProgram *program = find_program(gl, vertex, fragment);
    if (!program) {
        int count = 0;
        for (GlProgram *other = gl->programs; other; other = other->next)
            count++;
        if (count >= MAX_PROGRAMS)
            gl_programs_close(gl);
        program = heap_calloc(1, sizeof *program);
        if (!program)
            arena_exhausted(arena);
        program->vertex = copy_text(vertex);
        program->fragment = copy_text(fragment);
        program->next = gl->programs;
        if (!program->vertex || !program->fragment) {
            free_program(gl, program);
            arena_exhausted(arena);
        }
        gl->programs = program;
        link_program(program);
    }
    *fault = (GlShaderError){.in_vertex = program->in_vertex};
    if (!program->program)
        fault->text = str_copy(arena, str_from(program->problem ? program->problem : "?"));
    return program->program;
}

void gl_draw_quad(Gl *gl, unsigned program) {
    glUseProgram(program);
    glBindVertexArray(gl->strip);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl_after_draw(gl);
}
