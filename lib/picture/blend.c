// blend.c: see blend.h.
#include "picture/blend.h"

#include <math.h>
#include <string.h>

static float soft_light(float s, float d) {
    float deep = d <= 0.25f ? ((16 * d - 12) * d + 4) * d : sqrtf(d);
    return s <= 0.5f ? d - (1 - 2 * s) * d * (1 - d) : d + (2 * s - 1) * (deep - d);
}

static float hard_light(float s, float d) {
    return s <= 0.5f ? 2 * s * d : 2 * s - 1 + d - (2 * s - 1) * d;
}

static float luminance(const float c[3]) {
    return 0.3f * c[0] + 0.59f * c[1] + 0.11f * c[2];
}

static float saturation_of(const float c[3]) {
    return fmaxf(fmaxf(c[0], c[1]), c[2]) - fminf(fminf(c[0], c[1]), c[2]);
}

// Sets the luminance of a colour, and desaturates it as far as needed to stay within 0 to 1.
static void set_luminance(float c[3], float wanted) {
    float change = wanted - luminance(c), scale = 1;
    for (int k = 0; k < 3; k++)
        c[k] += change;
    float min = fminf(fminf(c[0], c[1]), c[2]), max = fmaxf(fmaxf(c[0], c[1]), c[2]);
    scale *= min < 0 && wanted > min ? wanted / (wanted - min) : 1;
    scale *= max > 1 && max > wanted ? (1 - wanted) / (max - wanted) : 1;
    for (int k = 0; k < 3; k++)
        c[k] = wanted + (c[k] - wanted) * scale;
}

// Scales the channels so that the smallest becomes 0 and the largest `wanted`. Greys become black.
static void set_saturation(float c[3], float wanted) {
    float min = fminf(fminf(c[0], c[1]), c[2]), now = saturation_of(c);
    for (int k = 0; k < 3; k++)
        c[k] = now > 0 ? (c[k] - min) * wanted / now : 0;
}

// Stores a colour with the hue, saturation and luminosity of three colours, each of which is one of two.
static void blend_properties(const float hue[3], const float saturation[3], const float luminosity[3], float out[3]) {
    memcpy(out, hue, 3 * sizeof *out);
    if (hue != saturation)
        set_saturation(out, saturation_of(saturation));
    set_luminance(out, luminance(luminosity));
}

// GLSL's names for functions in the formulas of composite_list.h
#define min fminf
#define max fmaxf
#define abs fabsf

static float unpremultiply(float channel, float alpha) {
    return alpha > 0 ? channel / alpha : 0;
}

void blend_colors(CompositeMode mode, const float source[4], const float onto[4], float out[4]) {
    const float sa = source[3], da = onto[3];
    float mixed[3], result[4];
    switch (mode) {
#define PREMULTIPLIED(result)                                                                                          \
    for (int k = 0; k < 4; k++) {                                                                                      \
        const float s = source[k], d = onto[k];                                                                        \
        out[k] = result;                                                                                               \
    }                                                                                                                  \
    return;
#define SEPARABLE(blend)                                                                                               \
    for (int k = 0; k < 3; k++) {                                                                                      \
        const float s = unpremultiply(source[k], sa), d = unpremultiply(onto[k], da);                                  \
        mixed[k] = blend;                                                                                              \
    }                                                                                                                  \
    break;
#define NONSEPARABLE(hue, saturation, luminosity)                                                                      \
    {                                                                                                                  \
        float s[3], d[3];                                                                                              \
        for (int k = 0; k < 3; k++) {                                                                                  \
            s[k] = unpremultiply(source[k], sa);                                                                       \
            d[k] = unpremultiply(onto[k], da);                                                                         \
        }                                                                                                              \
        blend_properties(hue, saturation, luminosity, mixed);                                                          \
        break;                                                                                                         \
    }
#define COMPOSITE(id, operator, text, formula)                                                                         \
    case COMPOSITE_##id:                                                                                               \
        formula
#include "schema/composite_list.h"
    case COMPOSITE_COUNT:
        return;
    }
    for (int k = 0; k < 3; k++)
        result[k] = source[k] * (1 - da) + onto[k] * (1 - sa) + sa * da * mixed[k];
    result[3] = sa + da * (1 - sa);
    memcpy(out, result, sizeof result);
}
