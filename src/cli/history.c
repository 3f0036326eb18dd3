// history.c: see history.h.
#include "cli/history.h"

#include "petri-edit.h"
#include "petri-live.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static void drop_keyframe(FrameHistory *history, size_t at) {
    history->bytes -= petri_snapshot_bytes(history->keyframes[at].snapshot);
    petri_snapshot_free(history->keyframes[at].snapshot);
    history->keyframe_count--;
    memmove(history->keyframes + at, history->keyframes + at + 1,
            (history->keyframe_count - at) * sizeof *history->keyframes);
}

static void drop_all(FrameHistory *history) {
    while (history->keyframe_count > 0)
        drop_keyframe(history, history->keyframe_count - 1);
    history->epoch_count = 0;
}

void history_free(FrameHistory *history) {
    drop_all(history);
    petri_snapshot_free(history->origin);
    free(history->epochs);
    free(history->times);
    *history = (FrameHistory){0};
}

// Returns true for the first keyframe of an epoch. Without it, frames of the epoch could not be recomputed.
static bool is_pinned(const FrameHistory *history, size_t at) {
    return at == 0 || history->keyframes[at - 1].epoch != history->keyframes[at].epoch;
}

// Returns the cost of dropping a keyframe: the number of frames from the previous keyframe to the next one, divided by
// the age of the previous keyframe plus a constant.
static double keyframe_cost(const FrameHistory *history, size_t at) {
    const Keyframe *before = &history->keyframes[at - 1], *after = &history->keyframes[at + 1];
    return (double)(after->frame - before->frame) / (double)(history->last - before->frame + 8 * HISTORY_INTERVAL);
}

// Drops the oldest keyframe. The timeline then starts at the next one.
static void drop_oldest(FrameHistory *history) {
    drop_keyframe(history, 0);
    while (history->epoch_count > 1 && history->epochs[0].number != history->keyframes[0].epoch) {
        history->epoch_count--;
        memmove(history->epochs, history->epochs + 1, history->epoch_count * sizeof *history->epochs);
    }
    history->first = history->epochs[0].start = history->keyframes[0].frame;
    history->why = "earlier frames were dropped to save memory";
}

static void drop_one(FrameHistory *history) {
    size_t best = 0;
    for (size_t i = 1; i + 1 < history->keyframe_count; i++)
        if (!is_pinned(history, i) && (best == 0 || keyframe_cost(history, i) < keyframe_cost(history, best)))
            best = i;
    if (best > 0)
        drop_keyframe(history, best);
    else
        drop_oldest(history);
}

static void push_keyframe(FrameHistory *history, PetriSession *session, PetriSnapshot *snapshot) {
    history->keyframes[history->keyframe_count++] =
        (Keyframe){petri_frame_number(session), history->epochs[history->epoch_count - 1].number, snapshot};
    history->bytes += petri_snapshot_bytes(snapshot);
    while (history->keyframe_count > HISTORY_MAX || (history->bytes > HISTORY_BYTES && history->keyframe_count > 2))
        drop_one(history);
}

static bool add_keyframe(FrameHistory *history, PetriSession *session) {
    PetriSnapshot *snapshot = petri_snapshot(session);
    if (!snapshot)
        return false;
    push_keyframe(history, session, snapshot);
    return true;
}

// Starts an epoch with a keyframe at the current frame. If `restart` is true, drops all earlier keyframes and epochs.
// If out of memory, returns false and does not start an epoch. Every epoch therefore has a keyframe at its start.
static bool begin_epoch(FrameHistory *history, PetriSession *session, bool restart) {
    PetriSnapshot *snapshot = petri_snapshot(session);
    if (!snapshot)
        return false;
    if (restart)
        drop_all(history);
    history->epochs = memory_realloc(history->epochs, (history->epoch_count + 1) * sizeof *history->epochs);
    history->epochs[history->epoch_count++] =
        (Epoch){++history->last_epoch, petri_frame_number(session), petri_config_revision(session)};
    push_keyframe(history, session, snapshot);
    return true;
}

