// snapshot.c: snapshots of a session (petri_snapshot, petri_rewind).
#include "base/heap.h"
#include "session/session.h"

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
