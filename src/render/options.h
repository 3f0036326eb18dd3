// options.h: the options of `petri render`.
#pragma once

#include "cli/options.h"

typedef struct RenderOptions {
    const char *output; // output file
    const char *format; // format for `-o -`; NULL: not given
    int64_t every;
    Size size; // size of pictures in pixels; 0: the size that the script sets
    double scale;
    bool automatic;     // draw the particles instead of the canvas
    const char *window; // id or number of the window to draw; NULL: not given
} RenderOptions;

extern const OptionTable RENDER_OPTIONS;

// Returns the values of the options that only `petri render` has.
static inline RenderOptions *render_options(const Options *options) {
    return options->own;
}
