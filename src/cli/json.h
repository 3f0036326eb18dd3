// json.h: writing JSON.
#ifndef PETRI_SRC_JSON_H
#define PETRI_SRC_JSON_H

#include "cli/byte_buffer.h"
#include "petri.h"

// Adds a string with its quotes; what is not UTF-8 becomes U+FFFD. NULL is null.
void json_add_text(ByteBuffer *out, const char *text);
// The word for a level.
const char *level_word(PetriLevel level);
// Adds a diagnostic as an object in one line.
void json_add_diagnostic(ByteBuffer *out, const PetriDiagnostic *diagnostic);

#endif
