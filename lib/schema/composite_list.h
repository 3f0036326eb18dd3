// composite_list.h: all modes in which colours are combined, and one formula for each. C, GLSL, and the names of
// Cairo's operators, of OpenGL's equations and of Canvas 2D's modes are made from these rows.
//
// Formulas are valid in C and GLSL. s and d are a channel of source and destination, sa and da are their alphas.
//
// Modes of canvases (spec canvas.md 4). Cairo and Canvas 2D have no modulate, so its row names the most similar mode.
// An empty mode of Canvas 2D draws nothing. word_list.h has alternative words.
//
// PREMULTIPLIED(ID, Cairo's operator, "mode of Canvas 2D", "word", formula): of premultiplied channels, alpha included
//
// SEPARABLE(ID, operator, "mode", "word", formula): of channels that are not premultiplied; the result is
//     s (1 - da) + d (1 - sa) + sa da formula
// NONSEPARABLE(ID, operator, "mode", "word", hue, saturation, luminosity): like SEPARABLE, of a colour with these
//     properties of s or d
// COMPOSITE(ID, operator, "mode", "word"): each of the above
//
// Modes of pictures, in linear light (spec pictures.md 3.5):
// FORMULA(ID, formula): a further formula, for MIX
// MIX(ID, "word", ID of the formula for the colour, ID of that for the alpha): of premultiplied channels
//
// Modes of 3-D scenes (spec canvas3d.md 2), which OpenGL computes:
// MIX3D(ID, "word", equation, factor of the source, factor of the destination)
// clang-format off
#ifndef COMPOSITE
#define COMPOSITE(id, operator, mode, text)
#endif
#ifndef PREMULTIPLIED
#define PREMULTIPLIED(id, operator, mode, text, formula) COMPOSITE(id, operator, mode, text)
#endif
#ifndef SEPARABLE
#define SEPARABLE(id, operator, mode, text, formula) COMPOSITE(id, operator, mode, text)
#endif
#ifndef NONSEPARABLE
#define NONSEPARABLE(id, operator, mode, text, hue, saturation, luminosity) COMPOSITE(id, operator, mode, text)
#endif
#ifndef FORMULA
#define FORMULA(id, formula)
#endif
#ifndef MIX
#define MIX(id, text, colour, alpha)
#endif
#ifndef MIX3D
#define MIX3D(id, text, equation, source, destination)
#endif

