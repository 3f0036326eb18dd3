// commands.h: the commands that this program has: petri-pictures has all, petri those that never draw.
#ifndef PETRI_SRC_COMMANDS_H
#define PETRI_SRC_COMMANDS_H

#include "cli/cli.h"

// In the order of help, ended by NULL.
extern const Command *const COMMANDS[];
// NULL if there is none of this name.
const Command *command_find(const char *name);

#endif
