// blend.h: compositing of two colours (spec canvas.md 4) by the formulas of composite_list.h.
#pragma once

#include "schema/table.h"

#include <math.h>
#include <stdbool.h>

static inline float blend_soft_light(float s, float d) {
    float deep = d <= 0.25f ? ((16 * d - 12) * d + 4) * d : sqrtf(d);
    return s <= 0.5f ? d - (1 - 2 * s) * d * (1 - d) : d + (2 * s - 1) * (deep - d);
}

static inline float blend_hard_light(float s, float d) {
    return s <= 0.5f ? 2 * s * d : 2 * s - 1 + d - (2 * s - 1) * d;
}

// blend_OVER and so on: the formulas. The names of functions in them are those of GLSL.
#define min fminf
#define max fmaxf
#define abs fabsf
#define soft_light blend_soft_light
#define hard_light blend_hard_light
#define FORMULA(id, formula)                                                                                           \
    static inline float blend_##id(float s, float d, float sa, float da) {                                             \
        (void)s, (void)d, (void)sa, (void)da;                                                                          \
        return formula;                                                                                                \
    }
#define PREMULTIPLIED(id, operator, mode, text, formula) FORMULA(id, formula)
#define SEPARABLE(id, operator, mode, text, formula) FORMULA(id, formula)
#include "schema/composite_list.h"
#undef min
#undef max
#undef abs
#undef soft_light
#undef hard_light

// Composites s onto d: stores B(s, d) of the spec in `out`. Colours are premultiplied red, green, blue and alpha, and
// are not clamped. `out` can be the same array as `s` or `d`.
void blend_colors(CompositeMode mode, const float s[4], const float d[4], float out[4]);
// Returns true if a transparent source changes nothing.
bool blend_is_bounded(CompositeMode mode);
