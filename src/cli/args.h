// args.h: a reader for a command line, one option or operand at a time.
//
// Options and operands may be mixed; `--` ends the options. `--name value`, `--name=value`, `-x value` and `-xvalue`
// mean the same.
#ifndef PETRI_SRC_ARGS_H
#define PETRI_SRC_ARGS_H

#include "cli/cli.h"

enum { ARG_END = 0, ARG_OPTION = 1, ARG_OPERAND = -1, ARG_HELP = -2, ARG_INVALID = -3 };

typedef struct Args {
    const Command *command;
    struct Options *options; // values read so far
    int argc;
    char **argv;
    int next;
    bool operands_only;       // `--` was seen
    bool version;             // ARG_HELP means --version, not --help
    const OptionSpec *option; // the option that args_next returned
    const char *value;        // the option's value, or the operand
} Args;

// Returns the kind of the next argument (ARG_...). Before it returns ARG_INVALID, it prints a message.
int args_next(Args *args);

#endif
