// pictures.h: access of built-ins to fonts and to rendered pictures, which the host provides (petri_painter_serve).
#pragma once

#include "base/str.h"

// A text and its font. Empty words and NaN mean the defaults of `!font`.
typedef struct BuiltinText {
    Str text;
    Str family;
    double size;
    Str weight; // a word or a number
    Str width;
    Str slant;
} BuiltinText;

// A rendered picture; exactly one of `bytes` and `linear` is set.
typedef struct BuiltinPicture {
    int width;
    int height;
    const uint32_t *bytes; // premultiplied ARGB32, rows from the top
    const float *linear;   // premultiplied red, green, blue and alpha in linear light, rows from the top
} BuiltinPicture;

typedef struct BuiltinPictures {
    // Stores the width of a text in *width. Sets *loaded if a font may have been loaded, which takes long. On failure,
    // returns the reason.
    const char *(*measure)(void *user_data, const BuiltinText *text, double *width, bool *loaded);
    // Finds the picture that the node with this id had in the previous frame. Returns false if there is none. The
    // pixels are valid until the next call.
    bool (*find)(void *user_data, Str id, BuiltinPicture *picture);
    void *user_data;
    bool samples; // true if the script has called sample()
} BuiltinPictures;
