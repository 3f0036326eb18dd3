// blend.h: compositing of two colours (spec canvas.md 4), where Cairo cannot do it.
#pragma once

#include "schema/table.h"

// Composites s onto d: stores B(s, d) of the spec in `out`. Colours are premultiplied red, green, blue and alpha, and
// are not clamped. `out` can be the same array as `s` or `d`.
void blend_colors(CompositeMode mode, const float s[4], const float d[4], float out[4]);
