// stdout_file.h: pictures and films for standard output (`-o -`): made as a file in a folder of our own, sent when
// complete.
//
// Writers of pictures replace files as a whole and containers of films are mended at their end, so neither is streamed;
// what comes out is the same as a file.
#ifndef PETRI_SRC_STDOUT_FILE_H
#define PETRI_SRC_STDOUT_FILE_H

#include <stdbool.h>

typedef struct StdoutFile {
    char *folder; // NULL: not open
    char *file;   // what to write
} StdoutFile;

bool stdout_file_is_requested(const char *output);
// Checks the format ("png", "mp4", …; NULL: png) and that standard output is no terminal. False after a message.
bool stdout_file_check(const char *format);
// Makes the folder. False after a message.
bool stdout_file_open(StdoutFile *piped, const char *format);
// Sends the file, if there is one. False after a message; a reader that has gone is no failure.
bool stdout_file_send(const StdoutFile *piped);
// Removes what is there. To do so twice, or without opening, is fine.
void stdout_file_close(StdoutFile *piped);

#endif
