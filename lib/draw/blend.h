// blend.h: compositing of two colours (spec canvas.md 4), for canvases that Cairo does not composite.
#ifndef PETRI_DRAW_BLEND_H
#define PETRI_DRAW_BLEND_H

#include "schema/table.h"

// Computes B(s, d). Colours are red, green, blue and alpha, premultiplied, and are not clamped. `out` may be `s` or
// `d`.
void blend_colors(CompositeMode mode, const float s[4], const float d[4], float out[4]);

#endif
