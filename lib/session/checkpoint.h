// checkpoint.h: all that decides how a session goes on, besides its configuration: state, systems, input, clock.
//
// Undoing a frame, snapshots and state files have this in common. Going back is one act: whatever takes the place of
// the present is made first, beside it, and only when all of it is there do both change places.
#ifndef PETRI_SESSION_CHECKPOINT_H
#define PETRI_SESSION_CHECKPOINT_H

#include "petri.h"
#include "scene/scene.h"
#include "session/clock.h"

typedef struct Checkpoint {
    Clock clock;
    unsigned char *bytes; // state, systems and input (checkpoint.c)
    size_t size;
    size_t capacity;
} Checkpoint;

// What is to take the place of the session's own. Systems are restored into the scene, whose own are set aside.
typedef struct Incoming {
    Arena arena; // temporaries
    State *state;
    Clock clock;
    InputState input_state;
    InputBindings bindings;
    bool has_input; // else the session keeps its own
    bool valid;     // there is nothing wrong with where it comes from
} Incoming;
typedef void FillIncoming(PetriSession *session, Incoming *incoming, void *context);

// Lets `fill` make what is incoming, within a protected call, and puts it in place. PETRI_OUT_OF_MEMORY or
// PETRI_INVALID
// (`good` is false) change nothing.
PetriStatus checkpoint_replace(PetriSession *session, FillIncoming *fill, void *context);
// For `fill`: takes a system into the scene.
void checkpoint_restore_system(PetriSession *session, Incoming *incoming, const SceneSystem *system);

// Copies the present into a checkpoint's memory, which is used again; false if memory is used up.
bool checkpoint_save(Checkpoint *checkpoint, PetriSession *session);
// Adds the entries of a checkpoint to an empty state; temporaries are in the arena.
void checkpoint_read_state(const Checkpoint *checkpoint, Arena *arena, State *state);
// Goes back to it. PETRI_OUT_OF_MEMORY changes nothing.
PetriStatus checkpoint_restore(PetriSession *session, const Checkpoint *checkpoint);

#endif
