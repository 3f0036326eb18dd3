// shown.h: what a room above the session takes of the last frame to draw it.
#ifndef PETRI_SESSION_SHOWN_H
#define PETRI_SESSION_SHOWN_H

#include "petri.h"

#include "canvas/read.h"
#include "scene/scene.h"
#include "session/diagnostics.h"

// Borrowed until the session is used otherwise.
typedef struct Shown {
    int64_t number; // of the frame; -1: none has been made
    Value tree;
    Schema *schema; // for reading its windows
    Scene *scene;   // its systems: scene_view
    const State *state;
    Str directory;       // what relative file names start from
    const Reach *reach;  // of its files
    size_t memory_bytes; // that a copy may have
    Meter *meter;        // that making it is charged to
} Shown;

Shown session_shown(PetriSession *session);

// The names of the frame that are numbers, `beat` and the like and what was defined; at most `room`, the names in the
// arena. Returns how many there are.
uint32_t session_numbers(PetriSession *session, Arena *arena, const char *names[], double numbers[], uint32_t room);

// Whether the source in which the fault lies is still there: a script may have been reloaded since.
bool session_has(const PetriSession *session, const Diag *fault);

// Memory that stays with the session, always of the same size, for the room that draws; zeros before frame 0. Within a
// protected call.
void *session_drawing(PetriSession *session, size_t size);

// Calls `call`. If an arena of the session or `extra` (or NULL) runs out meanwhile, what it was doing is given up:
// PETRI_MEMORY, or PETRI_LIMIT if only a budget was used up. What it has begun must be reachable from `context`.
typedef void SessionCall(PetriSession *session, void *context);
PetriStatus session_protect(PetriSession *session, Arena *extra, SessionCall *call, void *context);
// Tells that a protected call for "the frame" or the like was given up for want of memory or work, and where; takes a
// wish for an end as met. Returns the status.
PetriStatus session_tell_end(PetriSession *session, PetriStatus status, const char *what);

#endif
