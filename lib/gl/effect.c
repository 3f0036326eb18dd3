// effect.c: see effect.h.
#include "gl/effect.h"

#include "gl/internal.h"
#include "gl/merge.h"

static void report(DiagSink *faults, const DrawNode *node, const char *code, Str problem) {
    Text text = text_new(faults->arena);
    text_add_format(&text, "!%s: %.*s", schema_kinds[node->kind].name, (int)problem.len, problem.bytes);
    diag_report(faults, &(Diag){.level = DIAG_WARNING, .text = text_str(&text), .code = code});
}

// The program of a node that only lays its pictures over each other.
static GlImage run_plain(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *faults) {
    const DrawNode *node = effect->node;
    const GlImage none = {0};
    Text text = text_new(arena);
    Str problem;
    if (!gl_add_merge(&text, node, effect->count, gl_edge(node, GL_EDGE_BORDER)))
        return none;
    text_add_c(&text, "void main() { color = alpha * merged(coord); }\n");
    unsigned program = gl_program(gl, arena, str_from(gl_quad), text_str(&text), &problem);
    if (!program) {
        report(faults, node, "bad-shader", problem);
        return none;
    }
    GlImage out = gl_image_new(gl, effect->width, effect->height, effect->format);
    if (!out.texture)
        return none;
    gl_target(gl, out);
    gl_set_merge(program, node, effect->inputs, effect->count, none, none);
    glUniform1f(glGetUniformLocation(program, "alpha"), (float)draw_number(node, ATTR_ALPHA));
    gl_draw_quad(gl, program);
    return out;
}

GlImage gl_effect(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *faults) {
    switch ((NodeKind)effect->node->kind) {
    case KIND_WINDOW:
    case KIND_OFFSCREEN:
    case KIND_RECORD:
        return run_plain(gl, arena, effect, faults);
    default:
        report(faults, effect->node, "left-out", STR("is not drawn yet; what is inside is shown"));
        return run_plain(gl, arena, effect, faults);
    }
}
