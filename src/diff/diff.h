// diff.h: internal declarations of `petri diff`.
//
// Two runs are compared frame by frame until a frame differs. Each run is a side: a script that is computed in this
// process, or recorded or printed frames. More kinds of sides can be added as tables of functions (SideKind).
#pragma once

#include "cli/options.h"
#include "cli/state_text.h"
#include "petri.h"

#include <stdio.h>
#include <sys/types.h>

typedef struct Side Side;
typedef struct CommittedFile CommittedFile;

typedef struct SideKind {
    // Goes to the next frame. Returns false if there is none, or after a message if it failed (Side.failed).
    bool (*next)(Side *side);
    // Appends the frame in printed form: a line `@FRAME …`, then the entries of the state.
    void (*print)(Side *side, Text *text);
    void (*close)(Side *side);
} SideKind;

// One of the two runs. `kind` is NULL until the side is open.
struct Side {
    const SideKind *kind;
    const CommandContext *host;
    const Options *options; // of this side
    const char *source;     // script, golden or state file
    const char *with;       // program that computes the frames; NULL: this one
    Text label;             // name in the report
    bool failed;
    int64_t frame;  // number of the current frame
    double time;    // of the current frame; NaN: unknown
    int64_t frames; // maximum number of frames
    // A side that is computed in this process:
    PetriSession *session;        // NULL: only printed frames are known
    int64_t computed;             // number of computed frames
    struct PetriArchive *archive; // archive that is replayed; NULL: none
    char *revision;               // of git that the script is read from; NULL: none
    CommittedFile *committed;     // files read from this revision
    TextList *reported;           // diagnostics of both sides, each of which is shown once
    // A side that is read as text:
    FILE *stream;
    pid_t process; // writes `stream`; 0: none
    Text current;  // the current frame
    Text ahead;    // first line of the next frame
};

// side.c: opens a side according to the suffix of its source and its options. Returns false after a message.
bool side_open(Side *side);
bool side_is_golden(const char *source);
void side_close(Side *side);
// Computes frames up to a frame number in another process and returns its answer to a command of the prompt, or NULL
// after a failure. The caller frees the answer.
char *side_ask(const Side *side, int64_t frame, const char *command);

// committed.c: scripts as git has them, REVISION:FILE.
bool committed_is(const char *source);
// Loads the script into the session. Returns false after a message.
bool committed_load(Side *side);
// Options.unsaved with a Side as its host: returns a file of the revision, or NULL if git does not have it.
const char *committed_read(void *context, const char *path, size_t *length);
void committed_free(Side *side);

// printed.c: opens a golden, or starts the program `with`, and reads the frames that it prints.
bool printed_open_golden(Side *side);
bool printed_open_process(Side *side);

// One of the forces on a particle, as text.
typedef struct ForceRow {
    char *name;     // kind of the force; NULL: the side has no such contribution
    char *partner;  // id of the other particle, or "-"
    char *vector;   // the contribution
    char *position; // FILE:LINE, or "-"
} ForceRow;

// The first contribution to the force on a particle that is not the same on both sides.
typedef struct ForceDifference {
    bool known;       // false: forces could not be compared
    Text first;       // key of the first particle that differs, in document order; empty: none
    Text particle;    // key of the particle with this force; empty: none
    uint64_t step;    // step of the frame, from 0
    uint64_t steps;   // number of steps of the frame
    ForceRow rows[2]; // names are NULL if all contributions are the same
    Text cause;       // other reason why the particle differs; empty: none is known
    Text attributes;  // attributes of the particle that differ, one per line
} ForceDifference;

// forces.c: finds the first particle that differs, in document order, and the first of its forces that differs.
void forces_compare(Side *sides, const StateDifferences *differences, ForceDifference *found);
void forces_free(ForceDifference *found);

// report.c: the differences in the first frame that differs.
typedef struct DiffReport {
    const Side *sides;
    const StateDifferences *differences;
    const ForceDifference *force;
} DiffReport;
void report_text(const DiffReport *report, Text *text);
void report_json(const DiffReport *report, Text *text);
