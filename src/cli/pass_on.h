// pass_on.h: starting the other programs, such as petri-pictures and petri-ranks, for what this one cannot do.
#ifndef PETRI_SRC_PASS_ON_H
#define PETRI_SRC_PASS_ON_H

#include <stdbool.h>

// Is this a first word that only petri-pictures understands? Never so in petri-pictures itself.
bool pass_on_wanted(const char *first);
// Whether whatever this program does not understand goes there, too.
bool pass_on_all(void);
// Becomes petri-pictures with the same arguments. Returns only if that fails: the status to exit with, after a message.
int pass_on(char **argv);
// Becomes petri-lsp, which serves editors; -1: this is petri-lsp.
int pass_on_lsp(char **argv);
// Becomes petri-ranks, one of several processes that run a script together, if mpirun has started several. -1 if not.
int pass_on_ranks(char **argv);
// Becomes another program of petri's. Returns only if that fails: why, as errno has it.
int pass_on_become(const char *name, char **argv);

#endif
