// options.h: the options of `petri view`.
#pragma once

#include "cli/options.h"

typedef struct ViewOptions {
    bool terminal; // show in the terminal
    bool full_screen;
    int64_t screen;     // number of the screen; -1: not given
    bool automatic;     // draw the particles instead of the canvas
    const char *window; // id or number of the window to draw; NULL: not given
    const char *listen; // path of a Unix socket
    const char *send;   // path of the socket
} ViewOptions;

extern const OptionTable VIEW_OPTIONS;

// Returns the values of the options that only `petri view` has.
static inline ViewOptions *view_options(const Options *options) {
    return options->own;
}
