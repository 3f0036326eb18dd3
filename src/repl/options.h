// options.h: the options of `petri repl`.
#pragma once

#include "cli/options.h"

typedef struct ReplOptions {
    int64_t limit; // maximum frames of .run and .until
} ReplOptions;

extern const OptionTable REPL_OPTIONS;

// Returns the values of the options that only `petri repl` has.
static inline ReplOptions *repl_options(const Options *options) {
    return options->own;
}
