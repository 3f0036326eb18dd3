// commands.h: the table of commands (command_list.h), which says which programs can execute each command.
#pragma once

#include "cli/cli.h"

// Bits of CommandRow.programs and PROGRAM.
enum {
    PETRI = 1,       // petri, which starts quickly because it links few libraries
    PICTURES = 2,    // petri-pictures, which has all commands
    RANKS = 4,       // petri-ranks, which uses MPI
    NEEDS_RANKS = 8, // not a program: under mpirun, only petri-ranks can execute the command
};

typedef struct CommandRow {
    const char *name;
    unsigned programs;      // programs that can execute the command
    const Command *command; // NULL: this program cannot execute it
    bool listed;            // true if help, completion and manual list the command
} CommandRow;

// All commands, then one without a name. Those that are not listed are last.
extern const CommandRow COMMANDS[];
// The bit of this program.
extern const unsigned PROGRAM;

// Returns the row with this name, or NULL.
const CommandRow *command_find(const char *name);
