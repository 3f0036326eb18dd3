// workers.h: workers that execute runs. They are processes (worker_pool.c), so that a crash ends only one run and
// becomes a row of the table, or threads, where there are no processes (worker_sequence.c).
#pragma once

#include "sweep/journal.h"
#include "sweep/measure.h"
#include "sweep/sweep.h"

// The result of a run that a worker sends.
typedef struct ResultPacket {
    int64_t run;
    int64_t frames;
    int64_t origin;       // ResultOrigin
    uint64_t rows;        // length in bytes
    uint64_t diagnostics; // length in bytes
    char bytes[];         // the rows, then the diagnostics
} ResultPacket;

// For measure_open: adds a diagnostic to the Text `context`: a letter for the level, the text, NUL. Ignores diagnostics
// after 64 KiB.
void result_add_diagnostic(void *context, PetriLevel level, const char *rendered);
// Replaces the bytes of `bytes` by a ResultPacket, whose run, frames and origin are those of `head`, and returns it. It
// is valid until `bytes` changes.
const ResultPacket *result_pack(const ResultPacket *head, Str rows, Str diagnostics, Text *bytes);
size_t result_size(const ResultPacket *packet); // in bytes
// Executes a run and returns its result like result_pack. `diagnostics` is the context of measure_open.
const ResultPacket *result_execute(Measure *measure, int64_t run, Text *diagnostics, Text *bytes);
// Reports the diagnostics of a result and stores its rows, also in the journal. Returns false after a message.
bool result_store(Sweep *sweep, Journal *journal, const ResultPacket *packet);

// Catches the signals that stop a sweep, and forgets earlier ones.
void worker_catch_signals(void);
// Returns the number of the last signal since then, or 0.
int worker_signal(void);

// Returns true if this process executes runs for another one, which stores the results.
bool worker_pool_is_remote(const Sweep *sweep);
// Executes all runs of this shard that are not done, `jobs` at a time in each MPI rank. Only rank 0 has a journal and
// stores results. Returns STATUS_DONE or the exit status: STATUS_FAILED after a message, or 128 plus a signal number.
int worker_pool_run(Sweep *sweep, Journal *journal, int64_t jobs);
