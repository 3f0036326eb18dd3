// blend.c: see blend.h.
#include "draw/blend.h"

#include <math.h>
#include <string.h>

// Many composite modes compute s·f + d·g. The factors f and g are 0, 1, the alpha of the other colour, or 1 minus this
// alpha.
typedef enum Factor { NOTHING, ALL, ALPHA, REST } Factor; // 0, 1, alpha, 1 - alpha

typedef struct Factors {
    bool known;
    Factor of_s;
    Factor of_d;
} Factors;

static const Factors factors[COMPOSITE_COUNT] = {
    [COMPOSITE_CLEAR] = {true, NOTHING, NOTHING}, [COMPOSITE_SRC] = {true, ALL, NOTHING},
    [COMPOSITE_DST] = {true, NOTHING, ALL},       [COMPOSITE_OVER] = {true, ALL, REST},
    [COMPOSITE_DST_OVER] = {true, REST, ALL},     [COMPOSITE_IN] = {true, ALPHA, NOTHING},
    [COMPOSITE_DST_IN] = {true, NOTHING, ALPHA},  [COMPOSITE_OUT] = {true, REST, NOTHING},
    [COMPOSITE_DST_OUT] = {true, NOTHING, REST},  [COMPOSITE_ATOP] = {true, ALPHA, REST},
    [COMPOSITE_DST_ATOP] = {true, REST, ALPHA},   [COMPOSITE_XOR] = {true, REST, REST},
    [COMPOSITE_ADD] = {true, ALL, ALL},
};

static float factor_of(Factor factor, float alpha) {
    return factor == NOTHING ? 0 : factor == ALL ? 1 : factor == ALPHA ? alpha : 1 - alpha;
}

static float soft_light(float s, float d) {
    float deep = d <= 0.25f ? ((16 * d - 12) * d + 4) * d : sqrtf(d);
    return s <= 0.5f ? d - (1 - 2 * s) * d * (1 - d) : d + (2 * s - 1) * (deep - d);
}

static float hard_light(float s, float d) {
    return s <= 0.5f ? 2 * s * d : 2 * s - 1 + d - (2 * s - 1) * d;
}

// Blends one channel of two non-premultiplied colours.
static float blend_channel(CompositeMode mode, float s, float d) {
    switch (mode) {
    case COMPOSITE_MULTIPLY:
        return s * d;
    case COMPOSITE_SCREEN:
        return s + d - s * d;
    case COMPOSITE_EXCLUSION:
        return s + d - 2 * s * d;
    case COMPOSITE_OVERLAY:
        return hard_light(d, s);
    case COMPOSITE_DARKEN:
        return fminf(s, d);
    case COMPOSITE_LIGHTEN:
        return fmaxf(s, d);
    case COMPOSITE_COLOR_DODGE:
        return d <= 0 ? 0 : s >= 1 ? 1 : fminf(1, d / (1 - s));
    case COMPOSITE_COLOR_BURN:
        return d >= 1 ? 1 : s <= 0 ? 0 : 1 - fminf(1, (1 - d) / s);
    case COMPOSITE_HARD_LIGHT:
        return hard_light(s, d);
    case COMPOSITE_SOFT_LIGHT:
        return soft_light(s, d);
    case COMPOSITE_DIFFERENCE:
        return fabsf(s - d);
    default:
        return s;
    }
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

static void blend_whole(CompositeMode mode, const float s[3], const float d[3], float out[3]) {
    bool hue_of_s = mode == COMPOSITE_HUE || mode == COMPOSITE_COLOR;
    memcpy(out, hue_of_s ? s : d, 3 * sizeof *out);
    if (mode == COMPOSITE_HUE)
        set_saturation(out, saturation_of(d));
    else if (mode == COMPOSITE_SATURATION)
        set_saturation(out, saturation_of(s));
    set_luminance(out, luminance(mode == COMPOSITE_LUMINOSITY ? s : d));
}

void blend_colors(CompositeMode mode, const float s[4], const float d[4], float out[4]) {
    float sa = s[3], da = d[3], plain_s[3], plain_d[3], mixed[3], result[4];
    const Factors *f = &factors[mode];
    if (f->known || mode == COMPOSITE_MODULATE) {
        float of_s = factor_of(f->of_s, da), of_d = factor_of(f->of_d, sa);
        for (int k = 0; k < 4; k++)
            out[k] = f->known ? s[k] * of_s + d[k] * of_d : s[k] * d[k];
        return;
    }
    for (int k = 0; k < 3; k++) {
        plain_s[k] = sa > 0 ? s[k] / sa : 0;
        plain_d[k] = da > 0 ? d[k] / da : 0;
        mixed[k] = blend_channel(mode, plain_s[k], plain_d[k]);
    }
    if (mode == COMPOSITE_HUE || mode == COMPOSITE_SATURATION || mode == COMPOSITE_COLOR ||
        mode == COMPOSITE_LUMINOSITY)
        blend_whole(mode, plain_s, plain_d, mixed);
    for (int k = 0; k < 3; k++)
        result[k] = s[k] * (1 - da) + d[k] * (1 - sa) + sa * da * mixed[k];
    result[3] = sa + da * (1 - sa);
    memcpy(out, result, sizeof result);
}
