// value_reader.h: reading of values in printed form, for state files and recordings.
#pragma once

#include "petri.h"
#include "value/value.h"

typedef struct ValueReader {
    PetriSession *session; // owns the symbols
    Arena *arena;          // holds the values
    Str rest;              // text not read yet
} ValueReader;

// If the text starts with `prefix`, skips it and returns true.
bool value_reader_skip(ValueReader *reader, Str prefix);
// Reads elements separated by semicolons, or `null`. Returns false if the text is not valid.
bool value_reader_read(ValueReader *reader, Value *value);
