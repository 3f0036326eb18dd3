// layout.h: the one layout of scripts.
//
// Lines stay as they are broken; what changes is the white space in them: four spaces for each level, spaces that show
// precedence (a*b + c, but f(a+b) and x=a+b), none around the `=` of a name, at most one empty line in blocks and two
// between them, comments behind code in one column. No token changes, and what has the layout keeps it.
#ifndef PETRI_SRC_LAYOUT_H
#define PETRI_SRC_LAYOUT_H

#include "cli/byte_buffer.h"
#include "petri.h"

// Adds the text in that layout; false if it has characters that no token starts with, or memory is used up. Texts begin
// with no byte-order mark and their lines end in LF.
bool layout_text(PetriSession *session, Str text, ByteBuffer *out);
// Does the one text have the tokens of the other, and do both come to the same code? `name` stands for their file.
bool layout_same(PetriSession *session, const char *name, Str before, Str after);

#endif
