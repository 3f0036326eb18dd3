// draw_access.h: what a room above the session takes of the last frame to draw it.
#ifndef PETRI_SESSION_DRAW_ACCESS_H
#define PETRI_SESSION_DRAW_ACCESS_H

#include "canvas/read.h"
#include "petri.h"
#include "scene/scene.h"
#include "session/diagnostics.h"

// Borrowed until the session is used otherwise.
typedef struct DrawAccess {
    int64_t number; // of the frame; -1: none has been made
    Value tree;
    Schema *schema; // for reading its windows
    Scene *scene;   // its systems: scene_view
    const State *state;
    Str directory;           // what relative file names start from
    const FileAccess *reach; // of its files
    size_t memory_limit;     // that a copy may have
    Budget *meter;           // that making it is charged to
} DrawAccess;

DrawAccess session_draw_access(PetriSession *session);

// The names of the frame that are numbers, `beat` and the like and what was defined; at most `room`, the names in the
// arena. Returns how many there are.
uint32_t session_frame_numbers(PetriSession *session, Arena *arena, const char *names[], double numbers[],
                               uint32_t capacity);

// Whether the source in which the fault lies is still there: a script may have been reloaded since.
bool session_has_source(const PetriSession *session, const Diag *fault);

// Memory that stays with the session, always of the same size, for the room that draws; zeros before frame 0. Within a
// protected call.
void *session_draw_memory(PetriSession *session, size_t size);

// Calls `call`. If an arena of the session or `extra` (or NULL) runs out meanwhile, what it was doing is given up:
// PETRI_OUT_OF_MEMORY, or PETRI_LIMIT_EXCEEDED if only a budget was used up. What it has begun must be reachable from
// `context`.
typedef void SessionCall(PetriSession *session, void *context);
PetriStatus session_protect(PetriSession *session, Arena *extra, SessionCall *call, void *context);
// Tells that a protected call for "the frame" or the like was given up for want of memory or work, and where; takes a
// wish for an end as met. Returns the status.
PetriStatus session_report_abort(PetriSession *session, PetriStatus status, const char *what);

#endif
