// repl_edit.h: lines edited on a terminal, with history and completion, by libedit.
#ifndef PETRI_SRC_REPL_EDIT_H
#define PETRI_SRC_REPL_EDIT_H

#include "repl_line.h"

typedef struct Editor Editor;

// NULL if petri was built without libedit, or the terminal cannot be edited on.
Editor *editor_new(Repl *repl);
// Adds what was typed to the history's file. NULL is fine.
void editor_free(Editor *editor);
// As line_read.
LineStatus editor_read(Editor *editor, const char *prompt, Bytes *line);

#endif
