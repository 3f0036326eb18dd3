// frame.h: what the last frame has made. Only frame.c and, for what is typed in the frame, prompt.c write it.
#ifndef PETRI_SESSION_FRAME_H
#define PETRI_SESSION_FRAME_H

#include "base/diag.h"
#include "petri.h"
#include "state/state.h"
#include "value/value.h"

typedef struct SessionFrame {
    Arena arena;         // values, until the next step; limited by PetriOptions.memory_bytes
    Arena systems_arena; // what the systems need: outside the script's budget, so that no update stops half-way
    Value tree;
    DiagSink log;    // texts of debug(), each once
    DiagSink errors; // texts of run-time faults, each once
    // What the names of the prompt's list stand for; fewer if the frame was not evaluated (to the end).
    Value *values;
    uint32_t value_count;
    bool evaluated;     // tree and values are those of the present frame and configuration
    bool names_current; // the values of names bound at the prompt are those in the state after the frame
    bool evaluating;    // evaluation is under way
    bool no_frame_yet;  // no frame of the loaded script has been made
    uint64_t physics_steps;
    double evaluation_seconds;
    double physics_seconds;
    double profiled_physics; // seconds, since the script was loaded
    uint64_t profiled_frames;
    const char **system_names; // printed so far, by number
    size_t system_name_count;
} SessionFrame;

// Drops what was computed in the last frame: tree, log, values of names.
void session_clear_frame(PetriSession *session);
// Evaluates the script and the prompt's statements in a state. Within a protected call.
void session_evaluate(PetriSession *session, const State *state);
// Evaluates the names bound at the prompt in the state after the frame, unless that was done already. Names of the
// script keep their values.
PetriStatus session_update_names(PetriSession *session);

#endif