bool history_start(FrameHistory *history, PetriSession *session, const char *why) {
    drop_all(history);
    petri_snapshot_free(history->origin);
    history->origin = petri_snapshot(session);
    history->first = history->last = history->times_start = petri_frame_number(session);
    history->time_count = 0;
    history->why = why;
    return history->origin && begin_epoch(history, session, true);
}

// Starts the timeline if an earlier attempt ran out of memory. The session cannot have advanced since then.
static bool ensure_started(FrameHistory *history, PetriSession *session) {
    return history->keyframe_count > 0 || history_start(history, session, history->why);
}

// Returns the epoch of a frame, which must be after the first frame of the timeline.
static const Epoch *epoch_of(const FrameHistory *history, int64_t frame) {
    size_t at = history->epoch_count - 1;
    while (at > 0 && history->epochs[at].start >= frame)
        at--;
    return &history->epochs[at];
}

// Removes all frames after `frame` from the timeline.
static void drop_frames_after(FrameHistory *history, int64_t frame) {
    while (history->keyframe_count > 1 && history->keyframes[history->keyframe_count - 1].frame > frame)
        drop_keyframe(history, history->keyframe_count - 1);
    while (history->epoch_count > 1 && history->epochs[history->epoch_count - 1].start >= frame) {
        uint32_t number = history->epochs[--history->epoch_count].number;
        while (history->keyframe_count > 1 && history->keyframes[history->keyframe_count - 1].epoch == number)
            drop_keyframe(history, history->keyframe_count - 1);
    }
    history->last = frame;
}

static bool begin_epoch_if_changed(FrameHistory *history, PetriSession *session, int64_t frame) {
    if (epoch_of(history, frame + 1)->config == petri_config_revision(session))
        return true;
    drop_frames_after(history, frame);
    // At the first frame of the timeline, no frame of the old configuration is left, so everything is dropped.
    return begin_epoch(history, session, frame <= history->first);
}

static void record_time(FrameHistory *history, const PetriFrame *frame) {
    size_t at = (size_t)(frame->number - history->times_start - 1);
    if (!history->live || frame->number <= history->times_start || at > history->time_count)
        return;
    if (at == history->time_capacity) {
        history->time_capacity = history->time_capacity == 0 ? 1024 : 2 * history->time_capacity;
        history->times = memory_realloc(history->times, history->time_capacity * sizeof *history->times);
    }
    history->times[at] = (FrameTime){frame->time, frame->beat};
    history->time_count = at + 1;
}

static PetriStatus replay_step(const FrameHistory *history, PetriSession *session) {
    int64_t at = petri_frame_number(session) - history->times_start;
    bool known = history->live && at >= 0 && (uint64_t)at < history->time_count;
    return known ? petri_step_at(session, history->times[at].time, history->times[at].beat) : petri_step(session);
}

PetriStatus history_step(FrameHistory *history, PetriSession *session) {
    int64_t before = petri_frame_number(session);
    if (!ensure_started(history, session))
        return PETRI_OUT_OF_MEMORY;
    if (history->live && before < history->last)
        drop_frames_after(history, before);
    if (!begin_epoch_if_changed(history, session, before))
        return PETRI_OUT_OF_MEMORY;
    uint64_t config = petri_config_revision(session);
    PetriStatus status = petri_step(session);
    int64_t frame = petri_frame_number(session);
    if (status == PETRI_INTERRUPTED || frame == before)
        return status;
    if (petri_config_revision(session) != config) {
        PetriStatus started =
            history_start(history, session, "an imported file has changed") ? PETRI_OK : PETRI_OUT_OF_MEMORY;
        return status == PETRI_OK ? started : status;
    }
    PetriFrame made;
    petri_frame(session, &made, sizeof made);
    record_time(history, &made);
    if (frame > history->last) {
        history->last = frame;
        bool due = frame - history->keyframes[history->keyframe_count - 1].frame >= HISTORY_INTERVAL;
        if (due && !add_keyframe(history, session))
            return PETRI_OUT_OF_MEMORY;
    }
    return status;
}

