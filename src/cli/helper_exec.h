// helper_exec.h: execution of helper programs such as petri-pictures and petri-ranks.
//
// petri itself links few libraries. If a command needs other libraries, a helper program replaces the process (exec).
#pragma once

#include <stdbool.h>

// Executes petri-pictures with the same arguments. Returns only on failure: the exit status, after a message.
int helper_exec_pictures(char **argv);
// Executes petri-ranks if mpirun has started several processes. Returns -1 if mpirun has not done so, or if
// petri-ranks does not exist and `needed` is false. On other failures, returns the exit status after a message.
int helper_exec_ranks(char **argv, bool needed);
// Replaces the calling process with a helper program. Returns only on failure: the value of errno.
int helper_exec(const char *name, char **argv);
