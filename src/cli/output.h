// output.h: buffered writing to standard output that notices when it fails.
//
// After the first failure everything is dropped, and the writer is told, so that a run ends as soon as nobody reads.
#ifndef PETRI_SRC_OUTPUT_H
#define PETRI_SRC_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct Output {
    int fd;
    int error;      // errno of the first failure, 0 while all is well
    size_t written; // bytes, without those that wait
    size_t used;    // bytes that wait
    char buffer[1 << 16];
} Output;

void output_start(Output *output, int fd);
// False once writing has failed. `host` is the Output: the function can serve as a PetriWriteCallback.
bool output_write(void *user_data, const char *text, size_t length);
__attribute__((format(printf, 2, 3))) bool output_format(Output *output, const char *format, ...);
bool output_flush(Output *output);
// Flushes and turns a failure into an exit status: a closed pipe is no failure, for the reader has what it wanted.
// Gives the message otherwise.
int output_finish(Output *output, int status);
// Writes a text to standard output, and that is all: output_finish of it.
int output_text(const char *text, size_t length, int status);

#endif
