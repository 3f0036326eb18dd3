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
LineStatus line_read(LineReader *reader, const char *prompt, ByteBuffer *line);

// Whether more lines are wanted after these, each ended. *taken is how much of them belongs together: the last line may
// be no part of what is above it, or the empty one that ends it.
bool line_needs_more(Repl *repl, const char *text, size_t length, size_t *consumed);
bool line_is_blank(const char *line);

// For the editor.

typedef enum LineWait {
    WAIT_INPUT,       // there is something to read
    WAIT_NOTICED,     // changed files were told of: the prompt must be written again
    WAIT_INTERRUPTED, // Ctrl-C
} LineWait;
LineWait line_wait(Repl *repl);

// The lines typed in earlier sessions: $XDG_STATE_HOME/petri/history, by default ~/.local/state/…, oldest first, each
// ended; nothing if there are none.
enum { SAVED_MAX = 2000 };        // lines that are kept
enum { SAVED_LINE_END = '\036' }; // stands for the line ends in a block, which is one line of the file
void saved_read(ByteBuffer *lines);
// Adds lines at the end and replaces the file at once. What cannot be written is lost without a word: nobody has asked.
void saved_add(const ByteBuffer *lines);

// The editor (edit.c): lines edited on a terminal by libedit.
typedef struct Editor Editor;
// NULL if petri was built without libedit, or the terminal cannot be edited on.
Editor *editor_new(Repl *repl);
// NULL is fine.
void editor_free(Editor *editor);
// As line_read, but all lines that belong together, with line feeds between them and at the end. In such a block Up and
// Down go from line to line, and what is in the history is a whole block.
LineStatus editor_read(Editor *editor, const char *prompt, ByteBuffer *lines);

#endif
