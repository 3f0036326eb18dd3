// script.h: the script that a command line names: a file, or `-` for what comes on standard input.
#ifndef PETRI_SRC_SCRIPT_H
#define PETRI_SRC_SCRIPT_H

#include "cli/byte_buffer.h"
#include "cli/cli.h"
#include "petri.h"

// What messages call standard input. Files that such a script names are looked for in the current folder.
#define SCRIPT_STDIN "<stdin>"

bool script_is_stdin(const char *name);
// The name, or SCRIPT_STDIN.
const char *script_display_name(const char *name);
// petri_load and petri_check for what the name stands for. Where there is no such script, a message may tell which one
// could be meant.
PetriStatus script_load(PetriSession *session, const char *name);
PetriStatus script_check(PetriSession *session, const char *name);
// Says that a second script was named on the command line, which may have been meant as an option's value.
void script_report_second(const char *first, const char *second);
// Gives that message, after one that a script cannot be read: the name that is nearest to this one, or what a folder
// holds.
void script_suggest(const char *name);
// Which of the words, from 0 on, a file's name ends in, such as ".png" in ".csv .png"; -1 for none.
int script_suffix(const char *name, const char *words);
// The folder that it is in, "." for this one; to be freed.
char *script_folder(const char *name);
// Adds a word as a shell takes it.
void shell_add_word(ByteBuffer *text, const char *word);
// Adds the program as it was called, from the current folder where it is below that.
void shell_add_program(ByteBuffer *text, const char *called);
// Tells on standard error how to see what a script shows, and how to keep a picture of it: command lines that work from
// the current folder.
void hint_pictures(const CommandContext *context, const char *script);

#endif
