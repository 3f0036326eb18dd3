// systems.c: the particle systems of the last frame, as petri.h shows them.
#include "session/session.h"

#include "value/format.h"

// The public kinds are those of the engine: a row of force_list.h that petri.h lacks does not compile.
#define SAME(KIND, ...) _Static_assert((int)PETRI_##KIND == (int)PHYS_##KIND, "petri.h has other kinds of forces");
PHYS_FORCES(SAME, SAME, SAME, SAME)
#undef SAME

static const char *printed(PetriSession *session, Value v) {
    Text text = text_new(&session->text_arena);
    format_value(&text, &session->symbols, v);
    return str_to_c(&session->text_arena, text_str(&text));
}

static bool view_of(PetriSession *session, size_t number, SceneView *view) {
    arena_reset(&session->text_arena);
    return scene_view(session->scene, session->state, number, view);
}

bool petri_system(PetriSession *session, size_t number, PetriSystem *system) {
    SceneView view;
    if (!view_of(session, number, &view))
        return false;
    *system = (PetriSystem){
        .name = printed(session, view.prefix),
        .dimensions = view.dimensions,
        .particle_count = view.particle_count,
        .force_count = phys_force_count(view.engine),
        .steps = view.steps,
    };
    return true;
}

bool petri_particle(PetriSession *session, size_t number, uint32_t particle, PetriParticle *out) {
    SceneView view;
    PhysParticle described;
    if (!view_of(session, number, &view) || particle >= view.particle_count ||
        !phys_get_particle(view.engine, particle, &described))
        return false;
    Arena *arena = &session->text_arena;
    double *force = arena_alloc_array(arena, view.dimensions, sizeof *force);
    *out = (PetriParticle){
        .id = printed(session, scene_view_id(arena, session->state, &view, particle)),
        .anchor = described.anchor,
        .radius = described.radius,
        .mass = described.mass,
        .charge = described.charge,
        .position = described.position,
        .velocity = described.velocity,
        .force = phys_force_on(view.engine, particle, force) ? force : NULL,
    };
    return true;
}

bool petri_force(PetriSession *session, size_t number, uint32_t index, PetriForce *out) {
    SceneView view;
    PhysForce force;
    if (!view_of(session, number, &view) || !phys_get_force(view.engine, index, &force))
        return false;
    bool barrier = force.kind == PHYS_BARRIER;
    double *zero = arena_alloc_array(&session->text_arena, view.dimensions, sizeof *zero);
    for (uint32_t k = 0; k < view.dimensions; k++)
        zero[k] = 0;
    *out = (PetriForce){
        .kind = (PetriForceKind)force.kind,
        .strength = force.strength,
        .from = force.from,
        .to = force.to,
        .position = !barrier       ? NULL
                    : force.vector ? force.vector
                                   : zero,
        .normal = !barrier        ? NULL
                  : force.vector2 ? force.vector2
                                  : zero,
    };
    return true;
}
