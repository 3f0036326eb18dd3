// packaging.h: manual pages and other products generated from petri's tables.
#pragma once

#include "cli/output.h"
#include "main/commands.h"

// A row of the tables in petri(1): environment variables and exit statuses. Each table ends with a row without a name.
typedef struct PageRow {
    const char *name;
    const char *help;
} PageRow;
extern const PageRow PAGE_VARIABLES[], PAGE_STATUSES[];

// These write petri(1), the page of a command, and petri(5), with the macros of man(7).
void page_of_petri(Output *output);
void page_of_command(Output *output, const Command *command);
void page_of_language(Output *output);

// Writes all tables as JSON, for the manual on the web.
void tables_as_json(Output *output);

// Writes a file of src/editors with its marks replaced by names (template.c). Returns false if it cannot be read.
bool template_fill(Output *output, const char *path);
