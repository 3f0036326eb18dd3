// options.h: the options of `petri run`.
#pragma once

#include "cli/options.h"

typedef struct RunOptions {
    unsigned sections; // PETRI_PRINT_... bits; 0: only logs
    int64_t every;
    bool show; // show the picture if output is a terminal
    bool stats;
    const char *trajectory; // file; NULL: none
    bool energies;          // in the trajectory
    bool parameters;        // list the parameters instead of running
    int dump;               // PetriDump; -1: not given
} RunOptions;

extern const OptionTable RUN_OPTIONS;

// Returns the values of the options that only `petri run` has.
static inline RunOptions *run_options(const Options *options) {
    return options->own;
}
