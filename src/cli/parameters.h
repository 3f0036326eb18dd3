// parameters.h: display of a script's parameters (`let NAME=NAME or DEFAULT`).
#pragma once

#include "cli/memory.h"
#include "cli/output.h"
#include "petri.h"

// Writes a table of the loaded script's parameters: name, current value, range and comment. Parameters of its modules,
// which cannot be set, follow. Returns the number of parameters that can be set.
size_t parameters_list(PetriSession *session, Output *output);
// Finds a parameter of the script itself, not of its modules. Returns false if no parameter has this name.
bool parameter_find(PetriSession *session, const char *name, PetriParameter *parameter);
// Adds a description such as `NAME = VALUE  (1..500, default 200)`.
void parameter_describe(Text *out, const PetriParameter *parameter);
// Returns true if the diagnostic reports that the script does not accept a definition (-D).
bool is_invalid_definition(const PetriDiagnostic *diagnostic);
