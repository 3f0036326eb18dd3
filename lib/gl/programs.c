// programs.c: compiles shader programs and caches them by their source.
#include "base/clock.h"
#include "base/heap.h"
#include "gl/context.h"

#include <math.h>
#include <string.h>

// By default, samplers have low precision and can return 16-bit floats, so the header ends with a precision for them.
const char gl_header[] = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";

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
    bool failed; // true if the compiler crashed or exceeded a limit in the test
    GLuint program;
};

static char *copy_text(Str text) {
    char *out = heap_alloc(text.len + 1);
    if (out && text.len > 0) // the bytes of an empty text can be NULL
        memcpy(out, text.bytes, text.len);
    if (out)
        out[text.len] = 0;
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

// Returns NULL if out of memory.
static GlProgram *new_program(const Gl *gl, Str vertex, Str fragment) {
    GlProgram *program = heap_calloc(1, sizeof *program);
    if (!program)
        return NULL;
    program->vertex = copy_text(vertex);
    program->fragment = copy_text(fragment);
    if (program->vertex && program->fragment)
        return program;
    free_program(gl, program);
    return NULL;
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

// Numbers the inputs of vertex shaders. Those of groups of a scene are bound as in scene_vertex.glsl.
static void bind_inputs(GLuint program) {
    static const struct {
        GLuint at;
        const char *name;
    } inputs[] = {{0, "position"},         {0, "model_position"},     {1, "model_normal"},
                  {2, "model_uv"},         {3, "model_matrix"},       {7, "model_normal_matrix"},
                  {10, "material_albedo"}, {11, "material_emissive"}, {12, "material_properties"}};
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++)
        glBindAttribLocation(program, inputs[i].at, inputs[i].name);
}

static void link_program(GlProgram *program) {
    GLint good = 0, length = 0;
    program->program = glCreateProgram();
    program->in_vertex = !attach_shader(program->program, GL_VERTEX_SHADER, program->vertex, &program->problem);
    if (!program->in_vertex &&
        attach_shader(program->program, GL_FRAGMENT_SHADER, program->fragment, &program->problem)) {
        bind_inputs(program->program);
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

// Lets the host test a program. Returns false if the program must not be compiled.
static bool test_program(const Gl *gl, GlProgram *program) {
    GlShaderProblem problem = {0};
    if (!gl->shader_test || gl->shader_test(gl->shader_test_data, program->vertex, program->fragment, &problem))
        return true;
    program->failed = problem.failed;
    program->in_vertex = problem.in_vertex;
    program->problem = copy_text(str_from(problem.text));
    return false;
}

static unsigned make_program(Gl *gl, Arena *arena, Str vertex, Str fragment, bool own, GlShaderError *error) {
    enum { MAX_PROGRAMS = 200 }; // the cache is limited because a script can create a new shader in each frame
    GlProgram *program = find_program(gl, vertex, fragment);
    if (!program) {
        int count = 0;
        for (GlProgram *other = gl->programs; other; other = other->next)
            count++;
        if (count >= MAX_PROGRAMS)
            gl_programs_close(gl);
        program = new_program(gl, vertex, fragment);
        if (!program)
            arena_exhausted(arena);
        program->next = gl->programs;
        gl->programs = program;
        if (!own || test_program(gl, program))
            link_program(program);
    }
    *error = (GlShaderError){.in_vertex = program->in_vertex, .failed = program->failed};
    if (!program->program)
        error->text = str_copy(arena, str_from(program->problem ? program->problem : "?"));
    return program->program;
}

unsigned gl_program(Gl *gl, Arena *arena, Str vertex, Str fragment, GlShaderError *error) {
    return make_program(gl, arena, vertex, fragment, false, error);
}

unsigned gl_own_program(Gl *gl, Arena *arena, Str vertex, Str fragment, GlShaderError *error) {
    return make_program(gl, arena, vertex, fragment, true, error);
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

// Draws with a program into a box of the target and waits for the result. Returns how long that took, in seconds.
static double draw_box(Gl *gl, unsigned program, int y, int width, int height) {
    double start = clock_seconds();
    glScissor(0, y, width, height);
    gl_draw_quad(gl, program);
    glFinish();
    return clock_seconds() - start;
}

double gl_draw_quad_within(Gl *gl, unsigned program, int width, int height, double seconds, double *needed) {
    static const double COMPILES = 0.01, BAND_SECONDS = 0.05, UNEVEN = 8, THREADS = 2;
    const double processor = clock_read(CLOCK_PROCESS_CPUTIME_ID), start = clock_seconds();
    const double pixels = fmin(width, GL_TRY_SIDE) * fmin(height, GL_TRY_SIDE);
    glEnable(GL_SCISSOR_TEST);
    // The first box is as large as the pictures of gl_try_program. It is drawn again if the driver may have compiled,
    // or if the process may have been suspended.
    double box = INFINITY;
    for (int i = 0; i < 4 && (box > COMPILES || box / pixels * width * height > UNEVEN * seconds); i++)
        box = fmin(box, draw_box(gl, program, 0, GL_TRY_SIDE, GL_TRY_SIDE));
    double row = box / pixels * width, used = 0; // in seconds
    // Pixels may differ in cost, so that the estimate decides only if it is far above the limit.
    bool good = row * height <= UNEVEN * seconds;
    *needed = row * height;
    // Bands have an even number of rows, because pairs of rows share the derivatives of a shader.
    double wanted = fmin(floor(BAND_SECONDS / fmax(row, 1e-9)), height + 1);
    int rows = wanted < 2 ? 2 : (int)wanted / 2 * 2;
    for (int y = 0; y < height && good; y += rows) {
        draw_box(gl, program, y, width, rows < height - y ? rows : height - y);
        // A GPU takes no processor time; waiting for it counts a quarter. Other threads of this process take processor
        // time for other work, so that it counts for a few threads only.
        double wall = clock_seconds() - start;
        used = fmax(fmin(clock_read(CLOCK_PROCESS_CPUTIME_ID) - processor, THREADS * wall), wall / 4);
        good = used <= seconds;
        *needed = used * height / fmin(y + rows, height);
    }
    glDisable(GL_SCISSOR_TEST);
    return good ? used : INFINITY;
}
