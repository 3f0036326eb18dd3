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

static PetriColumn shown_column(PhysColumn column) {
    return (PetriColumn){column.numbers, column.stride};
}

static void find_system(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    if (!scene_view(session->scene, session->state, request->system, &view))
        return;
    PhysColumns columns = phys_columns(view.engine);
    *(PetriSystem *)request->out = (PetriSystem){
        .name = name_of(session, request->system, view.prefix),
        .dimensions = view.dimensions,
        .particle_count = view.particle_count,
        .force_count = phys_force_count(view.engine),
        .steps = view.steps,
        .position = shown_column(columns.position),
        .velocity = shown_column(columns.velocity),
        .force = shown_column(columns.force),
        .radius = shown_column(columns.radius),
        .mass = shown_column(columns.mass),
        .charge = shown_column(columns.charge),
        .anchor = columns.anchor,
        .anchor_stride = columns.anchor_stride,
    };
    request->found = true;
}

void petri_keep_columns(PetriSession *session, bool keep) {
    if (!session)
        return;
    session->meter.keeps = keep;
    if (!keep)
        arena_drop_kept(&session->meter);
}

bool petri_system(PetriSession *session, size_t number, PetriSystem *system) {
    return session && system && ask(session, find_system, number, 0, system);
}

static void find_traffic(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    if (!scene_view(session->scene, session->state, request->system, &view))
        return;
    PhysTraffic traffic = phys_traffic(view.engine);
    *(PetriTraffic *)request->out = (PetriTraffic){
        .sharing = (PetriSharing)traffic.sharing,
        .frames = traffic.frames,
        .steps = traffic.steps,
        .step_bytes = traffic.step_bytes,
        .step_messages = traffic.step_messages,
        .reductions = traffic.reductions,
        .frame_bytes = traffic.frame_bytes,
        .own = traffic.own,
        .halo = traffic.halo,
    };
    request->found = true;
}

bool petri_traffic(PetriSession *session, size_t number, PetriTraffic *traffic) {
    return session && traffic && ask(session, find_traffic, number, 0, traffic);
}

static void find_id(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    Arena *arena = &session->view_arena;
    if (!scene_view(session->scene, session->state, request->system, &view) || request->number >= view.particle_count)
        return;
    Value room;
    const Value *key = state_slot_key_at(session->state, view.slots[2 * (size_t)request->number], &room);
    PetriValue *id = request->out;
    request->found = true;
    if (key->kind == VALUE_NUMBERS) {
        *id = (PetriValue){.length = key->len - view.prefix.len, .numbers = value_numbers(key) + view.prefix.len};
        return;
    }
    Value *slice = arena_alloc(arena, sizeof *slice);
    *slice = scene_view_id(arena, session->state, &view, request->number);
    *id = session_show(slice);
}

PetriValue petri_id(PetriSession *session, size_t system, uint32_t particle) {
    PetriValue id = {0};
    return session && ask(session, find_id, system, particle, &id) ? id : (PetriValue){0};
}

static void find_ids(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    const double *ids;
    if (!scene_view(session->scene, session->state, request->system, &view))
        return;
    if (!scene_view_ids(session->state, &view, &ids))
        arena_exhausted(&session->view_arena);
    *(PetriColumn *)request->out = (PetriColumn){ids, 1};
    request->found = true;
}

PetriColumn petri_ids(PetriSession *session, size_t system) {
    PetriColumn ids = {NULL, 1};
    if (session)
        ask(session, find_ids, system, 0, &ids);
    return ids;
}

typedef struct Search {
    PetriValue id;
    uint32_t found;
} Search;

static void find_by_id(PetriSession *session, void *context) {
    Request *request = context;
    Search *search = request->out;
    SceneView view;
    Value id;
    arena_reset(&session->key_arena);
    request->found = scene_view(session->scene, session->state, request->system, &view) &&
                     session_take(&session->key_arena, search->id, &id) &&
                     scene_view_find(session->scene, session->state, &session->key_arena, &view, id, &search->found);
}

bool petri_find(PetriSession *session, size_t system, PetriValue id, uint32_t *particle) {
    Search search = {id, 0};
    Request request = {system, 0, &search, false};
    if (!session || !particle || session_protect(session, NULL, find_by_id, &request) != PETRI_OK || !request.found)
        return false;
    *particle = search.found;
    return true;
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
