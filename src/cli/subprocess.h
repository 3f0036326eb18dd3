// subprocess.h: a child process whose output is stored for the caller, such as `petri run` in petri test.
#pragma once

#include "cli/cli.h"
#include "cli/memory.h"

#include <sys/types.h>

typedef struct Subprocess {
    pid_t pid;
    int output; // descriptor of an unnamed file with the standard output of the child
    int errors; // descriptor of an unnamed file with the standard error of the child
} Subprocess;

enum { SUBPROCESS_MAX_SECONDS = 120 };

// Returns the number of children that should run in parallel by default, at least 1.
int subprocess_default_jobs(void);
// Returns the descriptor of a file that is deleted when it is closed, or -1. Unlike a pipe, the file never blocks a
// process that writes to it.
int subprocess_temporary_file(void);
// Starts a program, which is searched in PATH, with `folder` as its working directory. `argv` is as for execv. Returns
// false and sets errno on failure. The program is killed after `seconds`.
bool subprocess_start(Subprocess *child, const char *program, const char *folder, char **argv, unsigned seconds);
// Starts a program in the same way and waits until it ends. Adds its output and its messages to the texts, and returns
// its status as waitpid does. Returns -1 with errno set on failure.
int subprocess_run(const char *program, const char *folder, char **argv, unsigned seconds, Text *output, Text *errors);
// Runs git in the same way. `words` are those after `git`. Only for commands that show no signatures: then the
// configuration of a stranger's repository cannot start other programs.
int subprocess_git(const char *folder, const TextList *words, unsigned seconds, Text *output, Text *errors);
// Starts a program, which is searched in PATH, with the default signal mask and action for SIGPIPE. files[i] becomes
// its descriptor i; -1 means /dev/null. If `own_group` is true, Ctrl-C in the terminal does not reach it. `words` are
// as for execv. Returns the process id, or -1 with errno set.
pid_t subprocess_spawn(const char *program, const char *const *words, const int *files, int count, bool own_group);
// Waits until a child ends. Returns its status as waitpid does, or -1 if there is no such child.
int subprocess_wait_for(pid_t pid);
// Waits until any child ends. Returns its process id, or -1 if there is no child. Sets *status like waitpid.
pid_t subprocess_wait(int *status);
// Reads the output of a child that has ended and closes its files. Returns NULL, or the reason of a failure.
const char *subprocess_collect(Subprocess *child, Text *output, Text *errors);
// Adds a description of a child that did not exit with 0: its status and the first line of its standard error.
void subprocess_describe(int status, const Text *errors, Text *error_text);
