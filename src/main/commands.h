// commands.h: the table of commands, which differs between programs. petri-pictures has all commands. petri and
// petri-ranks have only those that need neither the drawing libraries nor the prompt; petri executes petri-pictures for
// the others.
#pragma once

#include "cli/cli.h"

// The commands of this program in the order of help, then NULL.
extern const Command *const COMMANDS[];
// A command that is not in the table, because help and the manual do not list it.
extern const Command COMPLETE_COMMAND;
// Returns the command with this name, or NULL.
const Command *command_find(const char *name);
