// complete.h: what a word at the prompt may go on with.
#ifndef PETRI_SRC_REPL_COMPLETE_H
#define PETRI_SRC_REPL_COMPLETE_H

#include "repl/repl.h"

typedef struct Completion {
    Bytes words; // that begin with what was typed, each ended by NUL, sorted, each once
    size_t count;
    Bytes common; // what all of them have beyond what was typed
} Completion;

// For the first `length` bytes of a line. To be freed.
void complete_line(Repl *repl, const char *line, size_t length, Completion *completion);
void complete_free(Completion *completion);
// Writes the words in columns.
void complete_show(const Completion *completion, Output *output);

#endif
