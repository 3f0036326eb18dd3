// scene.c: the list of systems and their update in a frame (scene.h).
#include "scene/scene.h"

#include "base/heap.h"
#include "scene/systems.h"

#include <math.h>
#include <string.h>

Scene *scene_new(Arena *arena, Schema *schema) {
    SymbolTable *symbols = schema->symbols;
    Scene *scene = arena_alloc(arena, sizeof *scene);
    *scene = (Scene){.schema = schema, .budget = arena->budget};
    physics_read_defaults(scene);
    input_init(&scene->input, symbols);
    scene->physics = (PhysOptions){.threads = 1, .cpu = cpu_detected.level, .budget = scene->budget};
    scene->next_place = &scene->systems;
    scene->key_run = symbol_register(symbols, STR("run"));
    scene->key_iteration = symbol_register(symbols, STR("iteration"));
    scene->key_clock = symbol_register(symbols, STR("clock"));
    scene->key_last = symbol_register(symbols, STR("last"));
    scene->key_velocity = symbol_register(symbols, STR("velocity"));
    scene->key_time = symbol_register(symbols, STR("time"));
    return scene;
}

void scene_set_physics(Scene *scene, const PhysOptions *options) {
    phys_threads_free(scene->physics.pool);
    scene->physics = *options;
    scene->physics.budget = scene->budget;
    scene->physics.pool = options->threads == 1 ? NULL : phys_threads_new(options->threads);
}

static bool add_forces(void *context, const PhysSystem *engine, const PhysStepStart *step) {
    const PhysicsSystem *system = context;
    return system->scene->add_forces(system->scene->forces_host, system->start, engine, step);
}

void scene_set_engine(PhysicsSystem *system) {
    PhysOptions options = system->scene->physics;
    options.add_forces = system->scene->add_forces ? add_forces : NULL;
    options.add_context = system;
    phys_set_options(system->engine, &options);
}

static void set_engines(const Scene *scene) {
    for (PhysicsSystem *system = scene->systems; system; system = system->next)
        if (system->engine)
            scene_set_engine(system);
}

void scene_set_rules(Scene *scene, unsigned old_rules) {
    if (scene->physics.old_rules == old_rules)
        return;
    scene->physics.old_rules = old_rules;
    set_engines(scene);
}

void scene_set_forces(Scene *scene, SceneAddForces *add, void *host) {
    scene->add_forces = add;
    scene->forces_host = host;
    set_engines(scene);
}

PhysThreads *scene_threads(const Scene *scene) {
    return scene->physics.pool;
}

Origin scene_force_origin(const Scene *scene, const SceneView *view, uint32_t force) {
    const PhysicsSystem *system = view->system;
    bool valid = scene->origins_valid && system->origins_frame == scene->frame_number && force < system->origin_count;
    const NodeOrigin *found = valid ? system->origins[force] : NULL;
    return found ? found->origin : (Origin){.source = NULL};
}

void scene_forget_origins(Scene *scene) {
    scene->origins_valid = false;
}

static void free_system(PhysicsSystem *system) {
    budget_release(system->budget, PHYSICS_SYSTEM_BYTES + system->mirror.id_capacity * sizeof *system->mirror.ids);
    phys_free(system->engine);
    mirror_free(&system->mirror);
    heap_free(system->nodes);
    heap_free(system->randoms);
    heap_free(system->links);
    heap_free(system->origins);
    heap_free(system);
}

void scene_free_systems(PhysicsSystem *systems) {
    for (PhysicsSystem *system = systems, *next; system; system = next) {
        next = system->next;
        free_system(system);
    }
}

PhysicsSystem *scene_detach_systems(Scene *scene) {
    PhysicsSystem *systems = scene->systems;
    scene->systems = scene->viewed = NULL;
    scene->next_place = &scene->systems;
    scene->marked_system = NULL;
    return systems;
}

void scene_attach_systems(Scene *scene, PhysicsSystem *systems) {
    scene_reset(scene);
    scene->systems = systems;
}

void scene_reset(Scene *scene) {
    scene_free_systems(scene_detach_systems(scene));
}

void scene_free(Scene *scene) {
    if (!scene)
        return;
    scene_reset(scene);
    phys_threads_free(scene->physics.pool);
    heap_free(scene->bodies);
    input_free(&scene->input);
}

bool scene_clear_exhausted(Scene *scene) {
    bool was = scene->exhausted;
    scene->exhausted = false;
    return was;
}

