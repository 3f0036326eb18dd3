// help.h: help texts of nodes and attributes.
#pragma once

#include "schema/table.h"

typedef struct AttrHelp {
    const char *default_text; // description of the default; "": none
    const char *unit;         // unit in words; "": none, or named in `help`
    const char *help;         // description; "": the name of the attribute is self-explanatory
} AttrHelp;

extern const AttrHelp schema_help[ROW_COUNT]; // in the order of schema_rows
extern const char *const schema_kind_help[KIND_COUNT];

// Returns the formula of a force, with line breaks; "" for other nodes.
const char *schema_formula(NodeKind kind);
// Returns names that other programs have for the kind, separated by spaces, or "" (reports.c).
const char *schema_synonyms(NodeKind kind);
