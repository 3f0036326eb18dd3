// options.c: see options.h.
#include "run/options.h"

#include "cli/option_groups.h"
#include "cli/script.h"
#include "petri-inspect.h"

#include <string.h>

typedef RunOptions Own;

// Reads a list of option->words and stores the PETRI_PRINT_... bits. The words are in the order of the bits.
static bool read_sections(const Args *args, void *field) {
    unsigned *sections = field;
    SCOPED_STRING list = memory_strdup(args->value);
    *sections = 0;
    for (char *rest = list; rest;) {
        int section = option_find_word(args->option->words, str_split(&rest, ','));
        if (section < 0)
            return option_invalid(args, "one or more of tree, state, log, error, hash and digest, separated by commas");
        *sections |= (unsigned)PETRI_PRINT_TREE << section;
    }
    return true;
}

static bool read_trajectory(const Args *args, void *field) {
    bool known = script_suffix(args->value, ".xyz .csv .h5 .h5md") >= 0;
    return known ? option_text(args, field) : option_invalid(args, "a file name that ends in .xyz, .csv or .h5");
}

// clang-format off
static const OptionSpec ROWS[] = {
    LENGTH_OPTIONS CLOCK_OPTIONS
    OWN("print", 0, "LIST", ENDS_SHOW(ONE_OF(read_sections, "tree", "state", "log", "error", "hash", "digest")), sections, "print the listed items: tree, state, log, error, hash (SHA-256 of the state), digest (faster hash of the state), separated by commas (default: only log)")
    OWN("every", 0, "K", ENDS_SHOW(WHOLE(1, INT64_MAX)), every, "print and record every K-th frame, starting with frame 0")
    DEFINE_OPTION STATE_OPTION
    SHARED("save-every", 0, "K", ENDS_SHOW(NOT_IN_GOLDENS(WHOLE(1, INT64_MAX))), save_every, "save the state every K frames (default: every few seconds)")
    FILE_OPTIONS THREADS_OPTION LIMIT_OPTIONS METHOD_OPTIONS NO_BATCHES_OPTION
    OWN("show", 0, NULL, NOT_IN_GOLDENS(option_flag), show, "show the picture in the terminal for 10 seconds, or for the length that --runtime or --frames sets; without a terminal or with text output such as --print, print a summary instead")
    OWN("stats", 0, NULL, ENDS_SHOW(option_flag), stats, "print timings and each system's energy at the end")
    OWN("trajectory", 0, "FILE", ENDS_SHOW(NOT_IN_GOLDENS(read_trajectory)), trajectory, "write all particles to FILE.xyz (extended XYZ), FILE.csv or FILE.h5 (H5MD); with --state, append to FILE")
    OWN("energies", 0, NULL, ENDS_SHOW(NOT_IN_GOLDENS(option_flag)), energies, "also write kinetic and potential energy of each system to the trajectory, which takes time")
    RECORDING_OPTIONS
    SHARED("profile", 0, NULL, ENDS_SHOW(option_flag), profile, "print the time per source line, slowest first")
    REPORT_OPTIONS
    OWN("parameters", 0, NULL, ENDS_SHOW(option_flag), parameters, "list the parameters that -D can set, with default, range and comment; do not run")
    OWN("dump", 0, "WHAT", ENDS_SHOW(ONE_OF(option_choice, "ast", "code")), dump, "print the script's syntax tree (ast) or compiled code (code); do not run")
    NO_MORE_OPTIONS
};
// clang-format on
const OptionTable RUN_OPTIONS = {ROWS, sizeof(Own), &(const Own){.every = 1, .dump = -1}};
