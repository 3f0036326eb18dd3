// syntax_hints.h: hints for syntax errors caused by habits from other languages.
#ifndef PETRI_SYNTAX_SYNTAX_HINTS_H
#define PETRI_SYNTAX_SYNTAX_HINTS_H

#include "base/source.h"

// Returns a hint for the unexpected token at `span` about the correct syntax, or an empty string.
Str syntax_hint_find(Arena *arena, const Source *source, Span span);

#endif