// Returns the last keyframe that is before `frame` and in the same epoch as `frame`, or NULL. `frame` must be after the
// first frame of the timeline.
static const Keyframe *keyframe_before(const FrameHistory *history, int64_t frame) {
    uint32_t epoch = epoch_of(history, frame)->number;
    for (size_t i = history->keyframe_count; i > 0; i--) {
        const Keyframe *keyframe = &history->keyframes[i - 1];
        if (keyframe->epoch == epoch && keyframe->frame < frame)
            return keyframe;
    }
    return NULL;
}

// Recomputes frames up to `frame`, which must be in the timeline. Starts at the current frame if it is between the
// keyframe `from` and `frame` and the session has the configuration `config`. Otherwise starts at the keyframe.
static PetriStatus replay_frames(const FrameHistory *history, PetriSession *session, const Keyframe *from,
                                 uint64_t config, int64_t frame) {
    int64_t now = petri_frame_number(session);
    PetriStatus status = PETRI_OK;
    if (now >= frame || now < from->frame || petri_config_revision(session) != config)
        status = petri_rewind(session, from->snapshot);
    while (status == PETRI_OK && petri_frame_number(session) < frame)
        status = replay_step(history, session);
    return status;
}

static PetriStatus seek_back(FrameHistory *history, PetriSession *session, int64_t frame, Text *why) {
    if (frame == history->first)
        return petri_rewind(session, history->keyframes[0].snapshot);
    const Keyframe *from = frame < history->first ? NULL : keyframe_before(history, frame);
    if (!from) {
        text_add_format(why, "cannot go to frame %" PRId64 ": the history starts at frame %" PRId64 "%s%s", frame,
                        history->first, !history->why ? "" : ": ", !history->why ? "" : history->why);
        return PETRI_INVALID;
    }
    return replay_frames(history, session, from, epoch_of(history, frame)->config, frame);
}

PetriStatus history_goto(FrameHistory *history, PetriSession *session, int64_t frame, Text *why) {
    PetriConfig *config = ensure_started(history, session) ? petri_config_get(session) : NULL;
    if (!config)
        return PETRI_OUT_OF_MEMORY;
    PetriStatus status = PETRI_OK;
    int64_t target = frame < history->last ? frame : history->last;
    if (petri_frame_number(session) != target)
        status = seek_back(history, session, target, why);
    petri_config_apply(session, config);
    petri_config_free(config);
    while (status == PETRI_OK && petri_frame_number(session) < frame)
        status = history_step(history, session);
    return status;
}

static PetriStatus recompute_frame(const FrameHistory *history, const Keyframe *from, PetriSession *session,
                                   uint64_t config, int64_t frame) {
    PetriSnapshot *present = petri_snapshot(session);
    if (!present)
        return PETRI_OUT_OF_MEMORY;
    PetriStatus status = replay_frames(history, session, from, config, frame);
    if (status != PETRI_OK)
        petri_rewind(session, present);
    petri_snapshot_free(present);
    return status;
}

PetriStatus history_recompute(FrameHistory *history, PetriSession *session) {
    int64_t frame = petri_frame_number(session);
    const Keyframe *from = frame <= history->first || frame > history->last ? NULL : keyframe_before(history, frame);
    PetriConfig *config = petri_config_get(session);
    PetriStatus status = !config ? PETRI_OUT_OF_MEMORY : PETRI_OK;
    if (status == PETRI_OK && from) {
        status = recompute_frame(history, from, session, epoch_of(history, frame)->config, frame);
        petri_config_apply(session, config);
    }
    petri_config_free(config);
    return status;
}

PetriStatus history_reset(FrameHistory *history, PetriSession *session) {
    PetriConfig *config = ensure_started(history, session) ? petri_config_get(session) : NULL;
    if (!config)
        return PETRI_OUT_OF_MEMORY;
    PetriStatus status = petri_rewind(session, history->origin);
    petri_config_apply(session, config);
    petri_config_free(config);
    return status;
}
