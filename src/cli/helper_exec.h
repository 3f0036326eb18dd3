// helper_exec.h: starting the other programs, such as petri-pictures and petri-ranks, for what this one cannot do.
#ifndef PETRI_SRC_HELPER_EXEC_H
#define PETRI_SRC_HELPER_EXEC_H

#include <stdbool.h>

// Is this a first word that only petri-pictures understands? Never so in petri-pictures itself.
bool helper_exec_is_pictures_command(const char *first);
// Whether whatever this program does not understand goes there, too.
bool helper_exec_forwards_unknown(void);
// Becomes petri-pictures with the same arguments. Returns only if that fails: the status to exit with, after a message.
int helper_exec_pictures(char **argv);
// Becomes petri-lsp, which serves editors; -1: this is petri-lsp.
int helper_exec_lsp(char **argv);
// Becomes petri-ranks, one of several processes that run a script together, if mpirun has started several. -1 if not,
// and if there is no such program and it is not needed.
int helper_exec_ranks(char **argv, bool needed);
// Becomes another program of petri's. Returns only if that fails: why, as errno has it.
int helper_exec(const char *name, char **argv);

#endif
