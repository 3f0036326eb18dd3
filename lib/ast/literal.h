// literal.h: the values of literal tokens (spec language.md L2.5 to L2.8).
#pragma once

#include "base/arena.h"
#include "base/str.h"

// Parses a number token: digits with underscores, fraction, exponent and suffix. Returns NULL on success, else an error
// message.
const char *literal_number(Str token, double *x);
// Returns the seconds of a timecode token `[h:]m:s[.f]`.
double literal_timecode(Str token);
// Decodes a string token: removes its quotes and resolves escapes. Returns NULL on success, else an error message.
const char *literal_string(Arena *arena, Str token, Str *text);
// Parses a string as a number according to L16.3: a number as in literal_number, `inf` or `nan`. A sign and surrounding
// spaces are allowed. Returns false if the whole string is not a number.
bool literal_parse_number(Str text, double *x);
// Parses a string as a timecode. Returns false if the whole string is not a timecode.
bool literal_parse_timecode(Str text, double *x);
