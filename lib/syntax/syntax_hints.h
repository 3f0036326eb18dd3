// syntax_hints.h: hints for syntax errors caused by habits from other languages.
#ifndef PETRI_SYNTAX_SYNTAX_HINTS_H
#define PETRI_SYNTAX_SYNTAX_HINTS_H

#include "base/source.h"

// Returns a hint how to write in Flitter what is at `span`, the location of an unexpected token. Empty if none is
// known.
Str syntax_hint_find(Arena *arena, const Source *source, Span span);

#endif
