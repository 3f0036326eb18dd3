// habits.h: hints for syntax errors that are the ways of other languages.
#ifndef PETRI_SYNTAX_HABITS_H
#define PETRI_SYNTAX_HABITS_H

#include "base/source.h"

// How Flitter says what stands at `place`, where no token or none of this kind may stand; empty if nothing is known.
Str parse_habit(Arena *arena, const Source *source, Span place);

#endif
