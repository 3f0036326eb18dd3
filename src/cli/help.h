// help.h: writing help to standard output.
#ifndef PETRI_SRC_HELP_H
#define PETRI_SRC_HELP_H

#include "cli/byte_buffer.h"
#include "cli/cli.h"
#include "cli/output.h"
#include "petri.h"

// To be ended.
Output *help_begin(void);
// Writes what is left and frees the output; returns the exit status.
int help_end(Output *output);
// Writes text wrapped at words to the width of the terminal, or to 80 columns elsewhere. The rest of a line begins
// below the last of its columns, which are separated by two blanks or more.
void help_write(Output *output, const ByteBuffer *text);
// Writes text in this way to standard output; returns the exit status.
int help_print(const ByteBuffer *text);
// Adds prose: a line that begins without a blank continues the one above it. Ends with a newline.
void help_prose(ByteBuffer *text, const char *prose);
// Adds a line with an option and what it does.
void help_option(ByteBuffer *text, const OptionSpec *spec);

// What `petri help` and the manual begin with: after the name, and after the list of commands.
extern const char HELP_TITLE[], HELP_BEGINNING[];

// Words of the language that are neither functions nor nodes, ended by one without a word (topics.c).
typedef struct Topic {
    const char *word;
    const char *form;
    const char *help;
} Topic;
extern const Topic TOPICS[];

// The formula of a force, indented, a line each (nothing of other nodes), and what its letters stand for.
void help_formula(ByteBuffer *text, const PetriNodeKind *kind);
extern const char FORMULA_LETTERS[];

// What there is to say of a word of the language, for `petri help` and `.help` at the prompt (topics.c).

// Tells of the built-in function, the node (`!name` means no other), the word or the attribute of this name. False if
// there is none.
bool topics_print(ByteBuffer *text, const char *topic);
// Offers all of these names.
void topics_offer(StrNearest *nearest);

#endif