bool scene_clear_stopped(Scene *scene, ArenaOutcome *end) {
    BudgetOutcome how = scene->stopped;
    scene->stopped = BUDGET_OK;
    *end = how == BUDGET_EXCEEDED ? ARENA_WORK_LIMIT : how == BUDGET_INTERRUPTED ? ARENA_INTERRUPTED : *end;
    return how != BUDGET_OK;
}

Input *scene_input(Scene *scene) {
    return &scene->input;
}

// Removes unused slots from the state if there are many. Without this, ids that come and go would fill the state.
static void compact_state(Scene *scene, const SceneFrame *frame) {
    enum { MIN_COMPACTED = 4096 };
    uint32_t count = state_slot_count(frame->state), held = 0;
    if (count < MIN_COMPACTED || count / 2 < state_count(frame->state))
        return;
    for (PhysicsSystem *system = scene->systems; system; system = system->next) {
        if (system->mirror.state == MIRROR_OPEN)
            return; // the update of this system was aborted, so its slots are not valid
        held += system->mirror.slot_count;
    }
    if (count / 2 < held)
        return; // many slots without a value belong to particles, which get values in the first step
    uint8_t *used = arena_alloc_array(frame->arena, count, sizeof *used);
    StateSlot *moved = arena_alloc_array(frame->arena, count, sizeof *moved), *own[PHYSICS_OWN_SLOTS];
    memset(used, 0, count);
    for (PhysicsSystem *system = scene->systems; system; system = system->next) {
        physics_own_slots(system, own);
        for (int i = 0; i < PHYSICS_OWN_SLOTS; i++)
            used[*own[i]] = 1;
        for (uint32_t i = 0; i < system->mirror.slot_count; i++)
            used[system->mirror.slots[i]] = 1;
    }
    if (!state_compact(frame->state, used, moved))
        return;
    scene->marked_system = NULL;
    for (PhysicsSystem *system = scene->systems; system; system = system->next) {
        physics_own_slots(system, own);
        for (int i = 0; i < PHYSICS_OWN_SLOTS; i++)
            *own[i] = moved[*own[i]];
        for (uint32_t i = 0; i < system->mirror.slot_count; i++)
            system->mirror.slots[i] = moved[system->mirror.slots[i]];
    }
}

// Frees systems that are absent from the last FRAMES frames. If they reappear, they start with the values in the state.
static void free_absent(Scene *scene, const SceneFrame *frame) {
    enum { FRAMES = 8 };
    PhysicsSystem **link = &scene->systems;
    while (*link) {
        PhysicsSystem *system = *link;
        if (system->last_frame + FRAMES >= scene->frame_number) {
            link = &system->next;
            continue;
        }
        mirror_leave(&system->mirror, frame->state);
        *link = system->next;
        free_system(system);
        scene->marked_system = NULL;
    }
    scene->next_place = &scene->systems;
    scene->viewed = NULL;
}

uint64_t scene_update(Scene *scene, Value tree, const SceneFrame *frame) {
    enum { NODE_WORK = 50 }; // work units of a node, for a lookup and some state entries
    uint64_t steps = 0;
    scene->frame_number++;
    scene->origins_valid = true;
    scene->stopped = BUDGET_OK;
    scene->tree_was_read = false;
    free_absent(scene, frame);
    compact_state(scene, frame);
    for (uint32_t i = 0; tree.kind == VALUE_MIXED && i < tree.len; i++) {
        const Item *item = &tree.as.items[i];
        NodeKind kind = item->type == ITEM_NODE ? schema_kind(scene->schema, item->as.node) : KIND_COUNT;
        if (kind != KIND_PHYSICS && kind != KIND_COUNTER)
            continue;
        scene->stopped = budget_charge(scene->budget, NODE_WORK);
        if (scene->stopped != BUDGET_OK)
            break;
        scene->schema->current_node = item->as.node;
        if (kind == KIND_PHYSICS)
            steps += physics_update(scene, item->as.node, frame);
        else
            counter_update(scene, item->as.node, frame);
        if (scene->exhausted || scene->stopped != BUDGET_OK)
            return steps; // the frame will be aborted
    }
    physics_report_shared_keys(scene, frame);
    input_bind(&scene->input, scene->schema, tree, frame->arena);
    return steps;
}

static double number_in(const State *state, StateSlot slot) {
    Value value = state_slot_get(state, slot);
    return value.kind == VALUE_NUMBERS && value.len == 1 ? value_numbers(&value)[0] : 0;
}

