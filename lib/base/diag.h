// diag.h: collection and formatting of diagnostics.
//
// Code in lib/ reports errors and warnings to a sink; only src/ prints them. The sink stores them in its arena. A
// diagnostic with the same text and location is stored once, because a script is evaluated up to 60 times a second.
#pragma once

#include "base/hash_index.h"
#include "base/source.h"

typedef enum DiagLevel { DIAG_ERROR, DIAG_WARNING, DIAG_NOTE } DiagLevel;

// The program that a shader compiler's message is about. The text of such a diagnostic is the message itself until
// draw_place_shader_error has found the position in the script.
typedef struct DiagShader {
    const char *node; // kind of the node; NULL: the diagnostic is not such a message
    Str program;      // must outlive the sink
} DiagShader;

typedef struct Diag {
    DiagLevel level;
    Origin at; // location; its source is NULL if the diagnostic has none
    Str text;
    Str hint;         // advice for fixing the problem; empty: none
    const char *code; // short name of the kind of diagnostic, such as "unbound-name"; NULL: none
    DiagShader shader;
} Diag;

// A growing list of distinct diagnostics.
typedef struct DiagSink {
    Arena *arena; // holds the texts and entries
    Diag *items;
    uint32_t count;
    uint32_t capacity;
    uint32_t error_count;
    HashIndex index;  // index of `items`, used to find duplicates
    uint32_t limit;   // maximum of `count`; further diagnostics only increment `dropped`
    uint32_t dropped; // number of diagnostics beyond `limit`
} DiagSink;

DiagSink diag_sink_new(Arena *arena, uint32_t limit);
// Frees the index. The entries are freed with the arena.
void diag_sink_free(DiagSink *sink);
// Stores a copy of `diag` and returns true. Returns false if the same text at the same location is already stored, or
// if the sink is full. The source must outlive the sink.
bool diag_report(DiagSink *sink, const Diag *diag);
// Returns the text of a diagnostic, truncated to 400 bytes.
Str diag_text(const Diag *diag);
// Appends `FILE:LINE:COLUMN: level: text`, the source line, a caret line and the hint (spec cli.md 3.5). Every line
// ends with a newline.
void diag_format(Text *out, const Diag *diag, bool colour);
// Returns `text (FILE:LINE)`, the format used in the `?` section of a printed frame.
Str diag_one_line(Arena *arena, const Diag *diag);
