// systems.c: the particle systems of the last frame, as petri.h shows them.
#include "session/session.h"

#include "value/format.h"

// One of the three requests. `found` is false until everything is there.
typedef struct Request {
    size_t system;
    uint32_t number;
    void *out;
    bool found;
} Request;

static bool ask(PetriSession *session, SessionCall *call, size_t system, uint32_t number, void *out) {
    Request request = {system, number, out, false};
    arena_reset(&session->view_arena);
    PetriStatus status = session_protect(session, NULL, call, &request);
    return session_tell_end(session, status, "the answer") == PETRI_OK && request.found;
}

// The printed prefix, made once a frame.
static const char *name_of(PetriSession *session, size_t number, Value prefix) {
    SessionFrame *frame = &session->frame;
    Arena *arena = &frame->systems_arena;
    if (number >= frame->system_name_count) {
        size_t count = number + 8;
        const char **names = arena_alloc_array(arena, count, sizeof *names);
        for (size_t i = 0; i < count; i++)
            names[i] = i < frame->system_name_count ? frame->system_names[i] : NULL;
        frame->system_names = names;
        frame->system_name_count = count;
    }
    if (!frame->system_names[number])
        frame->system_names[number] = format_text(arena, &session->symbols, prefix).bytes;
    return frame->system_names[number];
}

static void find_system(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    if (!scene_view(session->scene, session->state, request->system, &view))
        return;
    *(PetriSystem *)request->out = (PetriSystem){
        .name = name_of(session, request->system, view.prefix),
        .dimensions = view.dimensions,
        .particle_count = view.particle_count,
        .force_count = phys_force_count(view.engine),
        .steps = view.steps,
    };
    request->found = true;
}

bool petri_system(PetriSession *session, size_t number, PetriSystem *system) {
    return session && system && ask(session, find_system, number, 0, system);
}

static void find_particle(PetriSession *session, void *context) {
    Request *request = context;
    uint32_t particle = request->number;
    SceneView view;
    PhysParticle described;
    if (!scene_view(session->scene, session->state, request->system, &view) || particle >= view.particle_count ||
        !phys_get_particle(view.engine, particle, &described))
        return;
    Arena *arena = &session->view_arena;
    double *force = arena_alloc_array(arena, view.dimensions, sizeof *force);
    *(PetriParticle *)request->out = (PetriParticle){
        .id = format_text(arena, &session->symbols, scene_view_id(arena, session->state, &view, particle)).bytes,
        .anchor = described.anchor,
        .radius = described.radius,
        .mass = described.mass,
        .charge = described.charge,
        .position = described.position,
        .velocity = described.velocity,
        .force = phys_force_on(view.engine, particle, force) ? force : NULL,
    };
    request->found = true;
}

bool petri_particle(PetriSession *session, size_t number, uint32_t particle, PetriParticle *out) {
    return session && out && ask(session, find_particle, number, particle, out);
}

static void find_force(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    PhysForce force;
    if (!scene_view(session->scene, session->state, request->system, &view) ||
        !phys_get_force(view.engine, request->number, &force))
        return;
    bool barrier = force.kind == PHYS_BARRIER;
    double *zero = arena_alloc_array(&session->view_arena, view.dimensions, sizeof *zero);
    for (uint32_t k = 0; k < view.dimensions; k++)
        zero[k] = 0;
    *(PetriForce *)request->out = (PetriForce){
        .kind = schema_kinds[schema_kind_of_force(force.kind)].name,
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
    request->found = true;
}

bool petri_force(PetriSession *session, size_t number, uint32_t index, PetriForce *out) {
    return session && out && ask(session, find_force, number, index, out);
}
