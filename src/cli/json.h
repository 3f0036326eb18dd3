// json.h: functions that write JSON.
#pragma once

#include "cli/memory.h"
#include "petri.h"

// Adds a quoted and escaped string. Invalid UTF-8 becomes U+FFFD; NULL becomes null.
void json_add_text(Text *out, const char *text);
// Adds members to an object whose brace is open: names and strings in turn, then NULL.
void json_add_members(Text *out, const char *const members[]);
#define JSON_ADD(out, ...) json_add_members(out, (const char *const[]){__VA_ARGS__, NULL})
// Returns "error", "warning" or "note".
const char *level_word(PetriLevel level);
// Adds a diagnostic as an object on one line.
void json_add_diagnostic(Text *out, const PetriDiagnostic *diagnostic);
