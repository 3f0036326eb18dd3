// words.h: reading what follows a command's name.
#ifndef PETRI_SRC_REPL_WORDS_H
#define PETRI_SRC_REPL_WORDS_H

#include "repl/repl.h"

// A copy without blanks at its ends; to be freed.
char *word_trimmed(const char *text);
// A finite number: one as the command line takes it, a time code, or an expression of the present frame. False after a
// message.
bool word_number(Repl *repl, const char *text, double *number);
// A whole number from `least` on, or an expression for one; an empty text leaves *count. False after a message.
bool word_count(Repl *repl, const char *text, int64_t least, int64_t *count);
// Takes `--limit N` off the text's beginning or end. False after a message.
bool word_limit(Repl *repl, char *text, int64_t *limit);
// Takes a whole number off the text's end, if there is one after a blank and something before it.
void word_last_count(char *text, int64_t *count);
// Takes a whole number, or `all`, off the end of what a table is asked for: how many lines to show. What is not said is
// a screenful, less `around` lines, on a terminal and everything elsewhere.
size_t word_lines(const Repl *repl, char *text, size_t around);

#endif
