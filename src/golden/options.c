// options.c: see options.h.
#include "golden/options.h"

#include "cli/option_groups.h"

typedef TestOptions Own;

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("new", 0, NULL, option_flag, new_golden, "create a golden: petri test --new SCRIPT [options of petri run]")
    OWN("update", 0, NULL, option_flag, update, "update goldens and .err files to the current output")
    OWN("review", 0, NULL, option_flag, review, "ask about each difference: accept, reject, skip, show the cause or both pictures")
    OWN("watch", 0, NULL, option_flag, watch, "run tests again when a file changes on which they depend")
    OWN("filter", 0, "TEXT", option_text, filter, "run only scripts whose path relative to PATH contains TEXT")
    OWN("format", 0, "FORMAT", ONE_OF(option_choice, "text", "junit", "tap", "github"), format, "print the results as text, JUnit XML, TAP, or text with annotations for GitHub (default: text)")
    OWN("junit", 0, "FILE", option_text, junit, "also write the results to FILE as JUnit XML, for CI")
    OWN("jobs", 0, "N", WHOLE(1, 256), jobs, "run N scripts at a time (default: number of CPUs)")
    OWN("threads", 0, "N", option_text, as_threads, "run all scripts with --threads N")
    OWN("neighbours", 0, "WHEN", option_text, as_neighbours, "run all scripts with --neighbours WHEN")
    OWN("color", 0, "WHEN", ONE_OF(option_choice, "auto", "always", "never"), colour, "use colours in differences: auto, always or never")
    NOSIMPLIFY_OPTION NO_BATCHES_OPTION NO_MORE_OPTIONS
};
// clang-format on
const OptionTable TEST_OPTIONS = {ROWS, sizeof(Own), NULL};
