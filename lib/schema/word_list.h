// word_list.h: the words that attributes of drawing nodes take: WORD(TYPE, "word", value). Of the words for one thing
// the first is the usual one; composite_list.h has that of COMPOSITE.
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

WORD(SLANT, "upright", SLANT_UPRIGHT)
WORD(SLANT, "normal", SLANT_UPRIGHT)
WORD(SLANT, "oblique", SLANT_OBLIQUE)
WORD(SLANT, "italic", SLANT_ITALIC)

WORD(WEIGHT, "thin", 100)
WORD(WEIGHT, "light", 300)
WORD(WEIGHT, "normal", 400)
WORD(WEIGHT, "medium", 500)
WORD(WEIGHT, "semibold", 600)
WORD(WEIGHT, "bold", 700)
WORD(WEIGHT, "black", 900)

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
// clang-format on

#undef WORD
