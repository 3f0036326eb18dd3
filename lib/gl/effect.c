// effect.c: runs effects; see effect.h. The source of an effect is a file in shaders/. The file begins with the
// declarations that all passes share. The passes follow. Each pass is a line with the size of its target (split_passes)
// and a function `main`.
#include "gl/effect.h"

#include "gl/input_composite.h"
#include "gl/internal.h"
#include "gl/shader.h"
#include "gl/shader_sources.h"
#include "gl/uniforms.h"

#include <math.h>

enum { MAX_PASSES = 8 };

typedef struct Effect {
    const char *text;
    GlEdge edge;
    bool merges; // true if several inputs are composited in an additional first pass
} Effect;

static Effect find_effect(NodeKind kind) {
    switch (kind) {
    case KIND_ADJUST:
        return (Effect){gl_source_adjust, GL_EDGE_BORDER, false};
    case KIND_BLUR:
        return (Effect){gl_source_blur, GL_EDGE_CLAMP, true};
    case KIND_BLOOM:
        return (Effect){gl_source_bloom, GL_EDGE_CLAMP, true};
    case KIND_EDGES:
        return (Effect){gl_source_edges, GL_EDGE_CLAMP, true};
    case KIND_CHROMAKEY:
        return (Effect){gl_source_chromakey, GL_EDGE_CLAMP, true};
    case KIND_FEEDBACK:
        return (Effect){gl_source_feedback, GL_EDGE_CLAMP, false};
    case KIND_PICTURE_TRANSFORM:
        return (Effect){gl_source_transform, GL_EDGE_BORDER, false};
    case KIND_VIGNETTE:
        return (Effect){gl_source_vignette, GL_EDGE_BORDER, false};
    case KIND_NOISE:
        return (Effect){gl_source_noise, GL_EDGE_BORDER, false};
    case KIND_FLARE:
        return (Effect){gl_source_flare, GL_EDGE_BORDER, true};
    case KIND_KALEID:
        return (Effect){gl_source_kaleid, GL_EDGE_BORDER, false};
    default:
        return (Effect){gl_source_plain, GL_EDGE_BORDER, false};
    }
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

void gl_report(DiagSink *faults, const DrawNode *node, const char *code, Str problem) {
    Text text = text_new(faults->arena);
    size_t line = 0; // only the first line is reported; later errors usually result from the first
    while (line < problem.len && problem.bytes[line] != '\n')
        line++;
    text_add_format(&text, "!%s: %.*s", schema_kinds[node->kind].name, (int)line, problem.bytes);
    diag_report(faults, &(Diag){DIAG_WARNING, node->origin, text_str(&text), .code = code});
}

// Returns the cost of an effect in nanoseconds per pixel, as measured with llvmpipe on two processors. A GPU is faster,
// but the work limit must not depend on the machine.
static double pixel_cost(const DrawNode *node, double detail) {
    const AttrValue *radius = draw_attr(node, ATTR_RADIUS);
    if (gl_has_shader(node))
        return 50.0 * gl_shader_passes(node);
    double reach = !radius ? 10 : detail * (fabs(radius->as.numbers[0]) + fabs(radius->as.numbers[1])) / 2;
    switch (node->kind) {
    case KIND_BLUR:
        return 50 + 7 * reach;
    case KIND_BLOOM:
    case KIND_EDGES:
    case KIND_CHROMAKEY:
        return 50 + reach;
    case KIND_NOISE:
        return 150 + 20 * fmax(1, draw_number(node, ATTR_OCTAVES));
    case KIND_FLARE:
        return 1500;
    case KIND_WINDOW:
        return 0; // the picture itself is always drawn
    default:
        return 25;
    }
}

double gl_effect_cost(const GlEffect *effect) {
    return (double)effect->width * effect->height * pixel_cost(effect->node, effect->detail);
}

int gl_downsample(const DrawNode *node) {
    double x = draw_number(node, ATTR_DOWNSAMPLE);
    return x >= 2 ? x < 64 ? (int)x : 64 : 1;
}

// Returns the processor time that the programs of scripts may still take in this picture.
static double seconds_left(const Gl *gl) {
    const Budget *budget = gl->budget;
    return budget ? 1e-9 * BUDGET_UNIT_TIME * (double)(budget->work_limit - budget->work) - gl->shader_seconds
                  : INFINITY;
}

// Notes that a shader needs `seconds` for each of the remaining passes. Its pixels may differ in cost.
static void refuse_passes(Gl *gl, double seconds, uint32_t passes) {
    static const double UNEVEN = 1.5;
    gl->budget->refused_time +=
        1e9 * ((isinf(gl->shader_seconds) ? 0 : gl->shader_seconds) + UNEVEN * seconds * passes);
}

bool gl_run_passes(Gl *gl, const GlEffect *effect, const GlPass *passes, uint32_t count, GlImage *out) {
    GlImage first = {0}, last = effect->last;
    int reduction = gl_downsample(effect->node);
    // A script's own program may leave out pixels. The target is then cleared first, because it can contain an earlier
    // picture.
    bool good = true, own = gl_has_shader(effect->node);
    for (uint32_t i = 0; i < count && good; i++) {
        int down = passes[i].reduced ? reduction : 1;
        int width = effect->width / down > 0 ? effect->width / down : 1;
        int height = effect->height / down > 0 ? effect->height / down : 1;
        GlImage target = gl_image_new(gl, width, height, effect->format);
        good = target.texture != 0;
        if (good) {
            GlState state = {effect, first, last, target, (int)i, (int)count, down};
            gl_target(gl, target);
            if (own) {
                glClearColor(0, 0, 0, 0);
                glClear(GL_COLOR_BUFFER_BIT);
            }
            gl_set_uniforms(gl, passes[i].program, &state);
            if (own) {
                double taken, needed, left = seconds_left(gl);
                taken = gl_draw_quad_within(gl, passes[i].program, width, height, left, &needed);
                good = taken < INFINITY;
                if (!good && gl->budget)
                    refuse_passes(gl, needed, count - i);
                gl->shader_seconds += taken;
            } else {
                gl_draw_quad(gl, passes[i].program);
            }
        }
        if (i > 0 && last.texture != first.texture)
            gl_image_free(gl, last);
        last = target;
        first = i == 0 ? target : first;
    }
    if (first.texture != last.texture)
        gl_image_free(gl, first);
    *out = last;
    return good;
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
                           DiagSink *faults) {
    Text text = text_new(arena);
    GlShaderError fault;
    bool merged = kind->merges && effect->count > 1;
    if (!gl_add_input_composite(&text, effect, gl_edge(effect->node, kind->edge)))
        return 0;
    add_source(&text, effect, merged, pass.reduced);
    text_add_c(&text, "vec4 previous(vec2 uv) { return take(last, uv); }\n"
                      "vec4 previous_at(ivec2 d) { return texel(last, here() + d); }\n");
    text_add_c(&text, gl_source_common);
    text_add(&text, common);
    text_add(&text, pass.text);
    unsigned program = gl_program(gl, arena, str_from(gl_quad), text_str(&text), &fault);
    if (!program)
        gl_report(faults, effect->node, "bad-shader", fault.text);
    return program;
}

GlImage gl_effect(Gl *gl, Arena *arena, const GlEffect *effect, DiagSink *faults) {
    NodeKind node = (NodeKind)effect->node->kind;
    const GlImage none = {0};
    const Pass merging = {STR("void main() { color = merged_here(); }\n"), false};
    if (gl_has_shader(effect->node))
        return gl_shader(gl, arena, effect, faults);
    Effect kind = find_effect(node);
    Str common;
    Pass passes[MAX_PASSES];
    GlPass programs[MAX_PASSES + 1];
    uint32_t count = split_passes(kind.text, &common, passes), first = 0;
    if (effect->count == 0 && node != KIND_NOISE)
        kind = find_effect(KIND_WINDOW),
        count = split_passes(kind.text, &common, passes); // results in a transparent picture
    if (kind.merges && effect->count > 1)
        programs[first++] = (GlPass){build_pass(gl, arena, effect, &kind, common, merging, faults), false};
    for (uint32_t i = 0; i < count; i++)
        programs[first + i] =
            (GlPass){build_pass(gl, arena, effect, &kind, common, passes[i], faults), passes[i].reduced};
    for (uint32_t i = 0; i < first + count; i++)
        if (!programs[i].program)
            return none;
    GlImage out;
    return gl_run_passes(gl, effect, programs, first + count, &out) ? out : none;
}
