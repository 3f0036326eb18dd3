// saved.h: the lines typed in earlier sessions: $XDG_STATE_HOME/petri/history, by default ~/.local/state/….
#ifndef PETRI_SRC_REPL_SAVED_H
#define PETRI_SRC_REPL_SAVED_H

#include "cli/bytes.h"

enum { SAVED_MOST = 2000 };       // lines that are kept
enum { SAVED_LINE_END = '\036' }; // stands for the line ends in a block, which is one line of the file

// Reads the lines, oldest first, each ended; nothing if there are none.
void saved_read(Bytes *lines);
// Adds lines at the end and replaces the file at once. What cannot be written is lost without a word: nobody has asked.
void saved_add(const Bytes *lines);

#endif
