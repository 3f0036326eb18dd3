// systems.c: public access to the particle systems of the last frame.
#include "base/host_struct.h"
#include "petri-inspect.h"
#include "physics/energy.h"
#include "physics/forces.h"
#include "session/session.h"
#include "value/format.h"

// A query about a system, whose result `find` stores in *out.
typedef struct SystemRequest {
    PetriStatus (*find)(PetriSession *session, const struct SystemRequest *request, const SceneView *view);
    size_t system;
    uint32_t number; // number of a particle or force
    void *out;
} SystemRequest;

static PetriStatus find_in_view(PetriSession *session, void *context) {
    const SystemRequest *request = context;
    SceneView view;
    bool found = scene_view(session->scene, session->state, request->system, &view);
    return found ? request->find(session, request, &view) : PETRI_INVALID;
}

static bool run_request(PetriSession *session, SystemRequest request) {
    arena_reset(&session->view_arena);
    return session_query(session, find_in_view, &request);
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

PetriSystem session_system(const PhysSystem *engine, const char *name, uint32_t dimensions) {
    PhysColumns columns = phys_columns(engine);
    return (PetriSystem){
        .name = name,
        .dimensions = dimensions,
        .particle_count = phys_particle_count(engine),
        .force_count = phys_force_count(engine),
        .position = public_column(columns.position),
        .velocity = public_column(columns.velocity),
        .force = public_column(columns.force),
        .radius = public_column(columns.radius),
        .mass = public_column(columns.mass),
        .charge = public_column(columns.charge),
        .anchor = columns.anchor,
        .anchor_stride = columns.anchor_stride,
    };
}

static PetriStatus find_shown_system(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    PetriSystem *system = request->out;
    *system = session_system(view->engine, system_name(session, request->system, view->prefix), view->dimensions);
    system->particle_count = view->particle_count;
    system->steps = view->steps;
    return PETRI_OK;
}

void petri_keep_columns(PetriSession *session, bool keep) {
    if (!session)
        return;
    session->budget.retains = keep;
    if (!keep)
        arena_free_retained(&session->budget);
}

size_t petri_system_count(PetriSession *session) {
    SceneView view;
    size_t count = 0;
    while (session && scene_view(session->scene, session->state, count, &view))
        count++;
    return count;
}

bool petri_system(PetriSession *session, size_t number, PetriSystem *system, size_t size) {
    PetriSystem found;
    return session && system && run_request(session, (SystemRequest){find_shown_system, number, 0, &found}) &&
           host_struct_write(system, size, &found, sizeof found);
}

static PetriStatus find_rank_stats(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    (void)session;
    *(PetriRankStats *)request->out = ranks_stats(view->engine);
    return PETRI_OK;
}

bool petri_rank_stats(PetriSession *session, size_t number, PetriRankStats *stats, size_t size) {
    PetriRankStats found;
    return session && stats && run_request(session, (SystemRequest){find_rank_stats, number, 0, &found}) &&
           host_struct_write(stats, size, &found, sizeof found);
}

static PetriStatus find_id(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    Arena *arena = &session->view_arena;
    if (request->number >= view->particle_count)
        return PETRI_INVALID;
    Value buffer;
    const Value *key = state_slot_key_at(session->state, view->slots[2 * (size_t)request->number], &buffer);
    PetriValue *id = request->out;
    if (key->kind == VALUE_NUMBERS) {
        *id = (PetriValue){.length = key->len - view->prefix.len, .numbers = value_numbers(key) + view->prefix.len};
        return PETRI_OK;
    }
    Value *slice = arena_alloc(arena, sizeof *slice);
    *slice = scene_view_id(arena, session->state, view, request->number);
    *id = session_export_value(slice);
    return PETRI_OK;
}

PetriValue petri_particle_id(PetriSession *session, size_t system, uint32_t particle) {
    PetriValue id = {0};
    return session && run_request(session, (SystemRequest){find_id, system, particle, &id}) ? id : (PetriValue){0};
}

static PetriStatus find_ids(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    const double *ids;
    if (!scene_view_ids(session->state, view, &ids))
        arena_exhausted(&session->view_arena);
    *(PetriColumn *)request->out = (PetriColumn){ids, 1};
    return PETRI_OK;
}

PetriColumn petri_particle_ids(PetriSession *session, size_t system) {
    PetriColumn ids = {NULL, 1};
    if (session)
        run_request(session, (SystemRequest){find_ids, system, 0, &ids});
    return ids;
}

typedef struct SystemSearch {
    PetriValue id;
    uint32_t found;
} SystemSearch;

static PetriStatus find_by_id(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    SystemSearch *search = request->out;
    Value id;
    arena_reset(&session->key_arena);
    bool found = session_import_value(&session->key_arena, search->id, &id) &&
                 scene_view_find(session->scene, session->state, &session->key_arena, view, id, &search->found);
    return found ? PETRI_OK : PETRI_INVALID;
}

bool petri_find_particle(PetriSession *session, size_t system, PetriValue id, uint32_t *particle) {
    SystemSearch search = {id, 0};
    SystemRequest request = {find_by_id, system, 0, &search};
    if (!session || !particle || session_protect(session, NULL, find_in_view, &request) != PETRI_OK)
        return false;
    *particle = search.found;
    return true;
}

// Sets the position of a force's node, if it is known.
static void locate_force(PetriSession *session, const SceneView *view, uint32_t number, PetriForce *force) {
    Origin origin = scene_force_origin(session->scene, view, number);
    if (!origin.source)
        return;
    SourcePosition position = source_locate(origin.source, origin.span.start);
    force->file = str_to_c(&session->view_arena, origin.source->name);
    force->line = position.line;
    force->column = position.column;
}

static PetriStatus find_force(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    PhysForce force;
    if (!phys_get_force(view->engine, request->number, &force))
        return PETRI_INVALID;
    bool barrier = phys_force_row(force.kind).stage == STAGE_BARRIER;
    double *zero = arena_alloc_array(&session->view_arena, view->dimensions, sizeof *zero);
    for (uint32_t k = 0; k < view->dimensions; k++)
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
    locate_force(session, view, request->number, request->out);
    return PETRI_OK;
}

bool petri_system_force(PetriSession *session, size_t number, uint32_t index, PetriForce *out, size_t size) {
    PetriForce found;
    return session && out && run_request(session, (SystemRequest){find_force, number, index, &found}) &&
           host_struct_write(out, size, &found, sizeof found);
}

// Aborts the protected call if the engine was stopped or has run out of memory.
static void check_physics(PetriSession *session, PhysStatus status) {
    Arena *arena = &session->view_arena;
    if (status == PHYS_STOPPED)
        arena_check(arena, budget_check(&session->budget));
    if (status == PHYS_NO_MEMORY)
        arena_escape(arena, session->budget.memory_refused ? ARENA_MEMORY_LIMIT : ARENA_OUT_OF_MEMORY);
}

// Explains a step, whose number is *request->out. The result is in session->explanation.
static PetriStatus explain_force(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    uint64_t step = *(const uint64_t *)request->out;
    if (request->number >= view->particle_count || step >= phys_explained_steps(view->engine))
        return PETRI_INVALID;
    check_physics(session, phys_explain(view->engine, request->number, step, &session->explanation));
    return PETRI_OK;
}

static PetriStatus find_energy(PetriSession *session, const SystemRequest *request, const SceneView *view) {
    if (request->number >= phys_force_count(view->engine))
        return PETRI_INVALID;
    check_physics(session, phys_potential_energy(view->engine, request->number, view->clock, request->out));
    return PETRI_OK;
}

PetriStatus petri_potential_energy(PetriSession *session, size_t system, uint32_t force, double *energy) {
    if (!session || !energy)
        return PETRI_INVALID;
    *energy = NAN;
    arena_reset(&session->view_arena);
    SystemRequest request = {find_energy, system, force, energy};
    return session_run(session, find_in_view, &request, "the potential energy");
}

PetriStatus petri_explain_force(PetriSession *session, size_t system, uint32_t particle, uint64_t step,
                                PetriExplanation *explanation, size_t size) {
    if (!session || !explanation)
        return PETRI_INVALID;
    const PhysExplanation *found = &session->explanation;
    phys_explanation_free(&session->explanation);
    arena_reset(&session->view_arena);
    SystemRequest request = {explain_force, system, particle, &step};
    PetriStatus status = session_run(session, find_in_view, &request, "the explanation");
    if (status != PETRI_OK) {
        phys_explanation_free(&session->explanation);
        return status;
    }
    const PetriExplanation data = {.count = found->count,
                                   .force = found->forces,
                                   .partner = found->partners,
                                   .vector = found->vectors,
                                   .sum = found->sum,
                                   .clock = found->clock,
                                   .delta = found->delta,
                                   .position = found->position,
                                   .velocity = found->velocity};
    host_struct_write(explanation, size, &data, sizeof data);
    return PETRI_OK;
}
