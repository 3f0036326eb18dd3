// systems.c: public access to the particle systems of the last frame.
#include "session/session.h"
#include "value/format.h"

// A query about a system, whose result is stored in *out. `found` is set to true when the result is complete.
typedef struct Request {
    size_t system;
    uint32_t number;
    void *out;
    bool found;
} Request;

static bool run_request(PetriSession *session, SessionCall *call, size_t system, uint32_t number, void *out) {
    Request request = {system, number, out, false};
    arena_reset(&session->view_arena);
    PetriStatus status = session_protect(session, NULL, call, &request);
    return session_report_abort(session, status, "the query") == PETRI_OK && request.found;
}

// Returns the prefix of a system in printed form. Creates it on the first call in a frame.
static const char *system_name(PetriSession *session, size_t number, Value prefix) {
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

static PetriColumn public_column(PhysColumn column) {
    return (PetriColumn){column.numbers, column.stride};
}

static void find_system(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    if (!scene_view(session->scene, session->state, request->system, &view))
        return;
    PhysColumns columns = phys_columns(view.engine);
    *(PetriSystem *)request->out = (PetriSystem){
        .name = system_name(session, request->system, view.prefix),
        .dimensions = view.dimensions,
        .particle_count = view.particle_count,
        .force_count = phys_force_count(view.engine),
        .steps = view.steps,
        .position = public_column(columns.position),
        .velocity = public_column(columns.velocity),
        .force = public_column(columns.force),
        .radius = public_column(columns.radius),
        .mass = public_column(columns.mass),
        .charge = public_column(columns.charge),
        .anchor = columns.anchor,
        .anchor_stride = columns.anchor_stride,
    };
    request->found = true;
}

void petri_keep_columns(PetriSession *session, bool keep) {
    if (!session)
        return;
    session->budget.retains = keep;
    if (!keep)
        arena_free_retained(&session->budget);
}

bool petri_system(PetriSession *session, size_t number, PetriSystem *system) {
    return session && system && run_request(session, find_system, number, 0, system);
}

static void find_rank_stats(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    if (!scene_view(session->scene, session->state, request->system, &view))
        return;
    PhysRankStats stats = phys_rank_stats(view.engine);
    *(PetriRankStats *)request->out = (PetriRankStats){
        .decomposition = (PetriDecomposition)stats.decomposition,
        .frames = stats.frames,
        .steps = stats.steps,
        .step_bytes = stats.step_bytes,
        .step_messages = stats.step_messages,
        .reductions = stats.reductions,
        .frame_bytes = stats.frame_bytes,
        .own = stats.own,
        .halo = stats.halo,
    };
    request->found = true;
}

bool petri_rank_stats(PetriSession *session, size_t number, PetriRankStats *stats) {
    return session && stats && run_request(session, find_rank_stats, number, 0, stats);
}

static void find_id(PetriSession *session, void *context) {
    Request *request = context;
    SceneView view;
    Arena *arena = &session->view_arena;
    if (!scene_view(session->scene, session->state, request->system, &view) || request->number >= view.particle_count)
        return;
    Value buffer;
    const Value *key = state_slot_key_at(session->state, view.slots[2 * (size_t)request->number], &buffer);
    PetriValue *id = request->out;
    request->found = true;
    if (key->kind == VALUE_NUMBERS) {
        *id = (PetriValue){.length = key->len - view.prefix.len, .numbers = value_numbers(key) + view.prefix.len};
        return;
    }
    Value *slice = arena_alloc(arena, sizeof *slice);
    *slice = scene_view_id(arena, session->state, &view, request->number);
    *id = session_export_value(slice);
}

PetriValue petri_particle_id(PetriSession *session, size_t system, uint32_t particle) {
    PetriValue id = {0};
    return session && run_request(session, find_id, system, particle, &id) ? id : (PetriValue){0};
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

PetriColumn petri_particle_ids(PetriSession *session, size_t system) {
    PetriColumn ids = {NULL, 1};
    if (session)
        run_request(session, find_ids, system, 0, &ids);
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
                     session_import_value(&session->key_arena, search->id, &id) &&
                     scene_view_find(session->scene, session->state, &session->key_arena, &view, id, &search->found);
}

bool petri_find_particle(PetriSession *session, size_t system, PetriValue id, uint32_t *particle) {
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

bool petri_system_force(PetriSession *session, size_t number, uint32_t index, PetriForce *out) {
    return session && out && run_request(session, find_force, number, index, out);
}
