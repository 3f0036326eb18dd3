// mix_list.h: modes that combine pictures, in linear light: MIX(ID, "word", formula of the colour, formula of the
// alpha). C and GLSL are made from the formulas: s and d are premultiplied colours of source and destination, in GLSL
// with all channels, and sa and da are their alphas.
// clang-format off
MIX(OVER, "over", s + d * (1.0f - sa), sa + da * (1.0f - sa))
MIX(DEST_OVER, "dest_over", s * (1.0f - da) + d, sa * (1.0f - da) + da)
MIX(LIGHTEN, "lighten", max(s, d), max(sa, da))
MIX(DARKEN, "darken", min(s, d), min(sa, da))
MIX(ADD, "add", s + d, min(sa + da, 1.0f))
MIX(DIFFERENCE, "difference", abs(d - s), max(sa, da))
MIX(MULTIPLY, "multiply", s * d, sa * da)
// clang-format on

#undef MIX
