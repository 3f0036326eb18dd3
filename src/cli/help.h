// help.h: formatting of help texts for standard output.
#pragma once

#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/output.h"
#include "petri-edit.h"

// Returns an output for standard output. It must be closed with help_end.
Output *help_begin(void);
// Flushes and frees the output. Returns the exit status.
int help_end(Output *output);
// Writes text, wrapped at spaces to a width, which is at least 40. Two or more spaces within a line separate columns. A
// wrapped line continues below the start of its last column.
void help_wrap(Output *output, const Text *text, size_t columns);
// Returns the width of the terminal `fd`. The environment variable COLUMNS overrides it; without either, it is 80.
size_t help_columns(int fd);
// Writes text like help_wrap, to standard output and to the width of its terminal. Returns the exit status.
int help_print(const Text *text);
// Adds paragraphs and a newline. Joins the lines of a paragraph, but not empty lines or lines that begin with a space.
void help_prose(Text *text, const char *prose);
// Adds a line with an option and its help.
void help_option(Text *text, const OptionSpec *spec);

// Text of `petri help` and of the manual: HELP_TITLE is printed after the program's name, and
// HELP_BEGINNING after the list of commands.
extern const char HELP_TITLE[], HELP_BEGINNING[];

// A word of the language that is neither a function nor a node (topics.c).
typedef struct Topic {
    const char *word;
    const char *form; // syntax
    const char *help;
} Topic;
extern const Topic TOPICS[]; // all topics, then one with word NULL

// Words for things that have other names in petri.
typedef struct EverydayWord {
    const char *words; // separated by spaces
    const char *names; // separated by spaces: names that the help knows, and words of the manual
    const char *note;  // or ""
} EverydayWord;
extern const EverydayWord EVERYDAY_WORDS[]; // all rows, then one with words NULL

// Find a name in petri's tables. topic_find_kind finds the first kind with this name at or after index *number, and
// sets *number to its index, because several areas may have kinds with the same name. topic_find returns NULL if there
// is no such word.
bool topic_find_builtin(Str name, PetriBuiltin *builtin);
bool topic_find_kind(Str name, size_t *number, PetriNodeKind *kind);
const Topic *topic_find(Str word);

// Adds the formulas of a force, one per line, indented. Adds nothing for other nodes.
void help_formula(Text *text, const PetriNodeKind *kind);
extern const char FORMULA_LETTERS[]; // explains the symbols in formulas

// Help on words of the language, for `petri help` and `.help` at the prompt (topics.c).

// Adds the help for all functions, nodes and words with this name. If there are none, adds the help for attributes with
// this name. `!name` matches only nodes. Then adds what petri calls this everyday word. Returns false if it knows
// neither such a name nor such a word.
bool topics_print(Text *text, const char *topic);
// Passes all names that topics_print knows to nearest_offer.
void topics_offer(StrNearest *nearest);
