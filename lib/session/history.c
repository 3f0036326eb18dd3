// history.c: snapshots of a session, and timelines of frames that it can go back to (petri-live.h).
//
// A history keeps some frames as snapshots, the keyframes, and all changes of the configuration, the epochs. A frame is
// computed again from the keyframe before it. At the start of an epoch, the session then gets the configuration and
// the base of the clock that it had there, so that the bits are the same.
//
// Particles that the host moves in a frame (moves.h) are not in its keyframe, but are moved again after each restore.
//
// If there are too many keyframes, the one is dropped that saves the fewest steps relative to its age. Recent keyframes
// are therefore closer together than old ones.
#include "base/heap.h"
#include "base/host_struct.h"
#include "session/moves.h"
#include "session/session.h"

#include <string.h>

// --- snapshots

PetriSnapshot *petri_snapshot(PetriSession *session) {
    if (!session || (session->rollback_pending && !session_rollback(session)))
        return NULL;
    PetriSnapshot *snapshot = heap_calloc(1, sizeof *snapshot);
    if (!snapshot)
        return NULL;
    snapshot->config = petri_config_get(session);
    if (!snapshot->config || !checkpoint_save(&snapshot->at, session)) {
        petri_snapshot_free(snapshot);
        return NULL;
    }
    unsigned char *exact =
        heap_resize(snapshot->at.bytes, snapshot->at.size); // frees unused capacity, because hosts keep many snapshots
    snapshot->at.bytes = exact ? exact : snapshot->at.bytes;
    return snapshot;
}

void petri_snapshot_free(PetriSnapshot *snapshot) {
    if (!snapshot)
        return;
    petri_config_free(snapshot->config);
    heap_free(snapshot->at.bytes);
    heap_free(snapshot);
}

size_t petri_snapshot_bytes(const PetriSnapshot *snapshot) {
    return snapshot ? sizeof *snapshot + snapshot->at.size : 0;
}

PetriStatus petri_rewind(PetriSession *session, const PetriSnapshot *snapshot) {
    if (!session || !snapshot)
        return PETRI_INVALID;
    PetriStatus status = checkpoint_restore(session, &snapshot->at);
    if (status != PETRI_OK)
        return PETRI_OUT_OF_MEMORY;
    petri_config_apply(session, snapshot->config);
    clock_follow_frame(&session->clock);
    recorder_jump(session);
    return PETRI_OK;
}

// --- keyframes and epochs

enum {
    MAX_KEYFRAMES = 512,
    MAX_EPOCHS = 512,
    INTERVAL = 8, // frames from one keyframe to the next
    EPOCH_CAPACITY = MAX_EPOCHS + INTERVAL + 1,
};
// Seconds of computing after which a frame becomes a keyframe, so that going back takes about as long in a slow world.
static const double MAX_SECONDS = 1;

typedef struct HistoryKeyframe {
    int64_t frame;
    PetriSnapshot *snapshot;
} HistoryKeyframe;

// A series of frames with the same configuration: from frame start + 1 to the `start` of the next epoch.
typedef struct Epoch {
    int64_t start;
    PetriConfig *config; // counted reference
    ClockBase base;      // of the clock at frame `start`
} Epoch;

typedef struct FrameTime {
    double time; // seconds
    double beat; // beats
} FrameTime;

struct PetriHistory {
    PetriSession *session;
    size_t max_bytes;
    HistoryKeyframe keyframes[MAX_KEYFRAMES + 1]; // sorted; the first one is at frame `first`
    size_t keyframe_count;
    size_t bytes; // size of all keyframes
    Epoch epochs[EPOCH_CAPACITY];
    size_t epoch_count;
    Moves moves;
    int64_t first; // first and last frame of the timeline
    int64_t last;
    double seconds;        // time of computing since the last keyframe
    PetriSnapshot *origin; // state that petri_history_reset returns to
    FrameTime *times;      // in real time: times of the frames times_start + 1, times_start + 2 and so on
    uint32_t time_count;
    uint32_t time_capacity;
    int64_t times_start;
    const char *reason;
};

static void drop_keyframe(PetriHistory *history, size_t at) {
    history->bytes -= petri_snapshot_bytes(history->keyframes[at].snapshot);
    petri_snapshot_free(history->keyframes[at].snapshot);
    history->keyframe_count--;
    memmove(history->keyframes + at, history->keyframes + at + 1,
            (history->keyframe_count - at) * sizeof *history->keyframes);
}

static void drop_epochs(PetriHistory *history, size_t from, size_t count) {
    for (size_t i = from; i < from + count; i++)
        petri_config_free(history->epochs[i].config);
    history->epoch_count -= count;
    memmove(history->epochs + from, history->epochs + from + count,
            (history->epoch_count - from) * sizeof *history->epochs);
}

