// warnings.h: what was told about a script that runs all the same, for a view to list.
#ifndef PETRI_SRC_WARNINGS_H
#define PETRI_SRC_WARNINGS_H

#include <stddef.h>

#include "cli/bytes.h"
#include "petri.h"

typedef struct Warnings {
    int count; // without notes
    Bytes text;
} Warnings;

// Adds a diagnostic, as it is rendered. The text is bounded; all are counted.
void warnings_add(Warnings *warnings, const PetriDiagnostic *diagnostic);
void warnings_forget(Warnings *warnings);
// What may be in a corner all the time: how many there are, and the key that lists them; "" if there are none.
void warnings_mark(const Warnings *warnings, char *text, size_t size);
// The list, under a line that tells how many there are.
void warnings_list(const Warnings *warnings, char *text, size_t size);

#endif
