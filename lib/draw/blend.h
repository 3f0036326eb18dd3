// blend.h: how two colours combine on a canvas (spec canvas.md 4), where Cairo does not do it.
#ifndef PETRI_DRAW_BLEND_H
#define PETRI_DRAW_BLEND_H

#include "schema/table.h"

// B(s, d) of red, green, blue and alpha, multiplied by alpha; nothing is cut off. `out` may be one of the two.
void blend_colors(CompositeMode mode, const float s[4], const float d[4], float out[4]);

#endif