static void drop_all(PetriHistory *history) {
    while (history->keyframe_count > 0)
        drop_keyframe(history, history->keyframe_count - 1);
    drop_epochs(history, 0, history->epoch_count);
    moves_free(&history->moves);
}

// Returns the cost of dropping a keyframe: the number of frames from the previous keyframe to the next one, divided by
// the age of the previous keyframe plus a constant.
static double keyframe_cost(const PetriHistory *history, size_t at) {
    const HistoryKeyframe *before = &history->keyframes[at - 1], *after = &history->keyframes[at + 1];
    return (double)(after->frame - before->frame) / (double)(history->last - before->frame + 8 * INTERVAL);
}

static void drop_cheapest(PetriHistory *history) {
    size_t best = 1;
    for (size_t i = 2; i + 1 < history->keyframe_count; i++)
        if (keyframe_cost(history, i) < keyframe_cost(history, best))
            best = i;
    drop_keyframe(history, best);
}

// Takes over the snapshot of the current frame.
static void add_keyframe(PetriHistory *history, PetriSnapshot *snapshot) {
    history->keyframes[history->keyframe_count++] = (HistoryKeyframe){history->session->clock.number, snapshot};
    history->bytes += petri_snapshot_bytes(snapshot);
    history->seconds = 0;
    while (history->keyframe_count > 2 &&
           (history->keyframe_count > MAX_KEYFRAMES || history->bytes > history->max_bytes))
        drop_cheapest(history);
}

// Drops the oldest keyframe, so that the timeline starts at the next one.
static void drop_oldest(PetriHistory *history) {
    size_t passed = 0;
    drop_keyframe(history, 0);
    history->first = history->keyframes[0].frame;
    while (passed + 1 < history->epoch_count && history->epochs[passed + 1].start <= history->first)
        passed++;
    drop_epochs(history, 0, passed);
    history->reason = "earlier frames were dropped to save memory";
}

// Returns the epoch of a frame, which must be after the first frame of the timeline.
static const Epoch *epoch_of(const PetriHistory *history, int64_t frame) {
    size_t at = history->epoch_count - 1;
    while (at > 0 && history->epochs[at].start >= frame)
        at--;
    return &history->epochs[at];
}

static bool has_config(const PetriHistory *history, const Epoch *epoch) {
    return history->session->config_revision == epoch->config->revision;
}

// Starts an epoch at the current frame. Returns false if out of memory, also if no snapshot could be taken for so long
// that no keyframe is left to drop.
static bool begin_epoch(PetriHistory *history) {
    PetriSession *session = history->session;
    PetriConfig *config = history->epoch_count < EPOCH_CAPACITY ? petri_config_get(session) : NULL;
    if (!config)
        return false;
    history->epochs[history->epoch_count++] = (Epoch){session->clock.number, config, session->clock.base};
    while (history->epoch_count > MAX_EPOCHS && history->keyframe_count > 1)
        drop_oldest(history);
    return true;
}

// Starts the timeline at the current frame.
static bool begin_timeline(PetriHistory *history) {
    PetriSnapshot *snapshot = petri_snapshot(history->session);
    drop_all(history);
    if (!snapshot || !begin_epoch(history)) {
        petri_snapshot_free(snapshot);
        return false;
    }
    add_keyframe(history, snapshot);
    history->first = history->last = history->session->clock.number;
    return true;
}

// --- the timeline

PetriHistory *petri_history_new(PetriSession *session, size_t max_bytes) {
    PetriHistory *history = session ? heap_calloc(1, sizeof *history) : NULL;
    if (!history)
        return NULL;
    history->session = session;
    history->max_bytes = max_bytes ? max_bytes : (size_t)64 << 20;
    petri_history_start(history, NULL); // if memory runs out, the next call tries again
    return history;
}

void petri_history_free(PetriHistory *history) {
    if (!history)
        return;
    drop_all(history);
    petri_snapshot_free(history->origin);
    heap_free(history->times);
    heap_free(history);
}

PetriStatus petri_history_start(PetriHistory *history, const char *reason) {
    if (!history)
        return PETRI_INVALID;
    petri_snapshot_free(history->origin);
    history->origin = petri_snapshot(history->session);
    history->times_start = history->session->clock.number;
    history->time_count = 0;
    history->reason = reason;
    return begin_timeline(history) && history->origin ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}

// Starts the timeline, or repeats moves, if an earlier attempt ran out of memory. The session cannot have advanced
// since then.
static PetriStatus ensure_started(PetriHistory *history) {
    if (!history)
        return PETRI_INVALID;
    if (history->moves.torn)
        return moves_repeat(&history->moves, history->session);
    return history->keyframe_count > 0 && history->origin ? PETRI_OK : petri_history_start(history, history->reason);
}

