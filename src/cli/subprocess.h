// subprocess.h: a child process whose output is stored for the caller, such as `petri run` in petri test.
#ifndef PETRI_SRC_SUBPROCESS_H
#define PETRI_SRC_SUBPROCESS_H

#include "cli/byte_buffer.h"
#include "cli/cli.h"

#include <sys/types.h>

typedef struct Subprocess {
    pid_t pid;
    int output; // descriptors of unnamed files with its standard output
    int errors; // and standard error
} Subprocess;

enum { SUBPROCESS_MAX_SECONDS = 120 };

// Returns a file that is deleted when it is closed, or -1. Unlike a pipe, it never blocks its writer.
int subprocess_temporary_file(void);
// Starts a program with `folder` as its working directory. `argv` is as for execv. Returns false and sets errno on
// failure. The program is ended after SUBPROCESS_MAX_SECONDS.
bool subprocess_start(Subprocess *child, const char *program, const char *folder, char **argv);
// Waits for any child to end. Returns its process id, or -1 if there is no child. *status is that of waitpid.
pid_t subprocess_wait(int *status);
// Reads the output of a child that has ended and closes its files.
void subprocess_collect(Subprocess *child, ByteBuffer *output, ByteBuffer *errors);
// Describes how a child ended that should have exited with 0: its status and the first line of its errors.
void subprocess_describe(int status, const ByteBuffer *errors, ByteBuffer *error_text);

#endif
