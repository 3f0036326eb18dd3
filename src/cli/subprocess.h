// subprocess.h: `petri run` in a process of its own, with its output kept for whoever started it.
#ifndef PETRI_SRC_SUBPROCESS_H
#define PETRI_SRC_SUBPROCESS_H

#include "cli/byte_buffer.h"
#include "cli/cli.h"

#include <sys/types.h>

typedef struct Subprocess {
    pid_t pid;
    int output; // files without a name that hold what it writes
    int errors;
} Subprocess;

enum { SUBPROCESS_MAX_SECONDS = 120 };

// A file that vanishes when it is closed, or -1. Unlike a pipe it takes any amount while nobody reads.
int subprocess_temporary_file(void);
// Starts a program in a folder; the words end with NULL, the first is the program's name. False with errno set.
bool subprocess_start(Subprocess *child, const char *program, const char *folder, char **argv);
// Waits for any child to end; its process id, or -1 if there is none. `status` is that of waitpid.
pid_t subprocess_wait(int *status);
// Reads what an ended child has written and closes its files.
void subprocess_collect(Subprocess *child, ByteBuffer *output, ByteBuffer *errors);
// Says how a child ended that should have ended with status 0, and the first line of its errors.
void subprocess_describe(int status, const ByteBuffer *errors, ByteBuffer *error_text);

#endif
