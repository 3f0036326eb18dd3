// history.h: a timeline of computed frames that a session can go back to.
//
// The timeline covers the frames `first` to `last`. Some of them, the keyframes, are stored as snapshots. Other frames
// are recomputed from the keyframe before them, with bit-identical results. HISTORY_BYTES and HISTORY_MAX limit the
// keyframes. If a limit is exceeded, a keyframe is dropped: the one that saves the fewest steps of recomputation
// relative to its age. Recent keyframes are therefore closer together than old ones.
//
// A change of the configuration (script, definitions, clock rates, prompt statements) starts a new epoch with its own
// keyframe. A frame is always recomputed with the configuration of its epoch. Stepping from a past frame under a
// changed configuration discards the frames after that past frame.
// If the session follows the wall clock, a frame is recomputed at its recorded time. In this case, a step from a past
// frame computes the next frame at the current time, and discards the old frames after the past frame.
#pragma once

#include "cli/memory.h"
#include "petri-live.h"

// HISTORY_MAX: maximum number of keyframes. HISTORY_INTERVAL: number of frames from one stored keyframe to the next.
// HISTORY_BYTES: maximum size of all keyframes together. Two keyframes are kept even if together they are larger.
enum { HISTORY_MAX = 512, HISTORY_INTERVAL = 8 };
#define HISTORY_BYTES ((size_t)64 << 20)

typedef struct Keyframe {
    int64_t frame;
    uint32_t epoch; // Epoch.number
    PetriSnapshot *snapshot;
} Keyframe;

// A series of frames with the same configuration: from frame start + 1 to the `start` of the next epoch.
typedef struct Epoch {
    uint32_t number; // unique in the history
    int64_t start;
    uint64_t config; // petri_config_revision of these frames
} Epoch;

// Time of a frame.
typedef struct FrameTime {
    double time; // seconds
    double beat; // beats
} FrameTime;

typedef struct FrameHistory {
    Keyframe keyframes[HISTORY_MAX + 1];
    size_t keyframe_count;
    Epoch *epochs;
    size_t epoch_count;
    uint32_t last_epoch; // number of the newest epoch
    size_t bytes;        // size of all keyframes
    int64_t first;       // first and last frame of the timeline
    int64_t last;
    PetriSnapshot *origin; // state that history_reset returns to
    bool live;             // true if the session follows the wall clock; set before history_start
    FrameTime *times;      // if `live`: times of the frames times_start + 1, times_start + 2 and so on
    size_t time_count;
    size_t time_capacity;
    int64_t times_start;
    const char *why; // reason why frames before `first` are missing, a string literal; NULL: none are missing
} FrameHistory;

// Starts a new timeline at the current frame and drops the old one. `why` becomes history->why. Returns false if out of
// memory. history_step, history_goto and history_reset then try again to start the timeline.
bool history_start(FrameHistory *history, PetriSession *session, const char *why);
void history_free(FrameHistory *history);
// Like petri_step, but records the frame.
PetriStatus history_step(FrameHistory *history, PetriSession *session);
// Goes to a frame of the timeline, or steps forward to a frame after its end. Keeps the current configuration. Returns
// PETRI_INVALID and adds a reason to `why` if the frame cannot be recomputed. After PETRI_INTERRUPTED, the session is
// at an intermediate frame.
PetriStatus history_goto(FrameHistory *history, PetriSession *session, int64_t frame, Text *why);
// Recomputes the current frame, with its systems and tree, from the previous keyframe. Does nothing for the first
// frame of the timeline and for frames that cannot be recomputed. Changes nothing if it returns
// PETRI_INTERRUPTED or PETRI_OUT_OF_MEMORY.
PetriStatus history_recompute(FrameHistory *history, PetriSession *session);
// Goes to the frame at which history_start was called, even if its keyframe was dropped. Keeps the current
// configuration.
PetriStatus history_reset(FrameHistory *history, PetriSession *session);
