// edit.h: lines edited on a terminal, with history and completion, by libedit.
#ifndef PETRI_SRC_REPL_EDIT_H
#define PETRI_SRC_REPL_EDIT_H

#include "repl/line.h"

typedef struct Editor Editor;

// NULL if petri was built without libedit, or the terminal cannot be edited on.
Editor *editor_new(Repl *repl);
// Adds what was typed to the history's file. NULL is fine.
void editor_free(Editor *editor);
// As line_read, but all lines that belong together, with line feeds between them and at the end. In such a block Up and
// Down go from line to line, and what is in the history is a whole block.
LineStatus editor_read(Editor *editor, const char *prompt, Bytes *lines);

#endif
