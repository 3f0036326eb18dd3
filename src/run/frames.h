// frames.h: the loop over a script's frames, for `petri run` and `petri render`.
//
// Order of calls: frames_open, frames_load, frames_begin; then, as long as frames_due returns true, frames_step and
// frames_save_state; then frames_end, petri_close.
#pragma once

#include "cli/options.h"
#include "cli/progress.h"
#include "cli/state_file.h"
#include "petri.h"

typedef struct Frames {
    Options *options;
    PetriSession *session;
    Progress progress;
    int64_t done; // number of computed frames
    // Number of computed frames before the first picture. --frames and --runtime do not count them.
    int64_t before_first_picture;
    double start; // seconds of the monotonic clock
    StateFile state;
    const PetriRanks *ranks; // MPI ranks; NULL: a single process
    bool abandoned;          // true if a signal aborted the current frame
    bool shown_last;         // true if the last error or warning was shown; its notes are then shown as well
    bool memory_exceeded;    // true if the last error was that the memory limit was exceeded
    bool broken;             // true if the script or a module has a syntax error that was not made while the script ran
    bool invalid_definition; // true if the script rejected a value of -D
} Frames;

// Opens a session. Returns OPTIONS_READ or the exit status. *frames must be zero and must not move afterwards.
int frames_open(Frames *frames, const CommandContext *context, Options *options);
// Loads the script. Returns false after a diagnostic.
bool frames_load(Frames *frames);
// Restores the state from its file, then starts to catch signals and to show progress.
void frames_begin(Frames *frames);
// Returns true if another frame must be computed.
bool frames_due(const Frames *frames);
// Computes one frame. Returns false if the run must end. If the frame failed or exceeded a limit, prints a message. If
// a signal aborted the frame, only sets `abandoned`.
bool frames_step(Frames *frames);
// Saves the state if the time of the next save has come. Must be called after the frame's output is written.
void frames_save_state(Frames *frames);
// If `begins` is true, a signal interrupts the session from now on. If `begins` is false, a signal only requests the
// end of the run.
void frames_set_interruptible(Frames *frames, bool begins);
// Erases the progress line and, if the run succeeded (`going`), saves the state.
void frames_end(Frames *frames, bool going);
// Returns the number of the signal that requested the end of the run, or 0.
int frames_signal(void);
double frames_fps(const Frames *frames);
