// image_text.h: images as text, for state files and for the keyframes of recordings.
//
// A state file is line-based text, so that users can read and compare it:
//
//     petri-state 2
//     spec 0.4                              version of the specification by which the state was computed
//     frame 99
//     $(:cells;0) = 12.5;-3                 every entry of the dictionary
//     system 0 $(:cells)                    each system: its index among systems with the same prefix,
//     particle $(:cells;0)                  then the position key of each particle, in order
//     end 1f0e6c9d7a5b4832                  hash of all bytes before this line
//
// A keyframe is a state file and a setup: the lines of the other parts (image.h). Values are in the language's printed
// form, which reads back as the same doubles. The hash detects files that were truncated or edited. Files of petri 0.3
// begin with `petri-state 1` and have no line `spec`.
#pragma once

#include "session/image.h"

// Return the text of a state file, or of the given parts of a setup, in the session's text arena. Called within a
// protected call.
Str image_state_text(PetriSession *session);
Str image_setup_text(PetriSession *session, unsigned parts);
// Reads the text of a state file into `incoming`, except for its clock: sets *frame. Returns NULL, or the reason for a
// failure. Called by a FillIncoming function.
const char *image_read_state(PetriSession *session, Incoming *incoming, Str text, int64_t *frame);

typedef struct TextReader {
    PetriSession *session; // owns the symbols
    Arena *arena;          // holds the values
    Str rest;              // text not read yet
} TextReader;

// A line consists of one or more of these: a name, an integer, a key `$(KEY)`, and a value after ` = `.
typedef struct TextLine {
    Str name;
    bool has_number, has_key, has_value;
    int64_t number;
    Value key;
    Value value;
} TextLine;

// If the text starts with `prefix`, skips it and returns true.
bool text_reader_skip(TextReader *reader, Str prefix);
// Reads elements separated by semicolons, or `null`. Returns false if the text is not valid.
bool text_reader_value(TextReader *reader, Value *value);
// Reads the next line. Returns false if the text is not valid.
bool text_reader_line(TextReader *reader, TextLine *line);
