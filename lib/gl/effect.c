// effect.c: runs effects; see effect.h. The source of an effect is a file in shaders/. The file begins with the
// declarations that all passes share. The passes follow. Each pass is a line with the size of its target (split_passes)
// and a function `main`.
#include "gl/effect.h"

#include "gl/context.h"
#include "gl/input_composite.h"
#include "gl/shader.h"
#include "gl/shader_sources.h"

#include <math.h>

enum { MAX_PASSES = 8 };

// An effect. The costs are in nanoseconds per pixel, as measured with llvmpipe on two processors. A GPU is faster, but
// the work limit must not depend on the machine.
typedef struct Effect {
    const char *text;
    GlEdge edge;
    bool merges; // true if several inputs are composited in an additional first pass
    double cost;
    double radius_cost; // cost of each pixel of the attribute `radius`
    double octave_cost; // cost of each unit of the attribute `octaves`
} Effect;

static const Effect effect_plain = {gl_source_plain, GL_EDGE_BORDER, false, 25, 0, 0},
                    effect_adjust = {gl_source_adjust, GL_EDGE_BORDER, false, 25, 0, 0},
                    effect_blur = {gl_source_blur, GL_EDGE_CLAMP, true, 50, 7, 0},
                    effect_bloom = {gl_source_bloom, GL_EDGE_CLAMP, true, 50, 1, 0},
                    effect_edges = {gl_source_edges, GL_EDGE_CLAMP, true, 50, 1, 0},
                    effect_chromakey = {gl_source_chromakey, GL_EDGE_CLAMP, true, 50, 1, 0},
                    effect_feedback = {gl_source_feedback, GL_EDGE_CLAMP, false, 25, 0, 0},
                    effect_transform = {gl_source_transform, GL_EDGE_BORDER, false, 25, 0, 0},
                    effect_vignette = {gl_source_vignette, GL_EDGE_BORDER, false, 25, 0, 0},
                    effect_noise = {gl_source_noise, GL_EDGE_BORDER, false, 150, 0, 20},
                    effect_flare = {gl_source_flare, GL_EDGE_BORDER, true, 1500, 0, 0},
                    effect_kaleid = {gl_source_kaleid, GL_EDGE_BORDER, false, 25, 0, 0};

static const Effect *const effects[KIND_COUNT] = {
#define PICTURE_EFFECT(id, name, scalable, help) [KIND_##id] = &effect_##name,
#include "schema/schema_list.h"
};

static const Effect *find_effect(const DrawNode *node) {
    return effects[node->kind] ? effects[node->kind] : &effect_plain;
}

// One pass of an effect.
typedef struct Pass {
    Str text; // source of the function `main`
    bool reduced;
} Pass;

// Splits a file at the lines "//: full" and "//: reduced". *common is the text before the first such line.
static uint32_t split_passes(const char *text, Str *common, Pass passes[MAX_PASSES]) {
    static const char mark[] = "//: ";
    uint32_t count = 0;
    const char *at = strstr(text, mark);
    *common = (Str){text, (size_t)(at - text)};
    while (at && count < MAX_PASSES) {
        const char *body = strchr(at, '\n') + 1, *next = strstr(body, mark);
        passes[count++] = (Pass){{body, next ? (size_t)(next - body) : strlen(body)}, at[sizeof mark - 1] == 'r'};
        at = next;
    }
    return count;
}

static void report(DiagSink *diags, const DrawNode *node, const char *code, Str problem) {
    Text text = text_new(diags->arena);
    size_t line = 0; // only the first line is reported; later errors usually result from the first
    while (line < problem.len && problem.bytes[line] != '\n')
        line++;
    text_add_format(&text, "!%s: %.*s", schema_kinds[node->kind].name, (int)line, problem.bytes);
    diag_report(diags, &(Diag){DIAG_WARNING, node->origin, text_str(&text), .code = code});
}