// Removes all frames after `frame` from the timeline.
static void drop_frames_after(PetriHistory *history, int64_t frame) {
    while (history->keyframe_count > 1 && history->keyframes[history->keyframe_count - 1].frame > frame)
        drop_keyframe(history, history->keyframe_count - 1);
    while (history->epoch_count > 1 && history->epochs[history->epoch_count - 1].start >= frame)
        drop_epochs(history, history->epoch_count - 1, 1);
    moves_drop_after(&history->moves, frame);
    history->last = frame;
}

// Gives the session the configuration with which the next frame was computed or will be computed.
static void follow_epoch(PetriHistory *history) {
    PetriSession *session = history->session;
    const Epoch *epoch = epoch_of(history, session->clock.number + 1);
    petri_config_apply(session, epoch->config);
    if (session->clock.number == epoch->start)
        session->clock.base = epoch->base;
}

// Prepares the next frame: starts an epoch if it was computed, or would be, with another configuration. Returns false
// if out of memory.
static bool choose_epoch(PetriHistory *history) {
    int64_t frame = history->session->clock.number;
    if (has_config(history, epoch_of(history, frame + 1))) {
        follow_epoch(history);
        return true;
    }
    if (frame <= history->first)
        return begin_timeline(history);
    drop_frames_after(history, frame);
    return begin_epoch(history);
}

static void record_time(PetriHistory *history) {
    const Clock *clock = &history->session->clock;
    int64_t at = clock->number - history->times_start - 1;
    if (!clock->realtime || at < 0 || at > history->time_count ||
        !heap_reserve((void **)&history->times, &history->time_capacity, history->time_count, sizeof(FrameTime)))
        return;
    history->times[at] = (FrameTime){clock->time, clock->beat};
    history->time_count = (uint32_t)at + 1;
}

// Completes the current frame, which was computed or restored with `status`: moves particles again.
static PetriStatus end_recomputed_frame(PetriHistory *history, PetriStatus status) {
    PetriStatus moved = moves_repeat(&history->moves, history->session);
    return status == PETRI_OK ? moved : status;
}

static PetriStatus rewind_to(PetriHistory *history, const PetriSnapshot *snapshot) {
    PetriStatus status = petri_rewind(history->session, snapshot);
    return status == PETRI_OK ? end_recomputed_frame(history, status) : status;
}

static PetriStatus replay_step(PetriHistory *history) {
    PetriSession *session = history->session;
    int64_t before = session->clock.number;
    int64_t at = session->clock.number - history->times_start;
    bool known = session->clock.realtime && at >= 0 && at < history->time_count;
    follow_epoch(history);
    PetriStatus status =
        known ? petri_step_at(session, history->times[at].time, history->times[at].beat) : petri_step(session);
    return session->clock.number == before ? status : end_recomputed_frame(history, status);
}

// Adds the current frame to the timeline.
static PetriStatus record_history_frame(PetriHistory *history) {
    const SessionFrame *computed = &history->session->frame;
    int64_t frame = history->session->clock.number;
    record_time(history);
    history->seconds += computed->evaluation_seconds + computed->physics_seconds;
    if (frame < history->last)
        follow_epoch(history);
    if (frame <= history->last)
        return PETRI_OK;
    history->last = frame;
    if (frame - history->keyframes[history->keyframe_count - 1].frame < INTERVAL && history->seconds < MAX_SECONDS)
        return PETRI_OK;
    PetriSnapshot *snapshot = petri_snapshot(history->session);
    if (snapshot)
        add_keyframe(history, snapshot);
    return snapshot ? PETRI_OK : PETRI_OUT_OF_MEMORY;
}

PetriStatus petri_history_step(PetriHistory *history) {
    PetriStatus status = ensure_started(history);
    if (status != PETRI_OK)
        return status;
    PetriSession *session = history->session;
    int64_t before = session->clock.number;
    if (session->clock.realtime && before < history->last)
        drop_frames_after(history, before);
    if (!choose_epoch(history))
        return PETRI_OUT_OF_MEMORY;
    uint64_t config = session->config_revision;
    status = petri_step(session);
    if (status == PETRI_INTERRUPTED || session->clock.number == before)
        return status;
    PetriStatus recorded = session->config_revision == config
                               ? record_history_frame(history)
                               : petri_history_start(history, "an imported file has changed");
    return end_recomputed_frame(history, status == PETRI_OK ? recorded : status);
}

