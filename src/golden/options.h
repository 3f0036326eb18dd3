// options.h: the options of `petri test`.
#pragma once

#include "cli/options.h"

typedef enum Colour { AUTO, ALWAYS, NEVER } Colour;

typedef struct TestOptions {
    bool new_golden; // create a golden; main then executes another command
    bool update;
    bool review;               // ask about each difference
    bool watch;                // run tests again when their files change
    const char *filter;        // NULL: none
    const char *junit;         // file; NULL: none
    int format;                // a ReportFormat
    int64_t jobs;              // 0: not given
    const char *as_threads;    // overrides --threads of goldens; NULL: no override
    const char *as_neighbours; // overrides --neighbours of goldens; NULL: no override
    int colour;                // a Colour
} TestOptions;

extern const OptionTable TEST_OPTIONS;

// Returns the values of the options that only `petri test` has.
static inline TestOptions *test_options(const Options *options) {
    return options->own;
}
