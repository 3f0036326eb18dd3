// frame.h: the results of the last frame. Modified only by frame.c, and by prompt.c for statements of the prompt.
#pragma once

#include "base/diag.h"
#include "petri.h"
#include "state/state.h"
#include "value/value.h"

// The pairs of a node's kind and its parent's kind that occurred in windows since the script was loaded.
typedef struct SeenNodes {
    const Symbol *pairs[64][2]; // parent (NULL: a window), child
    uint32_t count;
} SeenNodes;

typedef struct SessionFrame {
    Arena arena;         // values of the frame, kept until the next step; limited by PetriOptions.memory_limit
    Arena systems_arena; // data of the systems; not limited, so that no system stops in the middle of an update
    Value tree;
    DiagSink log;    // output of debug(), each message once
    DiagSink errors; // run-time errors, each message once
    // Values of the names in PromptList.names, in the same order. Fewer if the frame was not evaluated completely.
    Value *values;
    uint32_t value_count;
    bool evaluated; // `tree` and `values` belong to the current frame and configuration
    // True if the values of names bound at the prompt were computed from the state after the frame
    // (session_update_names).
    bool names_current;
    bool evaluating;   // true while an evaluation is in progress
    bool no_frame_yet; // no frame of the loaded script has been computed
    SeenNodes seen;
    struct LookupLog *missed; // lookups of the first frame that found nothing, in `arena`; NULL in other frames
    uint64_t physics_steps;
    double evaluation_seconds;
    double physics_seconds;
    double profiled_physics; // seconds spent on the systems since the script was loaded or reset
    uint64_t profiled_frames;
    const char **system_names; // names of systems in printed form, by number; NULL until needed
    size_t system_name_count;
} SessionFrame;

// Frees the results of the last frame: tree, log, values of names.
void session_clear_frame(PetriSession *session);
// Like session_clear_frame, but also frees the blocks of the arenas. Used after an aborted frame.
void session_drop_frame(PetriSession *session);
// Evaluates the prompt's bindings again, with the state after the frame. Does nothing if names_current is set. Names
// that the script binds keep their values.
PetriStatus session_update_names(PetriSession *session);
