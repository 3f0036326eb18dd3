// frames.h: the loop over a script's frames, for the commands that have one.
//
// frames_open, frames_load, frames_begin; while frames_due: frames_step, frames_save_state; frames_end; petri_close.
#ifndef PETRI_SRC_FRAMES_H
#define PETRI_SRC_FRAMES_H

#include "cli/options.h"
#include "cli/progress.h"
#include "cli/state_file.h"
#include "petri.h"

typedef struct Frames {
    Options *options;
    PetriSession *session;
    Progress progress;
    int64_t done; // frames that were made
    int64_t
        before_first_picture; // … of these, those that --frames and --runtime do not count: nothing was to be seen yet
    double start;             // seconds of the monotonic clock
    StateFile state;
    const PetriRanks *ranks; // the processes that share the work; NULL: this alone
    bool abandoned;          // the frame at hand was, because of a signal
    bool shown_last;         // the last diagnostic that was no note was shown
    bool invalid_definition; // the script cannot take a value of -D
} Frames;

// Opens a session. OPTIONS_READ, or the status to exit with. Frames must be zero at first, and stay where it is.
int frames_open(Frames *frames, const CommandContext *context, Options *options);
// Loads the script; false if that failed, which has been told.
bool frames_load(Frames *frames);
// Takes the state from its file and from here on catches signals and shows progress.
void frames_begin(Frames *frames);
// Whether another frame is to be made.
bool frames_due(const Frames *frames);
// Makes one frame. False if there is no going on: after a message, for a limit that one frame has reached the next will
// reach as well, or because a signal has made it give the frame up (given_up).
bool frames_step(Frames *frames);
// Saves the state if it is time, once what belongs to the frame is written.
void frames_save_state(Frames *frames);
// Between these calls, a signal interrupts the session.
void frames_set_interruptible(Frames *frames, bool begins);
// Takes the progress line away and, if all went well, saves the state.
void frames_end(Frames *frames, bool going);
// The signal that asked for an end, or 0.
int frames_signal(void);
double frames_fps(const Frames *frames);

#endif
