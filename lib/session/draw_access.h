// draw_access.h: the internal interface through which lib/picture reads the last frame.
#pragma once

#include "base/private_api.h"
#include "builtin/pictures.h"
#include "canvas/read.h"
#include "petri.h"
#include "scene/scene.h"
#include "session/diagnostics.h"

// The last frame's data. Valid until the next call that uses the session.
typedef struct DrawAccess {
    int64_t number; // frame number; -1: no frame yet
    double beat;
    Value tree;
    Schema *schema; // reads the windows of `tree`
    Scene *scene;   // particle systems (scene_view)
    const State *state;
    Str directory;           // folder that relative file names start from
    const FileAccess *reach; // file access of the script
    size_t memory_limit;     // maximum bytes of a picture, which is a copy of the frame
    bool samples;            // true if the script has called sample()
    Budget *budget;          // budget that the memory of a picture is charged to
} DrawAccess;

// Returns access to the last frame.
DrawAccess session_draw_access(PetriSession *session) PRIVATE_API(session_draw_access);

// Sets the functions through which scripts access fonts and pictures; NULL: none. They must live until they are
// replaced.
void session_set_pictures(PetriSession *session, BuiltinPictures *pictures) PRIVATE_API(session_set_pictures);

// Stores the names that have numeric values in `names`, and these values in `numbers`, for shaders. The names of the
// engine, such as `beat`, come first, then those of the definitions. If a name is defined more than once, its newest
// definition comes first. Stores at most `capacity` names and returns how many it stored. Allocates the names of
// definitions in `arena`.
uint32_t session_frame_numbers(PetriSession *session, Arena *arena, const char *names[], double numbers[],
                               uint32_t capacity) PRIVATE_API(session_frame_numbers);

// Calls a function of the last frame for `count` points and stores the results in `distances`. Reports the
// first result that is not a finite number; such results become INFINITY. Returns false if the function failed. Called
// within a protected call that protects the arena.
bool session_sample_function(PetriSession *session, Arena *arena, FunctionSamples *function, const double (*points)[3],
                             uint32_t count, double *distances) PRIVATE_API(session_sample_function);

// Returns true if the source of a diagnostic still exists. A reload may have freed the source.
bool session_has_source(const PetriSession *session, const Diag *diag) PRIVATE_API(session_has_source);

// Adds the work of drawing to the result of petri_work.
void session_add_work(PetriSession *session, uint64_t work) PRIVATE_API(session_add_work);

// Returns memory for lib/picture that lives as long as the session and is zeroed before frame 0. All calls must pass
// the same size. Called within a protected call.
void *session_draw_memory(PetriSession *session, size_t size) PRIVATE_API(session_draw_memory);

// Runs `call` as a protected call: it is aborted if memory runs out, a limit is exceeded or the session is interrupted.
// This applies to allocations in the arenas of the session and in `extra`, which may be NULL. Returns the status that
// `call` returns, or the reason for the abort: PETRI_OUT_OF_MEMORY, PETRI_LIMIT_EXCEEDED or PETRI_INTERRUPTED.
// Resources that `call` acquires must be reachable from `context`, so that the caller can free them after an abort.
typedef PetriStatus SessionCall(PetriSession *session, void *context);
PetriStatus session_protect(PetriSession *session, Arena *extra, SessionCall *call, void *context)
    PRIVATE_API(session_protect);
// Handles the status of a protected call. If the call ran out of memory or exceeded a limit, reports that `what` (such
// as "the frame") was aborted. For a limit, the report gives the position in the script, if known. If the call was
// interrupted, clears the interrupt. Returns `status`.
PetriStatus session_report_abort(PetriSession *session, PetriStatus status, const char *what)
    PRIVATE_API(session_report_abort);
// Calls session_protect, then session_report_abort.
PetriStatus session_run(PetriSession *session, SessionCall *call, void *context, const char *what);
