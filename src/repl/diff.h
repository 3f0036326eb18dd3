// diff.h: what was changed in a script, in a few words.
#ifndef PETRI_SRC_REPL_DIFF_H
#define PETRI_SRC_REPL_DIFF_H

#include "cli/bytes.h"

// Adds how many lines were added and removed and which names are bound in them, such as `2 lines added, 1 removed
// (COUNT, start)`; nothing if the texts are equal.
void diff_describe(const Bytes *before, const Bytes *after, Bytes *what);

#endif