bool scene_view(Scene *scene, const State *state, size_t number, SceneView *view) {
    // Starts from the system that was found last if possible, because hosts usually ask for systems in order.
    bool further = scene->viewed && number >= scene->viewed_number;
    size_t at = further ? scene->viewed_number : 0;
    for (PhysicsSystem *system = further ? scene->viewed : scene->systems; system; system = system->next) {
        if (system->last_frame != scene->frame_number || !system->engine || !system->dimensions || at++ < number)
            continue;
        scene->viewed = system;
        scene->viewed_number = number;
        uint32_t count = phys_particle_count(system->engine), listed = system->mirror.slot_count / 2;
        *view = (SceneView){.engine = system->engine,
                            .prefix = state_slot_key(state, system->start),
                            .dimensions = system->dimensions,
                            .particle_count = count < listed ? count : listed,
                            .steps = system->steps,
                            .clock = number_in(state, system->clock),
                            .had_simulated = system->had_simulated,
                            .slots = system->mirror.slots,
                            .system = system};
        return true;
    }
    return false;
}

Value scene_view_id(Arena *arena, const State *state, const SceneView *view, uint32_t particle) {
    Value key =
        value_copy(arena, state_slot_key_in(state, view->slots[2 * (size_t)particle], (double[STATE_KEY_BUFFER]){0}));
    return value_slice(arena, key, view->prefix.len, key.len - view->prefix.len);
}

// Returns the id if it is a single number, else NaN, which no key contains.
static double single_id(const State *state, const SceneView *view, uint32_t particle) {
    return state_slot_last_number(state, view->slots[2 * (size_t)particle], view->prefix.len + 1);
}

// Reserves memory for the ids and charges it to the script's budget. Returns false if out of memory.
static bool reserve_ids(PhysicsSystem *system, uint32_t count) {
    Mirror *mirror = &system->mirror;
    if (count <= mirror->id_capacity)
        return true;
    budget_release(system->budget, mirror->id_capacity * sizeof *mirror->ids);
    heap_free(mirror->ids);
    mirror->ids = NULL;
    mirror->id_capacity = 0;
    if (!budget_reserve(system->budget, count * sizeof *mirror->ids))
        return false;
    mirror->ids = heap_alloc(count * sizeof *mirror->ids);
    mirror->id_capacity = mirror->ids ? count : 0;
    if (!mirror->ids)
        budget_release(system->budget, count * sizeof *mirror->ids);
    return mirror->ids;
}

bool scene_view_ids(const State *state, const SceneView *view, const double **ids) {
    Mirror *mirror = &view->system->mirror;
    *ids = NULL;
    if (!view->particle_count)
        return true;
    if (!mirror->ids_cached) {
        if (!reserve_ids(view->system, view->particle_count))
            return false;
        mirror->ids_single = mirror->ids_cached = true;
        for (uint32_t i = 0; i < view->particle_count && mirror->ids_single; i++) {
            mirror->ids[i] = single_id(state, view, i);
            mirror->ids_single = mirror->ids[i] == mirror->ids[i];
        }
    }
    *ids = mirror->ids_single ? mirror->ids : NULL;
    return true;
}

void scene_show_entry(Scene *scene, const State *state, StateSlot slot) {
    Value value = state_slot_get(state, slot);
    for (PhysicsSystem *system = scene->systems; system; system = system->next) {
        if (value.kind != VALUE_NUMBERS || value.len == 0 || value.len != system->dimensions || !system->engine)
            continue;
        for (uint32_t i = 0; i < system->mirror.slot_count; i++)
            if (system->mirror.slots[i] == slot && i / 2 < phys_particle_count(system->engine)) {
                phys_show_vector(system->engine, i / 2, i % 2 == 1, value_numbers(&value));
                // The next frame reads the tree, and the vector from the state.
                system->mirror.state = system->mirror.state == MIRROR_CURRENT ? MIRROR_STALE : system->mirror.state;
            }
    }
}

bool scene_view_find(Scene *scene, State *state, Arena *arena, const SceneView *view, Value id, uint32_t *particle) {
    SceneFrame frame = {.state = state, .arena = arena};
    PhysicsTree tree = {.scene = scene,
                        .system = view->system,
                        .frame = &frame,
                        .prefix = view->prefix,
                        .body_count = view->particle_count};
    int64_t found = physics_find_body(&tree, id);
    if (tree.out_of_memory)
        arena_exhausted(arena);
    *particle = (uint32_t)found;
    return found != PHYSICS_NO_BODY && found < view->particle_count;
}
