// petri-live.h: for hosts that run scripts live: the clock, the pointer and keys, and snapshots to go back to.
//
// The rules of petri.h apply.
#ifndef PETRI_LIVE_H
#define PETRI_LIVE_H

#include "petri.h"

#ifdef __cplusplus
extern "C" {
#endif

// Like petri_step, but sets the time (in seconds) and the beat of the frame. Later calls of petri_step continue from
// them. Never waits. If the time is not later than that of the last frame, the systems are not advanced. Also returns
// PETRI_INVALID if `time` or `beat` is not finite.
PETRI_API PetriStatus petri_step_at(PetriSession *session, double time, double beat);

// In real time, returns the seconds until the next frame is due. A host can use them for other work instead of waiting
// in petri_step. Returns 0 if the frame is already due, before the first frame, and in lockstep.
PETRI_API double petri_seconds_until_due(const PetriSession *session);

// If the next frame is already late, discards the delay. That frame then follows the last one as if it were on time.
// Call this function in real time after a pause or a slow operation of the host. It has no effect in lockstep.
PETRI_API void petri_resync_clock(PetriSession *session);

// User input, for scripts with `!pointer` and `!key` nodes in a `!window`. Report input when it happens. The next frame
// finds the input in the state dictionary. A node takes effect in the second frame that contains it. A key or button
// that is pressed and released between two frames counts as pressed for one frame. If the host never reports input, the
// dictionary contains none.
enum {
    PETRI_BUTTON_LEFT = 1,
    PETRI_BUTTON_MIDDLE = 2,
    PETRI_BUTTON_RIGHT = 4, // further buttons: 8, 16, 32, 64, 128
};
typedef struct PetriPointer {
    size_t size;      // sizeof(PetriPointer)
    bool inside;      // true if the pointer is over the window; if false, x and y are ignored
    double x;         // 0 at the left edge to 1 at the right edge; values outside are clamped
    double y;         // 0 at the top to 1 at the bottom
    unsigned buttons; // bits of the pressed buttons
} PetriPointer;

// Reports the pointer's position and buttons. NULL means that the window lost focus: the pointer is outside, and all
// buttons and keys are released. Returns PETRI_INVALID if the position is not finite.
PETRI_API PetriStatus petri_report_pointer(PetriSession *session, const PetriPointer *pointer);

// Reports that a key was pressed or released. `name` is a letter, a digit, or a word such as "space", "left",
// "page_up", "f1" or "left_shift" (see src/manual/view.md). Returns PETRI_INVALID for unknown names.
PETRI_API PetriStatus petri_report_key(PetriSession *session, const char *name, bool pressed);

// Returns true if a `!key` node of the last frame uses the key. The host should then not use the key for anything else.
PETRI_API bool petri_key_is_bound(PetriSession *session, const char *name);

// Sets the tempo in beats per minute from now on, without a jump of frame number, time or beat. Returns PETRI_INVALID
// unless it is positive and finite.
PETRI_API PetriStatus petri_set_tempo(PetriSession *session, double tempo);

// Sets the frames per second from now on, without a jump of frame number, time or beat. Returns PETRI_INVALID unless it
// is positive and finite.
PETRI_API PetriStatus petri_set_fps(PetriSession *session, double fps);

// Sets the maximum simulation time step of all systems, overriding their `resolution` attributes. The unit is that of a
// system's time: seconds, unless the system sets `time`. 0 (the default) uses the systems' own attributes. Returns
// PETRI_INVALID if it is negative or not finite.
PETRI_API PetriStatus petri_set_resolution(PetriSession *session, double resolution);

// Returns the value set by petri_set_resolution.
PETRI_API double petri_resolution(const PetriSession *session);

// A copy of everything that determines how a session continues: state, systems, input, clock and configuration.
typedef struct PetriSnapshot PetriSnapshot;

// Returns a snapshot of the session, or NULL if out of memory. Free it with petri_snapshot_free before the session is
// closed.
PETRI_API PetriSnapshot *petri_snapshot(PetriSession *session);

// Frees a snapshot. NULL is ignored.
PETRI_API void petri_snapshot_free(PetriSnapshot *snapshot);

// Returns the size of a snapshot in bytes, without its configuration, which is shared.
PETRI_API size_t petri_snapshot_bytes(const PetriSnapshot *snapshot);

// Restores a snapshot of the same session, to the point directly after the snapshot's frame. The following frames are
// bit-identical to those computed before, if the files that the script reads are unchanged. petri_tree returns null
// until the next step. On failure, returns PETRI_OUT_OF_MEMORY and changes nothing.
PETRI_API PetriStatus petri_rewind(PetriSession *session, const PetriSnapshot *snapshot);

// A timeline of the frames that a session has computed, to go back to any of them. Some frames are kept as snapshots.
// The others are computed again from the snapshot before them, with bit-identical results.
//
// A change of the configuration (script, definitions, clock rates, prompt statements) applies to the frames after it. A
// frame is always computed again with the configuration that it had. A step from a past frame under a configuration
// that was changed there discards the frames after it. If the session follows the wall clock, a frame is computed again
// at its recorded time; a step from a past frame computes the next frame at the current time and discards the old ones.
//
// Use petri_history_step instead of petri_step, and start the timeline again after a call that replaces frame number
// and state: petri_load, petri_reset, petri_restore, petri_rewind.
typedef struct PetriHistory PetriHistory;

// Returns a history of the session that starts at the current frame, or NULL if out of memory. Its snapshots use at
// most `max_bytes` bytes (0: 64 MiB); two are kept even if they are larger. Free it with petri_history_free before the
// session is closed.
PETRI_API PetriHistory *petri_history_new(PetriSession *session, size_t max_bytes);

// Frees a history. NULL is ignored.
PETRI_API void petri_history_free(PetriHistory *history);

// Drops the timeline and starts a new one at the current frame. `reason` becomes PetriHistoryInfo.reason; it is NULL or
// lives as long as the history.
PETRI_API PetriStatus petri_history_start(PetriHistory *history, const char *reason);

// Like petri_step, but adds the frame to the timeline. If it was in the timeline before and is not the last one, the
// session then gets the configuration that the next frame had, so that steps repeat the changes.
PETRI_API PetriStatus petri_history_step(PetriHistory *history);

// Goes to the last frame before `frame` that is kept as a snapshot, or to the first frame of the timeline if `frame` is
// that frame. A few calls of petri_history_step then lead to `frame`. The session gets the configuration that the next
// frame had. Returns PETRI_INVALID if there is no such frame.
PETRI_API PetriStatus petri_history_rewind(PetriHistory *history, int64_t frame);

// Goes to a frame of the timeline, or steps forward to a frame after its end. The session keeps its current
// configuration. Returns PETRI_INVALID if the frame is before the first one. After PETRI_INTERRUPTED, the session is
// at an intermediate frame.
PETRI_API PetriStatus petri_history_goto(PetriHistory *history, int64_t frame);

// Computes the current frame, with its systems and tree, again from the snapshot before it. Does nothing for the first
// frame of the timeline. Changes nothing if it fails.
PETRI_API PetriStatus petri_history_recompute(PetriHistory *history);

// Goes to the frame at which the timeline was started, even if it was dropped since then. The session keeps its current
// configuration.
PETRI_API PetriStatus petri_history_reset(PetriHistory *history);

// Moves a particle of the current frame: sets its position, its velocity, or both, as petri_state_set does, from which
// the next frame continues. NULL keeps a vector; others have as many elements as the system has dimensions. The move
// becomes a part of the frame: it is repeated when the frame is computed again, and frames after it are discarded. It
// also changes what petri_system returns. Returns PETRI_INVALID if there is no such particle, if it is an anchor, or if
// a number is not finite.
PETRI_API PetriStatus petri_history_move_particle(PetriHistory *history, size_t system, uint32_t particle,
                                                  const double *position, const double *velocity);

// Returns true if a particle was moved in a frame of the timeline. Moves in a frame at which the timeline has started
// again do not count.
PETRI_API bool petri_history_is_moved(const PetriHistory *history, int64_t frame);

typedef struct PetriHistoryInfo {
    int64_t first; // first and last frame of the timeline; -1: before frame 0
    int64_t last;
    // Why frames before `first` are missing: a string that the host gave, or English. NULL: none are missing.
    const char *reason;
    size_t keyframes; // number of snapshots, and their size in bytes
    size_t bytes;
} PetriHistoryInfo;

// Gets facts about a history. `size` is sizeof(PetriHistoryInfo). Returns false if `history` is NULL.
PETRI_API bool petri_history_info(const PetriHistory *history, PetriHistoryInfo *info, size_t size);

// Returns the petri_config_revision with which a frame of the timeline was computed; 0 if the frame is not in the
// timeline or is its first one.
PETRI_API uint64_t petri_history_config(const PetriHistory *history, int64_t frame);

#ifdef __cplusplus
}
#endif

#endif
