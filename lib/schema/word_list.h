// word_list.h: words for attributes of drawing nodes: WORD(TYPE, "word", value). If several words have the same
// meaning, the first is preferred; the preferred words of COMPOSITE are in composite_list.h. The words of MIX are in
// mix_list.h.
// clang-format off
#ifndef WORD
#define WORD(type, text, value)
#endif

WORD(JOIN, "miter", JOIN_MITER)
WORD(JOIN, "round", JOIN_ROUND)
WORD(JOIN, "bevel", JOIN_BEVEL)

WORD(CAP, "butt", CAP_BUTT)
WORD(CAP, "round", CAP_ROUND)
WORD(CAP, "square", CAP_SQUARE)

WORD(FILL_TYPE, "winding", FILL_WINDING)
WORD(FILL_TYPE, "nonzero", FILL_WINDING)
WORD(FILL_TYPE, "even_odd", FILL_EVEN_ODD)
WORD(FILL_TYPE, "evenodd", FILL_EVEN_ODD)
WORD(FILL_TYPE, "inverse_winding", FILL_INVERSE_WINDING)
WORD(FILL_TYPE, "inverse_even_odd", FILL_INVERSE_EVEN_ODD)

WORD(SLANT, "upright", SLANT_UPRIGHT)
WORD(SLANT, "normal", SLANT_UPRIGHT)
WORD(SLANT, "oblique", SLANT_OBLIQUE)
WORD(SLANT, "italic", SLANT_ITALIC)

WORD(WEIGHT, "invisible", 0)
WORD(WEIGHT, "thin", 100)
WORD(WEIGHT, "extra_light", 200)
WORD(WEIGHT, "light", 300)
WORD(WEIGHT, "normal", 400)
WORD(WEIGHT, "medium", 500)
WORD(WEIGHT, "semi_bold", 600)
WORD(WEIGHT, "semibold", 600)
WORD(WEIGHT, "bold", 700)
WORD(WEIGHT, "extra_bold", 800)
WORD(WEIGHT, "black", 900)
WORD(WEIGHT, "extra_black", 1000)

WORD(FONT_WIDTH, "ultra_condensed", 0)
WORD(FONT_WIDTH, "extra_condensed", 1)
WORD(FONT_WIDTH, "condensed", 2)
WORD(FONT_WIDTH, "semi_condensed", 3)
WORD(FONT_WIDTH, "normal", 4)
WORD(FONT_WIDTH, "semi_expanded", 5)
WORD(FONT_WIDTH, "expanded", 6)
WORD(FONT_WIDTH, "extra_expanded", 7)
WORD(FONT_WIDTH, "ultra_expanded", 8)

WORD(COMPOSITE, "source", COMPOSITE_SRC)
WORD(COMPOSITE, "copy", COMPOSITE_SRC)
WORD(COMPOSITE, "dest", COMPOSITE_DST)
WORD(COMPOSITE, "src_over", COMPOSITE_OVER)
WORD(COMPOSITE, "source_over", COMPOSITE_OVER)
WORD(COMPOSITE, "dest_over", COMPOSITE_DST_OVER)
WORD(COMPOSITE, "src_in", COMPOSITE_IN)
WORD(COMPOSITE, "source_in", COMPOSITE_IN)
WORD(COMPOSITE, "dest_in", COMPOSITE_DST_IN)
WORD(COMPOSITE, "src_out", COMPOSITE_OUT)
WORD(COMPOSITE, "source_out", COMPOSITE_OUT)
WORD(COMPOSITE, "dest_out", COMPOSITE_DST_OUT)
WORD(COMPOSITE, "src_atop", COMPOSITE_ATOP)
WORD(COMPOSITE, "source_atop", COMPOSITE_ATOP)
WORD(COMPOSITE, "dest_atop", COMPOSITE_DST_ATOP)
WORD(COMPOSITE, "plus", COMPOSITE_ADD)
WORD(COMPOSITE, "lighter", COMPOSITE_ADD)
WORD(COMPOSITE, "dodge", COMPOSITE_COLOR_DODGE)
WORD(COMPOSITE, "burn", COMPOSITE_COLOR_BURN)

WORD(TONEMAP, "reinhard", TONEMAP_REINHARD)
WORD(TONEMAP, "aces", TONEMAP_ACES)
WORD(TONEMAP, "agx", TONEMAP_AGX)
WORD(TONEMAP, "agx_punchy", TONEMAP_AGX_PUNCHY)

WORD(FADE, "linear", FADE_LINEAR)
WORD(FADE, "quad", FADE_QUAD)
WORD(FADE, "cubic", FADE_CUBIC)

WORD(FLIP, "horizontal", FLIP_HORIZONTAL)
WORD(FLIP, "vertical", FLIP_VERTICAL)
WORD(FLIP, "both", FLIP_BOTH)

WORD(NOISE_SHAPE, "plane", NOISE_PLANE)
WORD(NOISE_SHAPE, "cylinder", NOISE_CYLINDER)
WORD(NOISE_SHAPE, "sphere", NOISE_SPHERE)

WORD(NOISE_TYPE, "fractal", TURBULENCE_FRACTAL)
WORD(NOISE_TYPE, "turbulence", TURBULENCE_FOLDED)
WORD(NOISE_TYPE, "improved", TURBULENCE_IMPROVED)

WORD(FACE, "back", FACE_BACK)
WORD(FACE, "front", FACE_FRONT)

WORD(MIX3D, "over", MIX3D_OVER)
WORD(MIX3D, "source", MIX3D_SOURCE)
WORD(MIX3D, "dest", MIX3D_DEST)
WORD(MIX3D, "dest_over", MIX3D_DEST_OVER)
WORD(MIX3D, "add", MIX3D_ADD)
WORD(MIX3D, "subtract", MIX3D_SUBTRACT)
WORD(MIX3D, "lighten", MIX3D_LIGHTEN)
WORD(MIX3D, "darken", MIX3D_DARKEN)

WORD(FOV_REF, "horizontal", FOV_HORIZONTAL)
WORD(FOV_REF, "vertical", FOV_VERTICAL)
WORD(FOV_REF, "diagonal", FOV_DIAGONAL)
WORD(FOV_REF, "wide", FOV_WIDE)
WORD(FOV_REF, "narrow", FOV_NARROW)

WORD(UV_MAP, "standard", UV_STANDARD)
WORD(UV_MAP, "repeat", UV_REPEAT)

WORD(UV_REMAP, "sphere", REMAP_SPHERE)
WORD(UV_REMAP, "plane", REMAP_PLANE)
WORD(UV_REMAP, "book", REMAP_BOOK)
// clang-format on

#undef WORD
