// input_composite.c: see input_composite.h.
#include "gl/input_composite.h"

#include "gl/context.h"

GlEdge gl_edge(const DrawNode *node, GlEdge default_edge) {
    const AttrValue *repeat = draw_attr(node, ATTR_REPEAT);
    if (draw_attr(node, ATTR_BORDER))
        return GL_EDGE_BORDER;
    return repeat && (repeat->as.numbers[0] != 0 || repeat->as.numbers[1] != 0) ? GL_EDGE_REPEAT : default_edge;
}

// OpenGL ES has no border colours. Therefore the shader itself reads four texels and interpolates between them.
static const char border_sampling[] =
    "vec4 texel(sampler2D t, ivec2 p) {\n"
    "    ivec2 s = textureSize(t, 0);\n"
    "    return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, s)) ? texelFetch(t, p, 0) : border;\n"
    "}\n";
static const char repeat_sampling[] =
    "vec4 texel(sampler2D t, ivec2 p) {\n"
    "    ivec2 s = textureSize(t, 0), far = 1024 * s, c = clamp(p, ivec2(0), s - 1);\n"
    "    ivec2 r = (clamp(p, -far, far) + far) % s;\n" // % is undefined for negative numbers
    "    return texelFetch(t, ivec2(repeated.x ? r.x : c.x, repeated.y ? r.y : c.y), 0);\n"
    "}\n";
static const char clamped_sampling[] = "vec4 texel(sampler2D t, ivec2 p) {\n"
                                       "    return texelFetch(t, clamp(p, ivec2(0), textureSize(t, 0) - 1), 0);\n"
                                       "}\n";
static const char smooth_sampling[] =
    "vec4 take(sampler2D t, vec2 uv) {\n"
    "    vec2 p = uv * vec2(textureSize(t, 0)) - 0.5;\n"
    "    vec2 f = fract(p);\n"
    "    ivec2 i = ivec2(floor(p));\n"
    "    vec4 low = mix(texel(t, i), texel(t, i + ivec2(1, 0)), f.x);\n"
    "    vec4 high = mix(texel(t, i + ivec2(0, 1)), texel(t, i + ivec2(1, 1)), f.x);\n"
    "    return mix(low, high, f.y);\n"
    "}\n";
static const char nearest_sampling[] = "vec4 take(sampler2D t, vec2 uv) {\n"
                                       "    return texel(t, ivec2(floor(uv * vec2(textureSize(t, 0)))));\n"
                                       "}\n";
static const char filtered_sampling[] = "vec4 take(sampler2D t, vec2 uv) { return texture(t, uv); }\n";

// The formulas of composite_list.h, in GLSL. Those that no mode of pictures uses are left out of the program.
#define FORMULA(id, formula) __attribute__((unused)) static const char formula_##id[] = #formula;
#define PREMULTIPLIED(id, operator, mode, text, formula) FORMULA(id, formula)
#define SEPARABLE(id, operator, mode, text, formula) FORMULA(id, formula)
#include "schema/composite_list.h"

static const struct {
    const char *colour;
    const char *alpha;
} combining[] = {
#define MIX(id, text, colour, alpha) [MIX_##id] = {formula_##colour, formula_##alpha},
#include "schema/composite_list.h"
    [MIX_UNKNOWN] = {"d", "d"},
};

static void add_sampling(Text *out, const DrawNode *node, GlEdge edge) {
    bool nearest = draw_flag(node, ATTR_NEAREST);
    text_add_c(out, edge == GL_EDGE_BORDER   ? border_sampling
                    : edge == GL_EDGE_REPEAT ? repeat_sampling
                                             : clamped_sampling);
    text_add_c(out, nearest                 ? nearest_sampling
                    : edge == GL_EDGE_CLAMP ? filtered_sampling // the GPU sampler clamps
                                            : smooth_sampling);
}

// Adds an expression that reads input i: at this pixel if `here` is true, else at `uv`.
static void add_input(Text *out, const GlEffect *effect, uint32_t i, bool here) {
    if (here && gl_fits(effect, effect->inputs[i]))
        text_add_format(out, "texelFetch(texture%u, here(), 0)", i);
    else
        text_add_format(out, "take(texture%u, %s)", i, here ? "coord" : "uv");
}

static void add_merged(Text *out, const GlEffect *effect, bool here) {
    text_add_format(out, "vec4 %s {\n    vec4 m = vec4(0.0);\n", here ? "merged_here()" : "merged(vec2 uv)");
    for (uint32_t i = 0; i < effect->count; i++) {
        text_add_c(out, i == 0 ? "    m = " : "    m = combined(");
        add_input(out, effect, i, here);
        text_add_c(out, i == 0 ? ";\n" : ", m);\n");
    }
    text_add_c(out, "    return m;\n}\n");
}

bool gl_add_input_composite(Text *out, const GlEffect *effect, GlEdge edge) {
    int how = draw_word(effect->node, ATTR_COMPOSITE);
    if (how == MIX_UNKNOWN && effect->count > 1)
        return false;
    text_add_c(out, gl_header);
    text_add_c(out, "in vec2 coord;\nout vec4 color;\nuniform sampler2D first, last;\nuniform vec4 border;\n"
                    "uniform bvec2 repeated;\nuniform vec2 size;\nuniform int pass;\nuniform float alpha;\n"
                    "ivec2 here() { return ivec2(gl_FragCoord.xy); }\n");
    for (uint32_t i = 0; i < effect->count; i++)
        text_add_format(out, "uniform sampler2D texture%u;\n", i);
    add_sampling(out, effect->node, edge);
    text_add_format(out,
                    "vec4 combined(vec4 s, vec4 d) {\n    float sa = s.a, da = d.a;\n"
                    "    return vec4((%s).rgb, (%s).a);\n}\n",
                    combining[how].colour, combining[how].alpha);
    add_merged(out, effect, false);
    add_merged(out, effect, true);
    return true;
}
