// definitions.h: parameters of a script and the definitions (-D) that set them.
#pragma once

#include "petri.h"
#include "program/program.h"

// Modules that a program imports at its top level, directly or indirectly, each once.
enum { MAX_MODULES = 64 };
typedef struct ModuleList {
    const Program *items[MAX_MODULES];
    uint32_t count;
} ModuleList;

// Adds the modules that a program imports. Called within a protected call. The recursion depth is at most MAX_MODULES.
void session_collect_modules(PetriSession *session, const Program *program, ModuleList *list);
// Returns the definition of a name, or NULL.
const Define *session_find_define(const PetriSession *session, const Symbol *name);
// Returns true if the definition sets the parameter: it is true, or the parameter also accepts what is false.
bool session_uses_define(const Parameter *parameter, Value defined);
// Returns the number if the value is a single number, else NaN.
double session_one_number(const PetriSession *session, Value v);
