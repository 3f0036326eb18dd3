// colour_formulas.h: conversions of colours (spec pictures.md 1.4), which are valid in C and GLSL. embed.sh copies this
// file into shaders that include it.
#pragma once

// Weights of linear red, green and blue in the luminance.
#define LUMINANCE_WEIGHTS 0.2126, 0.7152, 0.0722
// Return the sRGB value of a linear value, and the linear value of an sRGB value. `power` is the function pow.
#define SRGB_ENCODE(c, power) ((c) <= 0.0031308 ? 12.92 * (c) : 1.055 * power(c, 1.0 / 2.4) - 0.055)
#define SRGB_DECODE(e, power) ((e) <= 0.04045 ? (e) / 12.92 : power(((e) + 0.055) / 1.055, 2.4))
