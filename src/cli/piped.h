// piped.h: pictures and films for standard output (`-o -`): made as a file in a folder of our own, sent when complete.
//
// Writers of pictures replace files as a whole and containers of films are mended at their end, so neither is streamed;
// what comes out is the same as a file.
#ifndef PETRI_SRC_PIPED_H
#define PETRI_SRC_PIPED_H

#include <stdbool.h>

typedef struct Piped {
    char *folder; // NULL: not open
    char *file;   // what to write
} Piped;

bool piped_wanted(const char *output);
// Checks the format ("png", "mp4", …; NULL: png) and that standard output is no terminal. False after a message.
bool piped_check(const char *format);
// Makes the folder. False after a message.
bool piped_open(Piped *piped, const char *format);
// Sends the file, if there is one. False after a message; a reader that has gone is no failure.
bool piped_send(const Piped *piped);
// Removes what is there. To do so twice, or without opening, is fine.
void piped_close(Piped *piped);

#endif
