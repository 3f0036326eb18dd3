// measure.h: one run after the other in one session: the script is loaded once, and each run gives its names other
// values.
#ifndef PETRI_SRC_MEASURE_H
#define PETRI_SRC_MEASURE_H

#include "petri.h"
#include "sweep/sweep.h"

typedef struct Measure {
    const Integrator *sweep;
    PetriSession *session;
    PetriConfig *base; // the script without definitions
    bool silent;
    bool invalid_definition; // the script cannot take a value
    int64_t frames;          // of the run that was made last
    ByteBuffer rows;         // … and what was measured
    ByteBuffer error;        // the last that the script was told of in it
    void (*on_diagnostic)(void *context, PetriLevel level, const char *rendered);
    void *context;
} Measure;

// False after a message. `tell` is called with each diagnostic of a run.
bool measure_open(Measure *measure, const Integrator *sweep,
                  void (*tell)(void *context, PetriLevel level, const char *rendered), void *context);
void measure_close(Measure *measure);
void measure_run(Measure *measure, size_t run);
// Makes the first frame of the first run, so that what is wrong with script, names and expressions is known before work
// begins. STATUS_DONE, or the status to exit with after a message.
int measure_dry_run(Measure *measure);
// Adds all files that the script is made of to the hash.
void measure_hash_sources(Measure *measure, Sha256 *hash);

#endif
