// args.h: reading a command line, one option or operand at a time.
//
// Options and operands may be mixed; `--` ends the options. `--name value`, `--name=value`, `-x value` and `-xvalue`
// mean the same.
#ifndef PETRI_SRC_ARGS_H
#define PETRI_SRC_ARGS_H

#include "cli/cli.h"

enum { ARG_END = 0, ARG_OPTION = 1, ARG_OPERAND = -1, ARG_HELP = -2, ARG_INVALID = -3 };

typedef struct Args {
    const Command *command;
    struct Options *options; // what the command line asks for so far
    int argc;
    char **argv;
    int next;
    bool operands_only;       // `--` was seen
    bool version;             // --version asked for the help
    const OptionSpec *option; // the one that args_next returned
    const char *value;        // its value, or the operand
} Args;

// What comes next. After ARG_INVALID the message has been given.
int args_next(Args *args);

#endif
