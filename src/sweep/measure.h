// measure.h: execution of runs, one after the other in the same session. If the script can be loaded without
// definitions, its file is read only once. The script is compiled again for each run, with the definitions of that run.
//
// If the script is an archive, its files and its first configuration are used, without its inputs. Each process opens
// the archive itself.
#pragma once

#include "petri-edit.h"
#include "sweep/cache.h"

typedef struct Measure {
    const Sweep *sweep;
    PetriSession *session;
    struct PetriArchive *archive; // archive that is used instead of a script; NULL: none
    const char *archive_sha256;   // digest of the archived run; NULL: none
    PetriConfig *base;            // configuration without the definitions of a run
    bool silent;                  // true if diagnostics are not reported
    bool invalid_definition;      // true if the script rejected a value
    bool diverged;                // true if the motion of a system became meaningless in the run
    bool unstable;                // true if a force of the run is too strong for the length of a step
    bool false_definition;        // true if a definition of the run has no effect, because its value is false
    bool strict;                  // true while expressions are checked: an unbound name is an error
    bool unbound_name;            // true if the script or an expression of the run has an unbound name
    const char *unread;           // name of an axis that neither the script nor the expressions read; NULL: none
    TextList expression_names;    // names in --until and in the metrics
    CacheEntry result;            // of the last run; the digest is set if there is a cache
    ResultOrigin origin;          // of the last run
    ReadFiles files;              // read by the session so far; used if there is a cache
    KnownHashes known;            // of files that earlier runs have read
    Text error;                   // last error of the last run; empty: none
    void (*on_diagnostic)(void *context, PetriLevel level, const char *rendered);
    void *context;
} Measure;

// Opens a session for the runs. `report` is called with each diagnostic of a run. Returns false after a message.
bool measure_open(Measure *measure, const Sweep *sweep,
                  void (*report)(void *context, PetriLevel level, const char *rendered), void *context);
void measure_close(Measure *measure);
// Executes a run. Sets `result` and `origin`.
void measure_run(Measure *measure, size_t run);
// Resets the session, applies the definitions of a run and loads the script. Returns PETRI_INVALID after a diagnostic
// if the script does not use the value of one of the definitions.
PetriStatus measure_begin_run(Measure *measure, size_t run);
// Finds errors in the script, its parameters and the expressions early (dry_run.c): loads the script with each value
// that it may reject, and computes the first frame of a run. Returns STATUS_DONE, or the exit status after a
// message.
int measure_dry_run(Measure *measure);
// Shows a hint for each metric that is only the name of a `let` which reads the state (late_metrics.c).
void measure_hint_late_metrics(Measure *measure);
// Adds the contents of all source files of the script, or the digest of the archive, to the hash.
void measure_hash_sources(Measure *measure, Sha256 *hash);
