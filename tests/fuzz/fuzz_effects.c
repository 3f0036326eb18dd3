// fuzz_effects.c: fuzzes pictures that OpenGL draws. The input is a script, then a byte 30, then the message of the
// shader compiler about all shaders of the script except FRAGMENT and VERTEX. Other shaders are never compiled, because
// the harness would then fuzz the driver's compiler.
#include "pictures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Declares uniforms of all types that scripts can set, and the names FRAGMENT and VERTEX of compiled shaders.
static const char PRELUDE[] =
    "let FRAGMENT=\"\"\"${HEADER}\n"
    "in vec2 coord;\nout vec4 color;\nuniform sampler2D texture0, texture1, last, first;\nuniform float a;\n"
    "uniform vec2 b;\nuniform vec3 c;\nuniform vec4 d;\nuniform mat2 e;\nuniform mat3 f;\nuniform mat4 g;\n"
    "uniform int h, pass, passes;\nuniform ivec3 i;\nuniform uint j;\nuniform bool k;\nuniform bvec2 l;\n"
    "uniform float m[5];\nuniform mat2 n[2];\nuniform vec2 size;\nuniform float beat;\n"
    "void main() {\n"
    "    color = texture(texture0, coord + b) + texture(texture1, coord) + texture(last, coord) * float(pass) +\n"
    "            texture(first, e * coord) + vec4(c, a) + g * d + vec4(f * c, float(h + i.x + passes)) + vec4(m[4]) +\n"
    "            vec4(n[1] * b, size) + vec4(float(j), beat, k, l.y);\n}\n\"\"\"\n"
    "let VERTEX=\"\"\"${HEADER}\n"
    "in vec2 position;\nout vec2 coord;\nuniform vec2 shift;\n"
    "void main() {\n    coord = position;\n    gl_Position = vec4(position + shift, 0.0, 1.0);\n}\n\"\"\"\n";
static const char FIRST[] =
    "!window size=8\n    !shader fragment=FRAGMENT\n    !shader fragment=FRAGMENT vertex=VERTEX\n";

enum { PROGRAMS = 4 };
static char *programs[PROGRAMS][2]; // vertex and fragment shaders that may be compiled
static int program_count;
static bool learning = true; // true while the programs of FIRST are collected
static const char *compiler_message;

static bool test_shader(void *user_data, const char *vertex, const char *fragment, PetriShaderProblem *problem) {
    (void)user_data;
    if (learning && program_count < PROGRAMS) {
        programs[program_count][0] = strdup(vertex);
        programs[program_count++][1] = strdup(fragment);
    }
    for (int i = 0; i < program_count; i++)
        if (strcmp(vertex, programs[i][0]) == 0 && strcmp(fragment, programs[i][1]) == 0)
            return true;
    problem->in_vertex = compiler_message[0] & 1;
    problem->failed = compiler_message[0] & 2;
    snprintf(problem->text, sizeof problem->text, "%s", compiler_message);
    return false;
}

FUZZ_HARNESS(effects) {
    static PetriPainter *painter; // reused for all inputs, because compiling the effects' shaders takes long
    FuzzText script = {0}, text = {0};
    const uint8_t *part = memchr(data, 30, size);
    size_t length = part ? (size_t)(part - data) : size;
    fuzz_append(&script, PRELUDE, sizeof PRELUDE - 1);
    if (!painter) {
        painter = petri_painter_open();
        petri_painter_test_shaders(painter, test_shader, NULL);
        fuzz_append(&script, FIRST, sizeof FIRST - 1);
        pictures_draw(painter, script.bytes, script.length, false);
        script.length = sizeof PRELUDE - 1;
        learning = false;
    }
    fuzz_append(&text, part ? (const char *)part + 1 : "", part ? size - length - 1 : 0);
    compiler_message = text.bytes;
    fuzz_append(&script, (const char *)data, length);
    pictures_draw(painter, script.bytes, script.length, false);
    free(script.bytes);
    free(text.bytes);
    return 0;
}
