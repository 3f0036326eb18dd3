// literal.h: the values of literal tokens (spec language.md L2.5 to L2.8).
#ifndef PETRI_AST_LITERAL_H
#define PETRI_AST_LITERAL_H

#include "base/arena.h"
#include "base/str.h"

// Value of a number token: digits with underscores, fraction, exponent and suffix. NULL on success, else the complaint.
const char *literal_number(Str token, double *x);
// Value of a timecode token `[h:]m:s[.f]`.
double literal_timecode(Str token);
// The text of a string token with its quotes: escapes resolved. NULL on success, else the complaint.
const char *literal_string(Arena *arena, Str token, Str *text);
// Reads a whole text as a number in the sense of L16.3: optional sign and surrounding spaces, digits with underscores,
// inf, nan, suffix. False if it is none.
bool literal_parse_number(Str text, double *x);
// Reads a whole text as a timecode. False if it is none.
bool literal_parse_timecode(Str text, double *x);

#endif
