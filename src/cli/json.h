// json.h: writing JSON.
#ifndef PETRI_SRC_JSON_H
#define PETRI_SRC_JSON_H

#include "cli/bytes.h"
#include "petri.h"

// Adds a string with its quotes; what is not UTF-8 becomes U+FFFD. NULL is null.
void json_add_text(Bytes *out, const char *text);
// The word for a level.
const char *level_word(PetriLevel level);
// Adds a diagnostic as an object in one line.
void json_add_diagnostic(Bytes *out, const PetriDiagnostic *diagnostic);

#endif