// Returns the cost of an effect in nanoseconds per pixel.
static double pixel_cost(const DrawNode *node, double detail) {
    const Effect *row = find_effect(node);
    const AttrValue *radius = draw_attr(node, ATTR_RADIUS);
    if (gl_has_shader(node))
        return 50.0 * gl_shader_passes(node);
    if (node->kind == KIND_WINDOW)
        return 0; // the picture itself is always drawn
    double reach = !radius ? 10 : detail * (fabs(radius->as.numbers[0]) + fabs(radius->as.numbers[1])) / 2;
    double octaves = row->octave_cost > 0 ? fmax(1, draw_number(node, ATTR_OCTAVES)) : 0;
    return row->cost + row->radius_cost * reach + row->octave_cost * octaves;
}

double gl_effect_cost(const GlEffect *effect) {
    return (double)effect->width * effect->height * pixel_cost(effect->node, effect->detail);
}

// Adds the functions `source` and `source_at`. If `merged` is true, these functions read the composite of all inputs,
// otherwise the first input.
static void add_source(Text *text, const GlEffect *effect, bool merged, bool reduced) {
    const char *name = merged ? "first" : "texture0";
    bool same = merged || (effect->count > 0 && gl_fits(effect, effect->inputs[0])), near = same && !reduced;
    if (effect->count == 0) {
        text_add_c(text, "vec4 source(vec2 uv) { return vec4(0.0); }\nvec4 source_at(ivec2 d) { return vec4(0.0); }\n");
        return;
    }
    text_add_format(text, "vec4 source(vec2 uv) { return take(%s, uv); }\n", name);
    if (near)
        text_add_format(text, "vec4 source_at(ivec2 d) { return texel(%s, here() + d); }\n", name);
    else
        text_add_c(text, "vec4 source_at(ivec2 d) { return source(coord + vec2(d) / size); }\n");
}

// Returns the program of a pass. If the program does not compile, reports this and returns 0. If the composite mode is
// unknown, only returns 0.
static unsigned build_pass(Gl *gl, Arena *arena, const GlEffect *effect, const Effect *kind, Str common, Pass pass,
                           DiagSink *diags) {
    Text text = text_new(arena);
    GlShaderError error;
    bool merged = kind->merges && effect->count > 1;
    if (!gl_add_input_composite(&text, effect, gl_edge(effect->node, kind->edge)))
        return 0;
    add_source(&text, effect, merged, pass.reduced);
    text_add_c(&text, "vec4 previous(vec2 uv) { return take(last, uv); }\n"
                      "vec4 previous_at(ivec2 d) { return texel(last, here() + d); }\n");
    text_add_c(&text, gl_source_common);
    text_add(&text, common);
    text_add(&text, pass.text);
    unsigned program = gl_program(gl, arena, str_from(gl_quad), text_str(&text), &error);
    if (!program)
        report(diags, effect->node, "bad-shader", error.text);
    return program;
}

GlImage gl_effect(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *diags) {
    NodeKind node = (NodeKind)effect->node->kind;
    const GlImage none = {0};
    const Pass merging = {STR("void main() { color = merged_here(); }\n"), false};
    if (gl_has_shader(effect->node))
        return gl_shader(gl, arena, effect, diags);
    // Without inputs, effects other than noise result in a transparent picture.
    const Effect *kind = effect->count == 0 && node != KIND_NOISE ? &effect_plain : find_effect(effect->node);
    Str common;
    Pass passes[MAX_PASSES];
    GlPass programs[MAX_PASSES + 1];
    uint32_t count = split_passes(kind->text, &common, passes), first = 0;
    if (kind->merges && effect->count > 1)
        programs[first++] = (GlPass){build_pass(gl, arena, effect, kind, common, merging, diags), false};
    for (uint32_t i = 0; i < count; i++)
        programs[first + i] =
            (GlPass){build_pass(gl, arena, effect, kind, common, passes[i], diags), passes[i].reduced};
    for (uint32_t i = 0; i < first + count; i++)
        if (!programs[i].program)
            return none;
    GlImage out;
    return gl_run_passes(gl, arena, effect, programs, first + count, &out) ? out : none;
}
