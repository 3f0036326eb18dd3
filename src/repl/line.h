// line.h: reading lines at the prompt.
//
// On a terminal, libedit provides editing, history and completion; without libedit, lines are read as they are. Lines
// from a file or a pipe are echoed after the prompt, so that the output reads like a session.
#ifndef PETRI_SRC_REPL_LINE_H
#define PETRI_SRC_REPL_LINE_H

#include "repl/repl.h"

typedef enum LineStatus { LINE_READ, LINE_END, LINE_INTERRUPTED } LineStatus;

typedef struct LineReader LineReader;

// Returns a reader, never NULL. The Repl must outlive it. The caller frees it with line_reader_free.
LineReader *line_reader_new(Repl *repl);
void line_reader_free(LineReader *reader);
// Reads one line and appends it to `line` without its line feed. Returns LINE_END at the end of the input and
// LINE_INTERRUPTED after Ctrl-C; the line is empty then.
LineStatus line_read(LineReader *reader, const char *prompt, ByteBuffer *line);

// Returns true if the statement in `text`, whose lines all end with a line feed, needs more lines. *consumed is the
// length of the statement. The last line is not part of it if it starts the next statement or is the blank line that
// ends this one.
bool line_needs_more(Repl *repl, const char *text, size_t length, size_t *consumed);
bool line_is_blank(const char *line);

// For the editor.

typedef enum LineWait {
    WAIT_INPUT,       // standard input can be read
    WAIT_NOTICED,     // changed files were reported: the prompt must be written again
    WAIT_INTERRUPTED, // Ctrl-C
} LineWait;
// Waits for input, for Ctrl-C, or for changes of the script's files, which it reports.
LineWait line_wait(Repl *repl);

// The history file, $XDG_STATE_HOME/petri/history (default: ~/.local/state/petri/history), holds the lines typed in
// earlier sessions, oldest first.
enum { SAVED_MAX = 2000 };        // lines in the file, at most
enum { SAVED_LINE_END = '\036' }; // replaces the line feeds in a block, which is one line of the file
// Appends the lines of the history file; each ends with a line feed. Adds nothing if there is no file.
void saved_read(ByteBuffer *lines);
// Appends lines to the history file at once. Ignores write errors.
void saved_add(const ByteBuffer *lines);

// The line editor (edit.c), which uses libedit.
typedef struct Editor Editor;
// Returns NULL if petri was built without libedit or the terminal does not support editing.
Editor *editor_new(Repl *repl);
// Frees the editor. NULL is ignored.
void editor_free(Editor *editor);
// Like line_read, but appends a whole block, a statement with all its lines, each with its line feed. Up and Down move
// between the lines of a block; the history stores whole blocks.
LineStatus editor_read(Editor *editor, const char *prompt, ByteBuffer *lines);

#endif
