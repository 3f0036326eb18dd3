// args.h: reading a command line, one option or operand at a time.
//
// Options and operands may be mixed; `--` ends the options. `--name value`, `--name=value`, `-x value` and `-xvalue`
// mean the same.
#ifndef PETRI_SRC_ARGS_H
#define PETRI_SRC_ARGS_H

#include <stdint.h>

#include "cli/cli.h"

enum { ARG_END = 0, ARG_OPTION = 1, ARG_OPERAND = -1, ARG_HELP = -2, ARG_WRONG = -3 };

typedef struct Args {
    const Command *command;
    int argc;
    char **argv;
    int next;
    bool operands_only;       // `--` was seen
    bool version;             // --version asked for the help
    const OptionSpec *option; // the one that args_next returned
    const char *value;        // its value, or the operand
} Args;

Args args_start(const Command *command, int argc, char **argv);
// What comes next. After ARG_WRONG the message has been given.
int args_next(Args *args);
// After ARG_HELP: prints what was asked for, the command's help or the version. Returns the exit status.
int args_help(const Args *args);

// Read the value of the current option. False, after a message, if it is not of that kind.
bool args_integer(const Args *args, int64_t least, int64_t most, int64_t *out);
bool args_positive(const Args *args, double *out);
// The index of the value in a list of words that ends with NULL.
bool args_choice(const Args *args, const char *const *words, int *out);
// auto, always or never, as whether messages are coloured.
bool args_colour(const Args *args, bool *colour);
// Whether standard error is a terminal that may be coloured (NO_COLOR is honoured).
bool colour_by_default(void);
// Says that the value is wrong and what it should be; returns false.
bool args_wrong_value(const Args *args, const char *expected);

#endif
