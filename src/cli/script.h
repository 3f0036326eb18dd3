// script.h: the script named on a command line: a file, or `-` for standard input.
#pragma once

#include "cli/cli.h"
#include "cli/memory.h"
#include "petri.h"

// Name of standard input in messages. Relative paths in a script from standard input start at the current
// folder.
#define SCRIPT_STDIN "<stdin>"
#define SCRIPT_MAX_BYTES ((size_t)256 << 20) // maximum size of a script, as in petri_load

bool script_is_stdin(const char *name);
// Returns the name, or SCRIPT_STDIN for `-`.
const char *script_display_name(const char *name);
// Reads standard input, or a regular file of at most max_bytes. On failure prints a message and returns false.
bool script_read(Text *text, const char *name, size_t max_bytes);
// Like petri_load and petri_check, but the name `-` means standard input. If the file does not exist, a message can
// suggest another file.
PetriStatus script_load(PetriSession *session, const char *name);
PetriStatus script_check(PetriSession *session, const char *name);
// Reports a second script on the command line, which is often a misplaced option value.
void script_report_second(const char *first, const char *second);
// Prints a suggestion for a script that cannot be read: a file with a similar name, or the scripts in a folder.
void script_suggest(const char *name);
// Returns the index of the file name's suffix in the list `words`, or -1 if it is not in the list. For example, returns
// 1 for "a.png" and ".csv .png".
int script_suffix(const char *name, const char *words);
// Adds a word, quoted for a shell if necessary.
void shell_add_word(Text *text, const char *word);
// Adds `called`, the path of this program, quoted for a shell if necessary. The path is made relative if the program is
// below the current folder.
void shell_add_program(Text *text, const char *called);
// Prints two commands: one shows the script, the other saves a picture of it.
void hint_pictures(const CommandContext *context, const char *script);
