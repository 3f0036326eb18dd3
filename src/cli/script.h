// script.h: the script named on a command line: a file, or `-` for standard input.
#ifndef PETRI_SRC_SCRIPT_H
#define PETRI_SRC_SCRIPT_H

#include "cli/byte_buffer.h"
#include "cli/cli.h"
#include "petri.h"

// Name of standard input in messages. Relative paths in such a script start at the current folder.
#define SCRIPT_STDIN "<stdin>"

bool script_is_stdin(const char *name);
// Returns the name, or SCRIPT_STDIN for `-`.
const char *script_display_name(const char *name);
// Like petri_load and petri_check, but `-` reads standard input. If the file does not exist, a message may suggest
// another.
PetriStatus script_load(PetriSession *session, const char *name);
PetriStatus script_check(PetriSession *session, const char *name);
// Reports a second script on the command line, which is often a misplaced option value.
void script_report_second(const char *first, const char *second);
// Prints a suggestion for a script that cannot be read: a file with a similar name, or the scripts in a folder.
void script_suggest(const char *name);
// Returns the number, from 0, of the suffix in `words` that the file name ends with; -1: none. For example, 1 for
// "a.png" and ".csv .png".
int script_suffix(const char *name, const char *words);
// Returns the folder of the path, "." for the current one. The caller frees it.
char *script_folder(const char *name);
// Adds a word, quoted for a shell if necessary.
void shell_add_word(ByteBuffer *text, const char *word);
// Adds the path of the program, relative to the current folder if it is below it.
void shell_add_program(ByteBuffer *text, const char *called);
// Prints the commands that show the script and that save a picture of it.
void hint_pictures(const CommandContext *context, const char *script);

#endif
