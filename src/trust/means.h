// means.h: means of expressions over many runs, for `petri trust --seeds` and `--within`.
#pragma once

#include "sweep/options.h"

typedef struct TrustOptions {
    SweepOptions sweep; // first, because the sweep reads them as its own
    double within;      // wanted half width of the intervals as a percentage of the means; 0: none
    bool json;
} TrustOptions;

// Executes the runs and prints the means. Returns the exit status.
int means_run(const CommandContext *host, Options *options);