// Returns the last keyframe that is before `frame`, or NULL. If `frame` is the first of the timeline, returns it.
static const HistoryKeyframe *keyframe_before(const PetriHistory *history, int64_t frame) {
    if (frame == history->first)
        return history->keyframes;
    const HistoryKeyframe *found = NULL;
    for (size_t i = 0; i < history->keyframe_count && history->keyframes[i].frame < frame; i++)
        found = &history->keyframes[i];
    return found;
}

PetriStatus petri_history_rewind(PetriHistory *history, int64_t frame) {
    PetriStatus status = ensure_started(history);
    const HistoryKeyframe *from = status == PETRI_OK ? keyframe_before(history, frame) : NULL;
    if (status == PETRI_OK)
        status = from ? rewind_to(history, from->snapshot) : PETRI_INVALID;
    if (status == PETRI_OK)
        follow_epoch(history);
    return status;
}

// Computes frames again up to `frame`, which must be in the timeline. Starts at the current frame if it is between the
// keyframe before `frame` and `frame`, and the session still has its configuration. Otherwise starts at the keyframe.
static PetriStatus replay_frames(PetriHistory *history, int64_t frame) {
    PetriSession *session = history->session;
    int64_t now = session->clock.number;
    const HistoryKeyframe *from = keyframe_before(history, frame);
    if (!from)
        return PETRI_INVALID;
    PetriStatus status = PETRI_OK;
    if (now >= frame || now < from->frame || now <= history->first || !has_config(history, epoch_of(history, now)))
        status = rewind_to(history, from->snapshot);
    while (status == PETRI_OK && session->clock.number < frame)
        status = replay_step(history);
    return status;
}

// Starts the timeline if necessary, and stores the configuration of the session for end_move.
static PetriStatus begin_move(PetriHistory *history, PetriConfig **config) {
    PetriStatus status = ensure_started(history);
    *config = status == PETRI_OK ? petri_config_get(history->session) : NULL;
    return *config || status != PETRI_OK ? status : PETRI_OUT_OF_MEMORY;
}

static void end_move(PetriHistory *history, PetriConfig *config) {
    petri_config_apply(history->session, config);
    petri_config_free(config);
}

PetriStatus petri_history_goto(PetriHistory *history, int64_t frame) {
    PetriConfig *config;
    PetriStatus status = begin_move(history, &config);
    if (status != PETRI_OK)
        return status;
    const Clock *clock = &history->session->clock;
    int64_t target = frame < history->last ? frame : history->last;
    if (clock->number != target)
        status = replay_frames(history, target);
    end_move(history, config);
    while (status == PETRI_OK && clock->number < frame)
        status = petri_history_step(history);
    return status;
}

PetriStatus petri_history_recompute(PetriHistory *history) {
    PetriConfig *config;
    PetriStatus status = begin_move(history, &config);
    if (status != PETRI_OK)
        return status;
    int64_t frame = history->session->clock.number;
    if (frame > history->first && frame <= history->last) {
        PetriSnapshot *present = petri_snapshot(history->session);
        status = present ? replay_frames(history, frame) : PETRI_OUT_OF_MEMORY;
        if (status != PETRI_OK)
            petri_rewind(history->session, present);
        petri_snapshot_free(present);
    }
    end_move(history, config);
    return status;
}

PetriStatus petri_history_reset(PetriHistory *history) {
    PetriConfig *config;
    PetriStatus status = begin_move(history, &config);
    if (status != PETRI_OK)
        return status;
    bool outside = history->origin->at.clock.number < history->first;
    status =
        outside ? petri_rewind(history->session, history->origin) : rewind_to(history, history->keyframes[0].snapshot);
    end_move(history, config);
    return outside && status == PETRI_OK ? petri_history_start(history, NULL) : status;
}

PetriStatus petri_history_move_particle(PetriHistory *history, size_t system, uint32_t particle, const double *position,
                                        const double *velocity) {
    PetriStatus status = ensure_started(history);
    if (status == PETRI_OK)
        status =
            moves_add(&history->moves, history->session, system, particle, (const double *const[]){position, velocity});
    if (status == PETRI_OK)
        drop_frames_after(history, history->session->clock.number);
    return status;
}

bool petri_history_info(const PetriHistory *history, PetriHistoryInfo *info, size_t size) {
    if (!history)
        return false;
    const PetriHistoryInfo found = {.first = history->first,
                                    .last = history->last,
                                    .reason = history->reason,
                                    .keyframes = history->keyframe_count,
                                    .bytes = history->bytes};
    return host_struct_write(info, size, &found, sizeof found);
}

bool petri_history_is_moved(const PetriHistory *history, int64_t frame) {
    return history && moves_exist(&history->moves, frame);
}

uint64_t petri_history_config(const PetriHistory *history, int64_t frame) {
    return history && history->epoch_count > 0 && frame > history->first && frame <= history->last
               ? epoch_of(history, frame)->config->revision
               : 0;
}
