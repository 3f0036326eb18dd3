// help.h: writing help to standard output.
#ifndef PETRI_SRC_HELP_H
#define PETRI_SRC_HELP_H

#include "cli/cli.h"
#include "cli/output.h"

// To be ended.
Output *help_begin(void);
// Writes what is left and frees the output; returns the exit status.
int help_end(Output *output);
// An option and what it does, in a line.
void help_option(Output *output, const OptionSpec *spec);
// Tells of a command of the prompt; false if there is none of this name.
bool help_prompt(Output *output, const char *name);

#endif
