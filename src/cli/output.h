// output.h: buffered output that records write errors.
//
// After the first error, all further output is discarded and the functions return false. A run can thus end when the
// reader of its output has closed the pipe.
#pragma once

#include "base/str.h"

#include <stdbool.h>
#include <stddef.h>

// Sends bytes. On failure returns false with errno set.
typedef bool OutputSend(void *user_data, const char *bytes, size_t length);

typedef struct Output {
    int fd;
    OutputSend *send; // called instead of writing to `fd`; NULL: none
    void *user_data;  // passed to `send`
    int error;        // errno of the first failure; 0: none
    size_t written;   // bytes written to `fd`, without those in the buffer
    size_t used;      // bytes in the buffer
    char buffer[1 << 16];
} Output;

void output_start(Output *output, int fd);
// Writes to the Output that `user_data` points to. Can be used as a PetriWriteCallback. Returns false after an error.
bool output_write(void *user_data, const char *text, size_t length);
// Writes a character, then a number as number_format does.
bool output_number(Output *output, char before, double x);
__attribute__((format(printf, 2, 3))) bool output_format(Output *output, const char *format, ...);
bool output_flush(Output *output);
// Flushes the buffer. Returns `status`, or STATUS_FAILED after a message if an error has occurred. A closed pipe is not
// an error, because its reader needs no more output.
int output_finish(Output *output, int status);
// Replaces a file atomically. If that fails, prints a message and returns false.
bool output_file(const char *path, Str text);
// Writes text to standard output and returns the result of output_finish.
int output_text(const char *text, size_t length, int status);
