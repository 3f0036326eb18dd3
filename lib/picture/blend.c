// blend.c: see blend.h.
#include "picture/blend.h"

#include <math.h>
#include <string.h>

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

static float unpremultiply(float channel, float alpha) {
    return alpha > 0 ? channel / alpha : 0;
}

void blend_colors(CompositeMode mode, const float source[4], const float onto[4], float out[4]) {
    const float sa = source[3], da = onto[3];
    float mixed[3], result[4];
    switch (mode) {
#define PREMULTIPLIED(id, operator, mode, text, formula)                                                               \
    case COMPOSITE_##id:                                                                                               \
        for (int k = 0; k < 4; k++)                                                                                    \
            out[k] = blend_##id(source[k], onto[k], sa, da);                                                           \
        return;
#define SEPARABLE(id, operator, mode, text, formula)                                                                   \
    case COMPOSITE_##id:                                                                                               \
        for (int k = 0; k < 3; k++)                                                                                    \
            mixed[k] = blend_##id(unpremultiply(source[k], sa), unpremultiply(onto[k], da), sa, da);                   \
        break;
#define NONSEPARABLE(id, operator, mode, text, hue, saturation, luminosity)                                            \
    case COMPOSITE_##id: {                                                                                             \
        float s[3], d[3];                                                                                              \
        for (int k = 0; k < 3; k++) {                                                                                  \
            s[k] = unpremultiply(source[k], sa);                                                                       \
            d[k] = unpremultiply(onto[k], da);                                                                         \
        }                                                                                                              \
        blend_properties(hue, saturation, luminosity, mixed);                                                          \
        break;                                                                                                         \
    }
#include "schema/composite_list.h"
    case COMPOSITE_COUNT:
        return;
    }
    for (int k = 0; k < 3; k++)
        result[k] = source[k] * (1 - da) + onto[k] * (1 - sa) + sa * da * mixed[k];
    result[3] = sa + da * (1 - sa);
    memcpy(out, result, sizeof result);
}

bool blend_is_bounded(CompositeMode mode) {
    const float nothing[4] = {0}, opaque[4] = {1, 1, 1, 1};
    float out[4];
    blend_colors(mode, nothing, opaque, out);
    return out[3] == 1;
}
