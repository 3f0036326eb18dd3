// parameters.h: a script's parameters (`let NAME=NAME or DEFAULT`) as text, for all commands.
#ifndef PETRI_SRC_PARAMETERS_H
#define PETRI_SRC_PARAMETERS_H

#include "cli/byte_buffer.h"
#include "cli/output.h"
#include "petri.h"

// Writes a table of the loaded script's parameters: name, present value, range, comment; then those of its modules,
// which cannot be set. Returns how many lines of the first kind there were.
size_t parameters_list(PetriSession *session, Output *output);
// The script's own parameter of this name; false if there is none.
bool parameter_find(PetriSession *session, const char *name, PetriParameter *parameter);
// Adds `1..500`, or nothing if it has no range.
void parameter_range(ByteBuffer *out, const PetriParameter *parameter);
// Adds `NAME = VALUE  (1..500, default 200)`.
void parameter_describe(ByteBuffer *out, const PetriParameter *parameter);
// Is a diagnostic that of a definition which the script cannot take: a wrong command line?
bool is_invalid_definition(const PetriDiagnostic *diagnostic);

#endif
