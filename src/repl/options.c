// options.c: see options.h.
#include "repl/options.h"

#include "cli/option_groups.h"

typedef ReplOptions Own;

// clang-format off
static const OptionSpec ROWS[] = {
    FPS_OPTION
    DEFINE_OPTION
    SHARED("state", 0, "FILE", option_text, state_file, "start with the state in FILE")
    FILE_OPTIONS
    OWN("limit", 0, "N", WHOLE(1, INT64_MAX), limit, "limit .run and .until to N frames (default: 100000)")
    THREADS_OPTION
    LIMIT_OPTIONS
    NOSIMPLIFY_OPTION
    FROM_OPTION
    SHARED("color", 0, "WHEN", ONE_OF(option_colour, "auto", "always", "never"), colour, "use colours in prompts and messages: auto, always or never")
    NO_MORE_OPTIONS
};
// clang-format on
const OptionTable REPL_OPTIONS = {ROWS, sizeof(Own), &(const Own){.limit = 100000}};
