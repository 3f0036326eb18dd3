// helper_exec.h: execution of helper programs such as petri-pictures and petri-ranks.
//
// petri itself links few libraries. If a command needs other libraries, a helper program replaces the process (exec).
#pragma once

#include <stdbool.h>

// Returns true if `first`, the first argument, is a command that only petri-pictures executes. In petri-pictures
// itself, always returns false.
bool helper_exec_is_pictures_command(const char *first);
// Returns true if the arguments name an archive or create one, and this program cannot read and write archives.
bool helper_exec_needs_archives(char **argv);
// Returns true if the arguments of `petri check` ask for the triangles of models, and this program cannot draw.
bool helper_exec_needs_meshes(char **argv);
// Returns true if unknown commands must be forwarded to petri-pictures. In petri-pictures itself, returns false.
bool helper_exec_forwards_unknown(void);
// Executes petri-pictures with the same arguments. Returns only on failure: the exit status, after a message.
int helper_exec_pictures(char **argv);
// Executes petri-ranks if mpirun has started several processes. Returns -1 if mpirun has not done so, or if
// petri-ranks does not exist and `needed` is false. On other failures, returns the exit status after a message.
int helper_exec_ranks(char **argv, bool needed);
// Replaces the calling process with a helper program. Returns only on failure: the value of errno.
int helper_exec(const char *name, char **argv);
