// layout.h: the standard format of scripts.
//
// Line breaks are kept; only white space changes. Each level has four spaces. Spaces show precedence (a*b + c, but
// f(a+b) and x=a+b). There are no spaces around the `=` of a binding. There is at most one empty line in a block, and
// at most two between blocks. Comments after code are aligned. Tokens never change, and formatting is idempotent.
#pragma once

#include "cli/memory.h"
#include "petri.h"

// Returns the text with LF line endings and without a byte-order mark. The result is in the buffer, which is modified.
Str layout_normalise(Text *text);
// Appends the formatted script to `out`. Returns false if the script has an invalid token, or if out of memory. `text`
// must be normalised.
bool layout_text(PetriSession *session, Str text, Text *out);
// Returns true if both scripts have the same tokens and the same compiled code. `name` is the file name in messages.
bool layout_same(PetriSession *session, const char *name, Str before, Str after);
