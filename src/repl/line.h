// line.h: lines for the prompt: from a terminal with editing, history and completion where there is libedit, else
// plainly. What is read from a file or a pipe is written after the prompt, so that the output reads as a session.
#ifndef PETRI_SRC_REPL_LINE_H
#define PETRI_SRC_REPL_LINE_H

#include "repl/repl.h"

typedef enum LineStatus { LINE_READ, LINE_END, LINE_INTERRUPTED } LineStatus;

typedef struct LineReader LineReader;

// Never NULL. The Repl must outlive it.
LineReader *line_reader_new(Repl *repl);
// Keeps the history; the reader is gone then.
void line_reader_free(LineReader *reader);
// One line without its end. LINE_END at the end of the input, LINE_INTERRUPTED after Ctrl-C, with an empty line.
LineStatus line_read(LineReader *reader, const char *prompt, Bytes *line);

#endif
