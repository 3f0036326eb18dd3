// checkpoint.h: copies of the state, systems, input and clock, which determine how a session continues.
//
// Snapshots, state files and the rollback of aborted frames share this code. Restoring is atomic: the new data is built
// completely before it replaces the current data.
#pragma once

#include "petri.h"
#include "session/image.h"

typedef struct Checkpoint {
    Clock clock;
    unsigned char *bytes; // state, systems and input, in the format that checkpoint.c describes
    size_t size;
    size_t capacity;
} Checkpoint;

// Fills in `incoming`. Returns PETRI_INVALID if the file or checkpoint that is read is invalid.
typedef PetriStatus FillIncoming(PetriSession *session, Incoming *incoming, void *context);

// Calls `fill` within a protected call and then replaces the session's data. On failure nothing changes. Returns
// the status that `fill` returns, or the reason why the call was aborted.
PetriStatus checkpoint_replace(PetriSession *session, FillIncoming *fill, void *context);

// Copies the session's data into a checkpoint, replacing its contents but reusing its memory. Returns false if out of
// memory.
bool checkpoint_save(Checkpoint *checkpoint, PetriSession *session);
// Adds the state entries of a checkpoint to `state`, which must be empty. Allocates temporary data in `arena`.
void checkpoint_read_state(const Checkpoint *checkpoint, Arena *arena, State *state);
// Restores a checkpoint. On failure nothing changes.
PetriStatus checkpoint_restore(PetriSession *session, const Checkpoint *checkpoint);
