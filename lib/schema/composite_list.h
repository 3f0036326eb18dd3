// composite_list.h: the compositing modes: COMPOSITE(ID, Cairo's operator, "word", formula). Cairo has no operator for
// modulate, so its row names the most similar one. word_list.h has alternative words for these modes.
//
// Formulas are valid in C and GLSL. s and d are a channel of source and destination, sa and da are their alphas:
//   PREMULTIPLIED(result)  of premultiplied channels, alpha included
//   SEPARABLE(blend)       of channels that are not premultiplied; the result is s (1 - da) + d (1 - sa) + sa da blend
//   NONSEPARABLE(hue, saturation, luminosity)
//                          like SEPARABLE, where the blend has these properties of s or d
// clang-format off

COMPOSITE(MODULATE, CAIRO_OPERATOR_MULTIPLY, "modulate", PREMULTIPLIED(s * d))
COMPOSITE(CLEAR, CAIRO_OPERATOR_CLEAR, "clear", PREMULTIPLIED(s * 0.0f + d * 0.0f))
COMPOSITE(SRC, CAIRO_OPERATOR_SOURCE, "src", PREMULTIPLIED(s + d * 0.0f))
COMPOSITE(DST, CAIRO_OPERATOR_DEST, "dst", PREMULTIPLIED(s * 0.0f + d))
COMPOSITE(OVER, CAIRO_OPERATOR_OVER, "over", PREMULTIPLIED(s + d * (1.0f - sa)))
COMPOSITE(DST_OVER, CAIRO_OPERATOR_DEST_OVER, "dst_over", PREMULTIPLIED(s * (1.0f - da) + d))
COMPOSITE(IN, CAIRO_OPERATOR_IN, "in", PREMULTIPLIED(s * da + d * 0.0f))
COMPOSITE(DST_IN, CAIRO_OPERATOR_DEST_IN, "dst_in", PREMULTIPLIED(s * 0.0f + d * sa))
COMPOSITE(OUT, CAIRO_OPERATOR_OUT, "out", PREMULTIPLIED(s * (1.0f - da) + d * 0.0f))
COMPOSITE(DST_OUT, CAIRO_OPERATOR_DEST_OUT, "dst_out", PREMULTIPLIED(s * 0.0f + d * (1.0f - sa)))
COMPOSITE(ATOP, CAIRO_OPERATOR_ATOP, "atop", PREMULTIPLIED(s * da + d * (1.0f - sa)))
COMPOSITE(DST_ATOP, CAIRO_OPERATOR_DEST_ATOP, "dst_atop", PREMULTIPLIED(s * (1.0f - da) + d * sa))
COMPOSITE(XOR, CAIRO_OPERATOR_XOR, "xor", PREMULTIPLIED(s * (1.0f - da) + d * (1.0f - sa)))
COMPOSITE(ADD, CAIRO_OPERATOR_ADD, "add", PREMULTIPLIED(s + d))
COMPOSITE(MULTIPLY, CAIRO_OPERATOR_MULTIPLY, "multiply", SEPARABLE(s * d))
COMPOSITE(SCREEN, CAIRO_OPERATOR_SCREEN, "screen", SEPARABLE(s + d - s * d))
COMPOSITE(OVERLAY, CAIRO_OPERATOR_OVERLAY, "overlay", SEPARABLE(hard_light(d, s)))
COMPOSITE(DARKEN, CAIRO_OPERATOR_DARKEN, "darken", SEPARABLE(min(s, d)))
COMPOSITE(LIGHTEN, CAIRO_OPERATOR_LIGHTEN, "lighten", SEPARABLE(max(s, d)))
COMPOSITE(COLOR_DODGE, CAIRO_OPERATOR_COLOR_DODGE, "color_dodge", SEPARABLE(d <= 0.0f ? 0.0f : s >= 1.0f ? 1.0f : min(1.0f, d / (1.0f - s))))
COMPOSITE(COLOR_BURN, CAIRO_OPERATOR_COLOR_BURN, "color_burn", SEPARABLE(d >= 1.0f ? 1.0f : s <= 0.0f ? 0.0f : 1.0f - min(1.0f, (1.0f - d) / s)))
COMPOSITE(HARD_LIGHT, CAIRO_OPERATOR_HARD_LIGHT, "hard_light", SEPARABLE(hard_light(s, d)))
COMPOSITE(SOFT_LIGHT, CAIRO_OPERATOR_SOFT_LIGHT, "soft_light", SEPARABLE(soft_light(s, d)))
COMPOSITE(DIFFERENCE, CAIRO_OPERATOR_DIFFERENCE, "difference", SEPARABLE(abs(s - d)))
COMPOSITE(EXCLUSION, CAIRO_OPERATOR_EXCLUSION, "exclusion", SEPARABLE(s + d - 2.0f * s * d))
COMPOSITE(HUE, CAIRO_OPERATOR_HSL_HUE, "hue", NONSEPARABLE(s, d, d))
COMPOSITE(SATURATION, CAIRO_OPERATOR_HSL_SATURATION, "saturation", NONSEPARABLE(d, s, d))
COMPOSITE(COLOR, CAIRO_OPERATOR_HSL_COLOR, "color", NONSEPARABLE(s, s, d))
COMPOSITE(LUMINOSITY, CAIRO_OPERATOR_HSL_LUMINOSITY, "luminosity", NONSEPARABLE(d, d, s))
// clang-format on

#undef COMPOSITE
