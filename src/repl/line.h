// line.h: reading lines at the prompt.
//
// On a terminal, libedit provides editing, history and completion. Without libedit, lines are read without editing.
// Lines from a file or a pipe are echoed after the prompt, so that the output looks like an interactive session.
#pragma once

#include "repl/repl.h"

typedef enum LineStatus { LINE_READ, LINE_END, LINE_INTERRUPTED } LineStatus;

typedef struct LineReader LineReader;

// Returns a reader, never NULL. The Repl must outlive it. The caller frees it with line_reader_free.
LineReader *line_reader_new(Repl *repl);
void line_reader_free(LineReader *reader);
// Reads one line and appends it to `line` without its line feed. Returns LINE_END at the end of the input, and
// LINE_INTERRUPTED after Ctrl-C. In both cases, `line` is unchanged.
LineStatus line_read(LineReader *reader, const char *prompt, Text *line);

// Returns true if the statement in `text`, whose lines all end with a line feed, needs more lines. Sets *consumed to
// the length of the statement. The last line is not part of the statement if it starts the next statement, or if it is
// the blank line after a block.
bool line_needs_more(Repl *repl, const char *text, size_t length, size_t *consumed);
bool line_is_blank(const char *line);
// Returns the number of blanks with which the line after `text` probably begins. The lines of `text` all end with a
// line feed, and its statement needs more lines.
size_t line_indentation(Repl *repl, const char *text, size_t length);

// For the editor.

typedef enum LineWait {
    WAIT_INPUT,       // standard input can be read
    WAIT_NOTICED,     // changed files were reported, so the prompt must be written again
    WAIT_INTERRUPTED, // Ctrl-C
} LineWait;
// Waits for input, for Ctrl-C, or for changes of the script's files. Reports such changes to the user.
LineWait line_wait(Repl *repl);

// The history file, $XDG_STATE_HOME/petri/history (default: ~/.local/state/petri/history), holds the lines typed in
// earlier sessions, oldest first.
enum { SAVED_MAX = 2000 };        // maximum number of lines in the file
enum { SAVED_LINE_END = '\036' }; // replaces line feeds within a block: the file has one line per block
// Appends the lines of the history file; each ends with a line feed. Adds nothing if there is no file.
void saved_read(Text *lines);
// Appends lines to the history file immediately. Ignores write errors.
void saved_add(const Text *lines);

// The line editor (edit.c), which uses libedit.
typedef struct Editor Editor;
// Returns NULL if petri was built without libedit or the terminal does not support editing.
Editor *editor_new(Repl *repl);
// Frees the editor. NULL is ignored.
void editor_free(Editor *editor);
// Like line_read, but appends a whole block: all lines of a statement, each with its line feed. Up and Down move
// between the lines of a block. The history stores whole blocks.
LineStatus editor_read(Editor *editor, const char *prompt, Text *lines);
