// step_forces.c: forces of the host, which it computes in each step (petri_set_force_callback).
#include "session/session.h"
#include "value/format.h"

// A step of a system.
typedef struct Step {
    StateSlot prefix;
    const PhysSystem *engine;
    const PhysStepStart *start;
    const char *name; // prefix in printed form
} Step;

static PetriStatus name_system(PetriSession *session, void *context) {
    Step *step = context;
    arena_reset(&session->key_arena);
    step->name =
        format_text(&session->key_arena, &session->symbols, state_slot_key(session->state, step->prefix)).bytes;
    return PETRI_OK;
}

// Calls the host outside of the protected call, because an escape (longjmp) must not skip over code of the host.
static bool exert_forces(void *host, StateSlot prefix, const PhysSystem *engine, const PhysStepStart *start) {
    PetriSession *session = host;
    Step step = {.prefix = prefix, .engine = engine, .start = start};
    PetriStatus status = session_attempt(session, NULL, name_system, &step);
    if (status != PETRI_OK)
        return status == PETRI_INTERRUPTED; // the step checks for interrupts
    PetriSystem system = session_system(engine, step.name, start->dimensions);
    system.position = (PetriColumn){start->position, start->dimensions};
    system.velocity = (PetriColumn){start->velocity, start->dimensions};
    system.force = (PetriColumn){0};
    const StepForces *forces = &session->step_forces;
    if (!forces->callback(forces->user_data, &system, start->clock, start->delta, start->force))
        petri_interrupt(session);
    return true;
}

PetriStatus petri_set_force_callback(PetriSession *session, PetriForceCallback *callback, void *user_data) {
    if (!session || session->call_depth > 0 || (callback && session->ranks.calls.rank_count > 1))
        return PETRI_INVALID;
    session->step_forces = (StepForces){callback, user_data};
    scene_set_forces(session->scene, callback ? exert_forces : NULL, session);
    return PETRI_OK;
}
