// stdout_file.h: images and video on standard output (`-o -`).
//
// The output is written to a file in a temporary folder and copied when it is complete. It cannot be streamed, because
// images replace their file as a whole and video containers are patched at the end.
#pragma once

#include <stdbool.h>

typedef struct StdoutFile {
    char *folder; // temporary folder; NULL: not open
    char *file;   // path of the file to write
} StdoutFile;

// Returns true if the value of -o is `-`.
bool stdout_file_is_requested(const char *output);
// Checks the format (such as "png" or "mp4"; NULL: png) and that standard output is not a terminal. Returns false after
// a message.
bool stdout_file_check(const char *format);
// Creates the folder. Returns false after a message.
bool stdout_file_open(StdoutFile *piped, const char *format);
// Copies the file, if it exists, to standard output. Returns false after a message. A closed pipe is not a failure.
bool stdout_file_send(const StdoutFile *piped);
// Deletes the file and the folder. Can be called repeatedly, also without stdout_file_open.
void stdout_file_close(StdoutFile *piped);
