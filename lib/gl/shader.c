// shader.c: see shader.h.
#include "gl/shader.h"

#include "gl/context.h"
#include "gl/input_composite.h"

#include <math.h>

enum { MAX_PASSES = 64 };

bool gl_expand_template(Text *out, Str text) {
    static const Str header = {"${HEADER}", 9}, version = {"#version 330", 12};
    size_t line_number = 1, i = 0;
    if (draw_find_template(text).len > 0)
        return false;
    for (; i < text.len && strchr(" \t\n\r", text.bytes[i]); i++)
        line_number += text.bytes[i] == '\n'; // white space is dropped, because the version must be the first line
    const size_t start = i;
    for (; i < text.len; i++) {
        Str rest = {text.bytes + i, text.len - i};
        bool line = i == start || text.bytes[i - 1] == '\n';
        line_number += text.bytes[i] == '\n';
        bool own = line && str_starts_with(rest, version);
        if (own || str_starts_with(rest, header)) {
            text_add_format(out, "%s#line %zu\n", gl_header, line_number);
            i += header.len - 1;
            while (own && i + 1 < text.len && text.bytes[i + 1] != '\n')
                i++;
        } else {
            text_add(out, (Str){text.bytes + i, 1});
        }
    }
    return true;
}

// Returns true if the attribute `downsample_passes` contains the pass.
static bool is_reduced(const DrawNode *node, uint32_t pass) {
    const AttrValue *list = draw_attr(node, ATTR_DOWNSAMPLE_PASSES);
    for (uint32_t i = 0; list && i < list->count; i++)
        if (list->as.list[i] >= pass && list->as.list[i] < pass + 1)
            return true;
    return false;
}

uint32_t gl_shader_passes(const DrawNode *node) {
    double wanted = draw_number(node, ATTR_PASSES);
    return wanted >= 2 ? wanted < MAX_PASSES ? (uint32_t)wanted : MAX_PASSES : 1;
}

void gl_report_shader(DiagSink *diags, const DrawNode *node, const GlShaderError *error) {
    const AttrValue *own = draw_attr(node, error->in_vertex ? ATTR_VERTEX : ATTR_FRAGMENT);
    diag_report(diags, &(Diag){.level = error->failed ? DIAG_ERROR : DIAG_WARNING,
                               .at = node->origin,
                               .text = error->text,
                               .code = "bad-shader",
                               .shader = {schema_kinds[node->kind].name, own ? own->as.text : (Str){0}}});
}

void gl_report_limit(DiagSink *diags, const DrawNode *node, const char *what) {
    Str text = str_format(diags->arena,
                          "!%s: the shader took longer to draw than the work limit allows (--work); %s is left out",
                          schema_kinds[node->kind].name, what);
    diag_report(diags, &(Diag){DIAG_ERROR, node->origin, text, .code = "drawing-limit"});
}

GlImage gl_shader(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *diags) {
    const DrawNode *node = effect->node;
    const AttrValue *vertex = draw_attr(node, ATTR_VERTEX), *fragment = draw_attr(node, ATTR_FRAGMENT);
    Text texts[2] = {text_new(arena), text_new(arena)};
    GlShaderError error;
    bool good = gl_expand_template(&texts[0], vertex ? vertex->as.text : str_from(gl_quad));
    if (fragment)
        good = good && gl_expand_template(&texts[1], fragment->as.text);
    else if (!gl_add_input_composite(&texts[1], effect, gl_edge(node, GL_EDGE_BORDER)))
        return (GlImage){0};
    else
        text_add_c(&texts[1], "void main() { color = merged(coord) * alpha; }\n");
    if (!good)
        return (GlImage){0};
    unsigned program = gl_own_program(gl, arena, text_str(&texts[0]), text_str(&texts[1]), &error);
    if (!program) {
        gl_report_shader(diags, node, &error);
        return (GlImage){0};
    }
    uint32_t count = gl_shader_passes(node);
    GlPass passes[MAX_PASSES];
    for (uint32_t i = 0; i < count; i++)
        passes[i] = (GlPass){program, is_reduced(node, i)};
    GlImage out;
    if (gl_run_passes(gl, arena, effect, passes, count, &out))
        return out;
    if (isinf(gl->shader_seconds)) {
        gl_report_limit(diags, node, "it");
        gl_image_free(gl, out);
    }
    return (GlImage){0};
}
