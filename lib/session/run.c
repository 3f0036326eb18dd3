// run.c: protected calls after a rollback that is still pending, and reports of aborted calls.
#include "session/session.h"

#include <inttypes.h>
#include <stdio.h>

bool session_rollback(PetriSession *session) {
    bool outer = session->uninterruptible;
    session->rollback_pending = false; // an aborted rollback sets it again
    session->uninterruptible = true;
    session->rollback_pending = checkpoint_restore(session, &session->undo) != PETRI_OK;
    session->uninterruptible = outer;
    return !session->rollback_pending;
}

PetriStatus session_protect(PetriSession *session, Arena *extra, SessionCall *call, void *context) {
    if (session->rollback_pending && !session_rollback(session))
        return PETRI_OUT_OF_MEMORY;
    return session_attempt(session, extra, call, context);
}

PetriStatus session_run(PetriSession *session, SessionCall *call, void *context, const char *what) {
    return session_report_abort(session, session_protect(session, NULL, call, context), what);
}

bool session_query(PetriSession *session, SessionCall *call, void *context) {
    bool outer = session->uninterruptible;
    session->uninterruptible = true;
    PetriStatus status = session_run(session, call, context, "the query");
    session->uninterruptible = outer;
    return status == PETRI_OK;
}

PetriStatus session_report_abort(PetriSession *session, PetriStatus status, const char *what) {
    if (status == PETRI_INTERRUPTED)
        petri_clear_interrupt(session);
    if (status != PETRI_OUT_OF_MEMORY && status != PETRI_LIMIT_EXCEEDED)
        return status;
    bool work = status == PETRI_LIMIT_EXCEEDED && session->last_outcome == ARENA_WORK_LIMIT;
    char text[120];
    if (status == PETRI_OUT_OF_MEMORY)
        snprintf(text, sizeof text, "out of memory: %s was aborted", what);
    else if (work)
        snprintf(text, sizeof text, "%s exceeded its limit of %" PRIu64 " work units and was aborted", what,
                 session->options.work_limit);
    else
        snprintf(text, sizeof text, "%s exceeded its memory limit of %zu MiB and was aborted", what,
                 session->options.memory_limit >> 20);
    Diag diag = {.level = DIAG_ERROR, .text = str_from(text), .code = work ? "work-limit" : "memory-limit"};
    if (status == PETRI_LIMIT_EXCEEDED)
        diag.at = session->vm.at                 ? *session->vm.at
                  : session->schema.current_node ? node_origin(session->schema.current_node, NULL)
                                                 : (Origin){0};
    size_t limit = session->budget.memory_limit;
    session->budget.memory_limit = SIZE_MAX; // the report itself needs memory
    session_report(session, &diag);
    session->budget.memory_limit = limit;
    return status;
}
