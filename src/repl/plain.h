// plain.h: lines without an editor.
#ifndef PETRI_SRC_REPL_PLAIN_H
#define PETRI_SRC_REPL_PLAIN_H

#include "repl/line.h"

typedef struct PlainReader {
    Bytes text; // read and not taken yet, from `at` on
    size_t at;
    size_t searched; // for a line end
    bool ended;
} PlainReader;

typedef enum PlainWait {
    WAIT_INPUT,       // there is something to read
    WAIT_NOTICED,     // changed files were told of: the prompt must be written again
    WAIT_INTERRUPTED, // Ctrl-C
} PlainWait;

PlainWait plain_wait(Repl *repl);
// As line_read.
LineStatus plain_read(PlainReader *reader, Repl *repl, const char *prompt, Bytes *line);

#endif
