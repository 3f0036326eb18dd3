// child.h: `petri run` in a process of its own, with its output kept for whoever started it.
#ifndef PETRI_SRC_CHILD_H
#define PETRI_SRC_CHILD_H

#include <sys/types.h>

#include "cli/bytes.h"
#include "cli/cli.h"

typedef struct Child {
    pid_t pid;
    int output; // files without a name that hold what it writes
    int errors;
} Child;

enum { CHILD_SECONDS = 120 };

// A file that vanishes when it is closed, or -1. Unlike a pipe it takes any amount while nobody reads.
int child_unnamed_file(void);
// Starts a program in a folder; the words end with NULL, the first is the program's name. False with errno set.
bool child_start(Child *child, const char *program, const char *folder, char **argv);
// Waits for any child to end; its process id, or -1 if there is none. `status` is that of waitpid.
pid_t child_wait(int *status);
// Reads what an ended child has written and closes its files.
void child_collect(Child *child, Bytes *output, Bytes *errors);
// Says how a child ended that should have ended with status 0, and the first line of its errors.
void child_describe(int status, const Bytes *errors, Bytes *trouble);

#endif
