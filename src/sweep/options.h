// options.h: the options of `petri sweep`.
#pragma once

#include "cli/options.h"

typedef struct SweepOptions {
    TextList axes;      // each "NAME=VALUES"
    const char *sample; // sampling; NULL: all combinations
    int64_t seeds;
    const char *where;
    const char *until;
    TextList metrics;   // each "NAME=EXPR" or the name of a quantity (motion.h)
    int64_t row_every;  // number of frames from one row to the next; 0: a row for the last frame only
    bool trust;         // also write how many digits of each metric can be trusted
    const char *output; // output file
    const char *summary;
    const char *plot;
    const char *plan;
    int64_t jobs;        // 0: not given
    const char *cache;   // folder; NULL: none
    double verify_cache; // percentage
    const char *shard;
} SweepOptions;

extern const OptionTable SWEEP_OPTIONS;

// Returns the values of the options that only `petri sweep` has.
static inline SweepOptions *sweep_options(const Options *options) {
    return options->own;
}
