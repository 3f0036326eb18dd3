// commands.h: the commands of this program. petri-pictures has all commands, petri only those
// that never draw, and petri-lsp only `lsp`.
#ifndef PETRI_SRC_COMMANDS_H
#define PETRI_SRC_COMMANDS_H

#include "cli/cli.h"

// The commands of this program in the order of help, then NULL.
extern const Command *const COMMANDS[];
// Returns the command with this name, or NULL.
const Command *command_find(const char *name);

#endif
