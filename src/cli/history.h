// history.h: the frames that were made, so that one can go back to them.
//
// A timeline of frames from `first` to `last`. Some of them, the keyframes, are kept whole; a frame between two of them
// is made again from the one before it, which gives the same bits. Keyframes are kept denser for the recent past,
// within HISTORY_BYTES and HISTORY_MAX of them: when there are too many, the one goes whose absence lengthens the way
// to its neighbours least, measured by how long ago that is.
//
// What is changed by hand (script, definitions, clock rates, statements of the prompt) begins a new epoch with a
// keyframe of its own: a frame is made again with what was in force when it was made. To step on from a frame in the
// past under a changed configuration gives the timeline another future: what was after that frame is forgotten then.
// A session that follows the wall clock makes a frame again at the time that it had. What is then made after it is made
// at other times, so that the timeline has another future there, too.
#ifndef PETRI_SRC_CLI_HISTORY_H
#define PETRI_SRC_CLI_HISTORY_H

#include "cli/byte_buffer.h"
#include "petri.h"

// 64 MiB, or two keyframes where they are larger than that.
enum { HISTORY_MAX = 512, HISTORY_INTERVAL = 8 };
#define HISTORY_BYTES ((size_t)64 << 20)

typedef struct Keyframe {
    int64_t frame;
    uint32_t epoch;
    PetriSnapshot *snapshot;
} Keyframe;

// Frames after `start` up to the next epoch's start.
typedef struct Epoch {
    uint32_t number;
    int64_t start;
    uint64_t config;
} Epoch;

// When a frame was, in seconds and beats.
typedef struct FrameTime {
    double time;
    double beat;
} FrameTime;

typedef struct FrameHistory {
    Keyframe keyframes[HISTORY_MAX + 1];
    size_t keyframe_count;
    Epoch *epochs;
    size_t epoch_count;
    uint32_t last_epoch; // number given last
    size_t bytes;        // of all keyframes
    int64_t first;
    int64_t last;
    PetriSnapshot *origin; // where `.reset` goes
    bool live;             // the session follows the wall clock; set before history_start
    FrameTime *times;      // … of the frames after `times_start`, as far as they are known
    size_t time_count;
    size_t time_capacity;
    int64_t times_start;
    const char *why; // why the timeline begins where it does, or NULL if nothing was before it
} FrameHistory;

// The timeline begins with the present frame; `why` (a literal) says what became of the one before. False if memory is
// used up: what needs the timeline then tries again.
bool history_start(FrameHistory *history, PetriSession *session, const char *why);
void history_free(FrameHistory *history);
// petri_step, with the history kept.
PetriStatus history_step(FrameHistory *history, PetriSession *session);
// Goes to a frame of the timeline, or beyond it by stepping. PETRI_INVALID with a reason in `why` if it cannot be made
// again. PETRI_INTERRUPTED in some frame on the way. The configuration stays.
PetriStatus history_goto(FrameHistory *history, PetriSession *session, int64_t frame, ByteBuffer *why);
// Makes the present frame again, with its systems and its tree, from the keyframe before it. The first one of the
// timeline stays as it is, and so does any that cannot be made again. PETRI_INTERRUPTED and PETRI_OUT_OF_MEMORY change
// nothing.
PetriStatus history_recompute(FrameHistory *history, PetriSession *session);
// Goes to where the timeline began, even if that was dropped since. The configuration stays.
PetriStatus history_reset(FrameHistory *history, PetriSession *session);

#endif
