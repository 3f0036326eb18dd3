// step_forces.c: forces of the host, which it computes in each step (petri_set_force_callback).
#include "base/number.h"
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

// Returns true if the host exerts a force on a particle that does not change its velocity (spec physics.md 4.3).
static bool is_ignored(const Step *step, uint32_t particle) {
    const double *force = step->start->force + (size_t)particle * step->start->dimensions;
    return !numbers_finite(force, step->start->dimensions, 1) && !phys_is_anchor(step->engine, particle);
}

static PetriStatus report_ignored(PetriSession *session, void *context) {
    const Step *step = context;
    for (uint32_t i = 0; i < step->start->particle_count; i++)
        if (is_ignored(step, i)) {
            Str text = str_format(&session->text_arena,
                                  "the force of the host on particle number %u of %s is not finite, so the particle "
                                  "keeps its velocity",
                                  (unsigned)i, step->name);
            session_report_text(session, DIAG_WARNING, "not-finite", text);
            break;
        }
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
    else if (!numbers_finite(start->force, start->dimensions * start->particle_count, 1))
        session_attempt(session, NULL, report_ignored, &step);
    return true;
}

PetriStatus petri_set_force_callback(PetriSession *session, PetriForceCallback *callback, void *user_data) {
    if (!session || session->call_depth > 0 || (callback && session->ranks.calls.rank_count > 1))
        return PETRI_INVALID;
    session->step_forces = (StepForces){callback, user_data};
    scene_set_forces(session->scene, callback ? exert_forces : NULL, session);
    return PETRI_OK;
}
