// worker_result.h: the result of a run that a worker sends: a ResultHeader, the rows and the diagnostics.
#pragma once

#include "sweep/journal.h"
#include "sweep/measure.h"
#include "sweep/sweep.h"

typedef struct ResultHeader {
    int64_t run;
    int64_t frames;
    int64_t origin;       // ResultOrigin
    uint64_t rows;        // length in bytes
    uint64_t diagnostics; // length in bytes
} ResultHeader;

// For measure_open: adds a diagnostic to the Text `context`: a letter for the level, the text, NUL. Ignores diagnostics
// after 64 KiB.
void result_add_diagnostic(void *context, PetriLevel level, const char *rendered);
// Executes a run and replaces `packet` by its result. `diagnostics` is the context of measure_open.
void result_execute(Measure *measure, int64_t run, Text *diagnostics, Text *packet);
// Reports the diagnostics of a result and stores its rows, also in the journal. `bytes` contains the rows followed by
// the diagnostics. Returns false after a message.
bool result_store(Sweep *sweep, Journal *journal, const ResultHeader *head, const char *bytes);