PREMULTIPLIED(MODULATE, CAIRO_OPERATOR_MULTIPLY, "multiply", "modulate", s * d)
PREMULTIPLIED(CLEAR, CAIRO_OPERATOR_CLEAR, "clear", "clear", s * 0.0f + d * 0.0f)
PREMULTIPLIED(SRC, CAIRO_OPERATOR_SOURCE, "copy", "src", s + d * 0.0f)
PREMULTIPLIED(DST, CAIRO_OPERATOR_DEST, "", "dst", s * 0.0f + d)
PREMULTIPLIED(OVER, CAIRO_OPERATOR_OVER, "source-over", "over", s + d * (1.0f - sa))
PREMULTIPLIED(DST_OVER, CAIRO_OPERATOR_DEST_OVER, "destination-over", "dst_over", s * (1.0f - da) + d)
PREMULTIPLIED(IN, CAIRO_OPERATOR_IN, "source-in", "in", s * da + d * 0.0f)
PREMULTIPLIED(DST_IN, CAIRO_OPERATOR_DEST_IN, "destination-in", "dst_in", s * 0.0f + d * sa)
PREMULTIPLIED(OUT, CAIRO_OPERATOR_OUT, "source-out", "out", s * (1.0f - da) + d * 0.0f)
PREMULTIPLIED(DST_OUT, CAIRO_OPERATOR_DEST_OUT, "destination-out", "dst_out", s * 0.0f + d * (1.0f - sa))
PREMULTIPLIED(ATOP, CAIRO_OPERATOR_ATOP, "source-atop", "atop", s * da + d * (1.0f - sa))
PREMULTIPLIED(DST_ATOP, CAIRO_OPERATOR_DEST_ATOP, "destination-atop", "dst_atop", s * (1.0f - da) + d * sa)
PREMULTIPLIED(XOR, CAIRO_OPERATOR_XOR, "xor", "xor", s * (1.0f - da) + d * (1.0f - sa))
PREMULTIPLIED(ADD, CAIRO_OPERATOR_ADD, "lighter", "add", s + d)
SEPARABLE(MULTIPLY, CAIRO_OPERATOR_MULTIPLY, "multiply", "multiply", s * d)
SEPARABLE(SCREEN, CAIRO_OPERATOR_SCREEN, "screen", "screen", s + d - s * d)
SEPARABLE(OVERLAY, CAIRO_OPERATOR_OVERLAY, "overlay", "overlay", hard_light(d, s))
SEPARABLE(DARKEN, CAIRO_OPERATOR_DARKEN, "darken", "darken", min(s, d))
SEPARABLE(LIGHTEN, CAIRO_OPERATOR_LIGHTEN, "lighten", "lighten", max(s, d))
SEPARABLE(COLOR_DODGE, CAIRO_OPERATOR_COLOR_DODGE, "color-dodge", "color_dodge", d <= 0.0f ? 0.0f : s >= 1.0f ? 1.0f : min(1.0f, d / (1.0f - s)))
SEPARABLE(COLOR_BURN, CAIRO_OPERATOR_COLOR_BURN, "color-burn", "color_burn", d >= 1.0f ? 1.0f : s <= 0.0f ? 0.0f : 1.0f - min(1.0f, (1.0f - d) / s))
SEPARABLE(HARD_LIGHT, CAIRO_OPERATOR_HARD_LIGHT, "hard-light", "hard_light", hard_light(s, d))
SEPARABLE(SOFT_LIGHT, CAIRO_OPERATOR_SOFT_LIGHT, "soft-light", "soft_light", soft_light(s, d))
SEPARABLE(DIFFERENCE, CAIRO_OPERATOR_DIFFERENCE, "difference", "difference", abs(s - d))
SEPARABLE(EXCLUSION, CAIRO_OPERATOR_EXCLUSION, "exclusion", "exclusion", s + d - 2.0f * s * d)
NONSEPARABLE(HUE, CAIRO_OPERATOR_HSL_HUE, "hue", "hue", s, d, d)
NONSEPARABLE(SATURATION, CAIRO_OPERATOR_HSL_SATURATION, "saturation", "saturation", d, s, d)
NONSEPARABLE(COLOR, CAIRO_OPERATOR_HSL_COLOR, "color", "color", s, s, d)
NONSEPARABLE(LUMINOSITY, CAIRO_OPERATOR_HSL_LUMINOSITY, "luminosity", "luminosity", d, d, s)

FORMULA(ADD_ALPHA, min(s + d, 1.0f))

MIX(OVER, "over", OVER, OVER)
MIX(DEST_OVER, "dest_over", DST_OVER, DST_OVER)
MIX(LIGHTEN, "lighten", LIGHTEN, LIGHTEN)
MIX(DARKEN, "darken", DARKEN, DARKEN)
MIX(ADD, "add", ADD, ADD_ALPHA)
MIX(DIFFERENCE, "difference", DIFFERENCE, LIGHTEN)
MIX(MULTIPLY, "multiply", MULTIPLY, MULTIPLY)

MIX3D(OVER, "over", GL_FUNC_ADD, GL_ONE, GL_ONE_MINUS_SRC_ALPHA)
MIX3D(SOURCE, "source", GL_FUNC_ADD, GL_ONE, GL_ZERO)
MIX3D(DEST, "dest", GL_FUNC_ADD, GL_ZERO, GL_ONE)
MIX3D(DEST_OVER, "dest_over", GL_FUNC_ADD, GL_ONE_MINUS_DST_ALPHA, GL_ONE)
MIX3D(ADD, "add", GL_FUNC_ADD, GL_ONE, GL_ONE)
MIX3D(SUBTRACT, "subtract", GL_FUNC_SUBTRACT, GL_ONE, GL_ONE)
MIX3D(LIGHTEN, "lighten", GL_MAX, GL_ONE, GL_ONE)
MIX3D(DARKEN, "darken", GL_MIN, GL_ONE, GL_ONE)
// clang-format on

#undef COMPOSITE
#undef PREMULTIPLIED
#undef SEPARABLE
#undef NONSEPARABLE
#undef FORMULA
#undef MIX
#undef MIX3D
