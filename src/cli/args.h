// args.h: a reader for a command line, one option or operand at a time.
//
// Options and operands can be in any order. After `--`, all arguments are operands. The value of an option can be
// written as `--name value`, `--name=value`, `-x value` or `-xvalue`.
#pragma once

#include "cli/cli.h"

enum { ARG_END = 0, ARG_OPTION = 1, ARG_OPERAND = -1, ARG_HELP = -2, ARG_INVALID = -3 };

typedef struct Args {
    const Command *command;
    const SimilarCommand *similar; // CommandContext.similar
    struct Options *options;       // values read so far
    int argc;
    char **argv;
    int next;
    bool operands_only;       // true after `--`
    bool version;             // true if ARG_HELP was returned for --version, false for --help
    const OptionSpec *option; // the option that args_next returned
    const char *value;        // the option's value, or the operand
} Args;

// Returns the options of a command, then one without a name.
const OptionSpec *command_options(const Command *command);
// Returns the option with this letter or, if it is 0, with this name. Returns NULL if there is none.
const OptionSpec *option_find(const OptionSpec *rows, const char *name, char letter);

// Reads the next argument and returns its kind (ARG_...). Prints a message before it returns ARG_INVALID.
int args_next(Args *args);
