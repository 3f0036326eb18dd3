// diagnostics.h: what the host is told, each thing once. Only diagnostics.c writes this part of a session.
#ifndef PETRI_SESSION_DIAGNOSTICS_H
#define PETRI_SESSION_DIAGNOSTICS_H

#include "base/diag.h"
#include "base/hash_index.h"
#include "petri.h"

enum { MAX_RETAINED = 100 };

typedef struct Diagnostics {
    PetriDiagnostic *retained[MAX_RETAINED]; // a ring of copies, each in a block of its own
    uint32_t retained_first;                 // the oldest
    uint32_t retained_count;
    uint64_t *reported; // hashes of what was given already
    uint32_t reported_count;
    uint32_t reported_capacity;
    HashIndex reported_index;
    bool repeat;        // give again what was given before
    uint64_t counts[3]; // by level, since the session was opened
} Diagnostics;

void diagnostics_free(Diagnostics *diagnostics);
// A script is being loaded: each thing is told once per load.
void diagnostics_begin_load(Diagnostics *diagnostics);
// Says whether what was given before is given again; returns what held so far.
bool diagnostics_repeat(Diagnostics *diagnostics, bool repeat);
// Gives the diagnostic of another session to the host, as one of this.
void diagnostics_forward(PetriSession *session, const PetriDiagnostic *diagnostic);

// Gives a diagnostic to the host unless it was given before.
void session_report(PetriSession *session, const Diag *diag);
// The same once for each key, whatever the text; an empty key stands for the text.
void session_report_keyed(PetriSession *session, const Diag *diag, Str key);
// A diagnostic without a place.
void session_report_text(PetriSession *session, DiagLevel level, const char *code, Str text);
// Hands over what a sink has collected.
void session_report_all(PetriSession *session, const DiagSink *sink);

#endif
