// protect.c: protected calls (session_attempt) and interrupts.
#include "session/session.h"

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

PetriStatus session_attempt(PetriSession *session, Arena *extra, SessionCall *call, void *context) {
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
    Call protected_call = {session, call, context, PETRI_OK};
    if (session->call_depth++ == 0) {
        budget_begin(&session->budget, session->options.work_limit,
                     session->uninterruptible ? NULL : session->interrupt_source);
        session->budget.work = before = session->spent;
        session->spent = 0;
        session->vm.at = NULL;
        session->schema.current_node = NULL;
    }
    ArenaOutcome end = arena_protect(arenas, sizeof arenas / sizeof *arenas, run_call, &protected_call);
    if (--session->call_depth == 0)
        session->total_work += session->budget.work - before;
    if (end == ARENA_OK)
        return protected_call.status;
    session->last_outcome = end;
    session->loader.compiling = compiling;
    frame->evaluating = working;
    session->vm.arena = session->vm.builtins.arena = &frame->arena;
    return statuses[end];
}

void petri_interrupt(PetriSession *session) {
    if (session)
        atomic_store(session->interrupt_source, true);
}

bool petri_clear_interrupt(PetriSession *session) {
    return session && atomic_exchange(session->interrupt_source, false);
}
