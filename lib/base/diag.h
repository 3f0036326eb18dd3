// diag.h: diagnostics, from where they arise to how they read.
//
// Whoever finds a fault reports it to a sink with a place; nobody below src/ prints. A diagnostic is a plain struct in
// the sink's arena. Reports of the same text at the same place are kept once, since a frame repeats 60 times a second.
#ifndef PETRI_BASE_DIAG_H
#define PETRI_BASE_DIAG_H

#include "base/hash_index.h"
#include "base/source.h"

typedef enum DiagLevel { DIAG_ERROR, DIAG_WARNING, DIAG_NOTE } DiagLevel;

typedef struct Diag {
    DiagLevel level;
    const Source *source; // NULL: no place, the message stands alone
    Span span;
    Str text;
    Str hint;         // a second sentence that helps, or empty
    const char *code; // short name of the kind of fault, such as "unbound-name"
} Diag;

// A growing list of distinct diagnostics.
typedef struct DiagSink {
    Arena *arena; // texts and entries live here
    Diag *items;
    uint32_t count;
    uint32_t capacity;
    uint32_t error_count;
    HashIndex index;
    uint32_t limit; // entries kept at the most; later ones are only counted
    uint32_t dropped;
} DiagSink;

DiagSink diag_sink_new(Arena *arena, uint32_t limit);
// Releases the index; the entries go with the arena.
void diag_sink_free(DiagSink *sink);
// Keeps a copy of `diag` unless the same text at the same place is there; true if it is new. The source must live at
// least as long as the sink.
bool diag_report(DiagSink *sink, const Diag *diag);
// The text, or as much of it as is worth showing.
Str diag_text(const Diag *diag);
// `FILE:LINE:COLUMN: level: text`, the source line, carets, and the hint (spec cli.md 3.5), each line ended.
void diag_format(Text *out, const Diag *diag, bool colour);
// `text (FILE:LINE)`: the one-line form that a frame's `?` section holds.
Str diag_one_line(Arena *arena, const Diag *diag);

#endif
