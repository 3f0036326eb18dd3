// packaging.h: what petri's own tables come to for those who install it: manual pages and completions.
#ifndef PETRI_SRC_PACKAGING_H
#define PETRI_SRC_PACKAGING_H

#include "cli/output.h"
#include "main/commands.h"

// The next option of the command's, or NULL beyond the last; `after` is the one before, or NULL.
const OptionSpec *option_after(const Command *command, const OptionSpec *after);
// Whether the option's value is named so in help: "FILE", "DIR" or "LIST".
bool option_takes(const OptionSpec *option, const char *value);

// What petri(1) lists besides commands, each ended by a row without a name.
typedef struct PageRow {
    const char *name;
    const char *help;
} PageRow;
extern const PageRow PAGE_VARIABLES[], PAGE_STATUSES[];

// petri(1), the page of a command, and petri(5), in the macros of man(7).
void page_of_petri(Output *output);
void page_of_command(Output *output, const Command *command);
void page_of_language(Output *output);

// What the shells take.
void completion_bash(Output *output);
void completion_zsh(Output *output);
void completion_fish(Output *output);

// All tables, for the manual as a site.
void tables_as_json(Output *output);

// A file of src/editors with the names that its marks stand for (template.c); false if it cannot be read.
bool template_fill(Output *output, const char *path);

#endif
