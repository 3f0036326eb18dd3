// protect.c: protected calls (session_protect), the report of aborted calls, and rollback.
#include "session/session.h"

#include <inttypes.h>
#include <stdio.h>

typedef struct Call {
    PetriSession *session;
    SessionCall *call;
    void *context;
    PetriStatus status;
} Call;

static void run_call(void *context) {
    Call *call = context;
    call->status = call->call(call->session, call->context);
}

PetriStatus session_protect(PetriSession *session, Arena *extra, SessionCall *call, void *context) {
    static const PetriStatus statuses[] = {[ARENA_OUT_OF_MEMORY] = PETRI_OUT_OF_MEMORY,
                                           [ARENA_MEMORY_LIMIT] = PETRI_LIMIT_EXCEEDED,
                                           [ARENA_WORK_LIMIT] = PETRI_LIMIT_EXCEEDED,
                                           [ARENA_INTERRUPTED] = PETRI_INTERRUPTED};
    SessionFrame *frame = &session->frame;
    Arena *arenas[] = {&session->arena, &session->text_arena,  &session->view_arena,   &session->key_arena,
                       &frame->arena,   &frame->systems_arena, &session->prompt.arena, extra};
    Unit *compiling = session->loader.compiling;
    bool working = frame->evaluating;
    uint64_t before = 0;
    Call made = {session, call, context, PETRI_OK};
    if (session->rollback_pending && !session_rollback(session))
        return PETRI_OUT_OF_MEMORY;
    if (session->call_depth++ == 0) {
        budget_begin(&session->budget, session->options.work_limit,
                     session->uninterruptible ? NULL : session->interrupt_source);
        session->budget.work = before = session->spent;
        session->spent = 0;
        session->vm.at = NULL;
        session->schema.current_node = NULL;
    }
    ArenaOutcome end = arena_protect(arenas, sizeof arenas / sizeof *arenas, run_call, &made);
    if (--session->call_depth == 0)
        session->total_work += session->budget.work - before;
    if (end == ARENA_OK)
        return made.status;
    session->last_outcome = end;
    session->loader.compiling = compiling;
    frame->evaluating = working;
    session->vm.arena = session->vm.builtins.arena = &frame->arena;
    return statuses[end];
}

PetriStatus session_run(PetriSession *session, SessionCall *call, void *context, const char *what) {
    return session_report_abort(session, session_protect(session, NULL, call, context), what);
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

bool session_rollback(PetriSession *session) {
    session->rollback_pending = false; // so that the protected call of checkpoint_restore does not roll back again
    session->uninterruptible = true;
    session->rollback_pending = checkpoint_restore(session, &session->undo) != PETRI_OK;
    session->uninterruptible = false;
    return !session->rollback_pending;
}
