// diagnostics.h: reporting of diagnostics to the host, each once per load. Only diagnostics.c modifies this data.
#pragma once

#include "base/diag.h"
#include "base/hash_index.h"
#include "base/private_api.h"
#include "petri.h"

enum { MAX_RETAINED = 100 };

typedef struct Diagnostics {
    PetriDiagnostic *retained[MAX_RETAINED]; // ring buffer of the last diagnostics; each is one heap block that also
                                             // holds its strings
    uint32_t retained_first;                 // index in `retained` of the oldest diagnostic
    uint32_t retained_count;
    uint64_t *reported; // hashes of the diagnostics reported since the last load
    uint32_t reported_count;
    uint32_t reported_capacity;
    HashIndex reported_index;
    bool repeat; // true: report diagnostics even if they were reported before
    // Called before a diagnostic is passed to the host; returns false to hide it. NULL: none.
    bool (*filter)(void *context, const PetriDiagnostic *diagnostic);
    void *filter_context;
    uint64_t counts[3]; // number of diagnostics of each level, reported since the session was opened
} Diagnostics;

void diagnostics_free(Diagnostics *diagnostics);
// Returns a copy in one heap block, which the caller frees with heap_free, or NULL if out of memory.
PetriDiagnostic *diagnostics_copy(const PetriDiagnostic *diagnostic);
// Starts a load, or a run from frame 0: forgets which diagnostics were reported before.
void diagnostics_begin_load(Diagnostics *diagnostics);
// Sets whether diagnostics are reported even if they were reported before. Returns the previous setting.
bool diagnostics_repeat(Diagnostics *diagnostics, bool repeat);
// Passes a diagnostic to the session's host, even if it was reported before. petri_check uses this function to pass on
// the diagnostics of a temporary session.
void diagnostics_forward(PetriSession *session, const PetriDiagnostic *diagnostic);

// Reports a diagnostic to the host, unless it was already reported since the last load.
void session_report(PetriSession *session, const Diag *diag) PRIVATE_API(session_report);
// Like session_report, but uses `key` instead of the rendered text to recognise a repeated diagnostic. If `key` is
// empty, uses the rendered text.
void session_report_keyed(PetriSession *session, const Diag *diag, Str key);
// Reports a diagnostic without a position.
static inline void session_report_text(PetriSession *session, DiagLevel level, const char *code, Str text) {
    session_report(session, &(Diag){.level = level, .text = text, .code = code});
}
// Reports all diagnostics of a sink.
void session_report_all(PetriSession *session, const DiagSink *sink);
// Reports how many diagnostics a sink has not stored, if any.
void session_report_dropped(PetriSession *session, const DiagSink *sink) PRIVATE_API(session_report_dropped);
