// syntax_hints.h: hints for syntax errors that are the ways of other languages.
#ifndef PETRI_SYNTAX_SYNTAX_HINTS_H
#define PETRI_SYNTAX_SYNTAX_HINTS_H

#include "base/source.h"

// How Flitter says what stands at `place`, where no token or none of this kind may stand; empty if nothing is known.
Str syntax_hint_find(Arena *arena, const Source *source, Span span);

#endif
