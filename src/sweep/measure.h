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
    bool false_definition;        // true if a definition of the run has no effect, because its value is false
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
// Computes the first frame of the first run, to find errors in the script, its parameters and the expressions early.
// Returns STATUS_DONE, or the exit status after a message.
int measure_dry_run(Measure *measure);
// Adds the contents of all source files of the script, or the digest of the archive, to the hash.
void measure_hash_sources(Measure *measure, Sha256 *hash);
