// syntax_hints.h: hints for syntax errors caused by habits from other languages.
#pragma once

#include "base/source.h"

// Returns a hint for the unexpected token at `span` about the correct syntax, or an empty string.
Str syntax_hint_find(Arena *arena, const Source *source, Span span);
