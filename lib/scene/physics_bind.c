// physics_bind.c: updates the tree, the state and the engine of a `!physics` system in a frame (spec physics.md section
// 2).
#include "base/heap.h"
#include "scene/systems.h"

#include <math.h>

static double scene_number(const State *state, StateSlot slot, double default_value) {
    Value v = state_slot_get(state, slot);
    return value_is_number(v) && isfinite(v.as.number) ? v.as.number : default_value;
}

// Returns the link to the first system with this prefix that has not been updated in this frame, or NULL. Sets
// *occurrence to the number of systems with this prefix that have already been updated.
static PhysicsSystem **known_system(Scene *scene, StateSlot start, uint32_t *occurrence, Arena *arena) {
    PhysicsSystem *expected = *scene->next_place; // the next system in the order of the last frame
    *occurrence = 0;
    if (expected && expected->start == start && expected->occurrence == 0)
        return scene->next_place;
    for (PhysicsSystem **link = &scene->systems; *link; link = &(*link)->next) {
        arena_charge(arena, 4); // more than 1 unit, because systems are not contiguous in memory
        if ((*link)->start != start)
            continue;
        if ((*link)->last_frame != scene->frame_number)
            return link;
        ++*occurrence;
    }
    return NULL;
}

// Moves the system at a link, which known_system has returned, to its place in the order of the tree.
static PhysicsSystem *place_system(Scene *scene, PhysicsSystem **link) {
    PhysicsSystem *system = *link;
    if (link != scene->next_place) {
        *link = system->next;
        system->next = *scene->next_place;
        *scene->next_place = system;
    }
    scene->next_place = &system->next;
    return system;
}

static PhysicsSystem *new_system(Scene *scene, StateSlot start, uint32_t occurrence, const SceneFrame *frame) {
    PhysicsSystem *system = budget_reserve(scene->budget, PHYSICS_SYSTEM_BYTES) ? heap_calloc(1, sizeof *system) : NULL;
    if (!system)
        return NULL;
    Value prefix = state_slot_key(frame->state, start);
    *system = (PhysicsSystem){
        .next = *scene->next_place,
        .scene = scene,
        .start = start,
        .occurrence = occurrence,
        .last_frame = scene->frame_number - 1,
        .run = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_run)),
        .iteration = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_iteration)),
        .clock = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_clock)),
        .last = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_last)),
        .engine = phys_new(),
        .budget = scene->budget,
    };
    *scene->next_place = system;
    scene->next_place = &system->next;
    if (system->engine)
        scene_set_engine(system);
    return system;
}

// Removes all particles from the mirror of a system that was absent from the last frame. The entries of the system
// remain in the state.
static void detach_if_absent(const Scene *scene, PhysicsSystem *system, State *state) {
    if (system->last_frame + 1 == scene->frame_number)
        return;
    mirror_leave(&system->mirror, state);
}

// Returns the system with this prefix, which is created if necessary. Returns NULL if out of memory.
static PhysicsSystem *find_system(Scene *scene, Value prefix, const SceneFrame *frame) {
    StateSlot start = state_slot(frame->state, prefix);
    if (start == STATE_NO_SLOT)
        return NULL;
    uint32_t occurrence;
    PhysicsSystem **known = known_system(scene, start, &occurrence, frame->arena);
    if (!known)
        return new_system(scene, start, occurrence, frame);
    PhysicsSystem *system = place_system(scene, known);
    detach_if_absent(scene, system, frame->state);
    return system;
}

bool scene_next_system(const Scene *scene, const void **cursor, SceneSystem *saved) {
    const PhysicsSystem *system = *cursor ? ((const PhysicsSystem *)*cursor)->next : scene->systems;
    if (!system || system->last_frame != scene->frame_number)
        return false; // the others are absent from the last tree
    *cursor = system;
    *saved = (SceneSystem){system->start, system->occurrence, system->mirror.slots, system->mirror.slot_count};
    return true;
}

bool scene_restore_system(Scene *scene, const SceneSystem *saved, const SceneFrame *frame) {
    PhysicsSystem *system = new_system(scene, saved->prefix, saved->occurrence, frame);
    if (!system || !system->engine || !mirror_restore(&system->mirror, saved->slots, saved->slot_count))
        return false;
    system->last_frame = scene->frame_number; // as if updated in this frame
    return true;
}

static void set_number(const SceneFrame *frame, StateSlot slot, double x) {
    state_slot_set(frame->state, slot, value_number(x));
}

static bool read_settings(const Scene *scene, const Reader *reader, const SceneFrame *frame, SystemAttrs *settings) {
    *settings = scene->system_defaults;
    settings->time = frame->time;
    settings->resolution = 1 / frame->fps;
    reader_fill(reader, settings);
    if (frame->resolution > 0)
        settings->resolution = frame->resolution;
    if (!isfinite(settings->run))
        settings->run = 0;
    const Symbol *dimensions = reader->schema->slots[ROW_PHYSICS_DIMENSIONS].name;
    const char *reason = NULL, *missing = NULL;
    if (settings->state.len == 0)
        missing = "attribute 'state' is missing or null; the system is skipped";
    else if (!state_key_valid(settings->state))
        reason = "attribute 'state' must be numbers, symbols or strings, such as :x; the system is skipped";
    else if (!(settings->dimensions >= 1) && node_get(reader->node, dimensions).len == 0)
        missing = "attribute 'dimensions' is missing or null; the system is skipped";
    else if (!(settings->dimensions >= 1))
        reason = "dimensions must be at least 1; the system is skipped";
    else if (settings->dimensions > 1e9)
        reason = "dimensions must be at most 1000000000; the system is skipped";
    else if (!isfinite(settings->time))
        reason = "time is not finite; the system is skipped";
    else if (!(settings->resolution > 0) || !isfinite(settings->resolution))
        reason = "resolution must be above 0 and finite; the system is skipped";
    if (reason)
        reader_report(reader, "invalid-system", "", str_from(reason));
    if (missing)
        reader_report_error(reader, "invalid-system", str_from(missing));
    return !reason && !missing;
}

// Returns the number of nodes below a node.
static uint64_t count_nodes(Arena *arena, const Node *node) {
    uint64_t count = node_child_count(node);
    arena_charge(arena, 1 + count);
    for (uint32_t i = 0; i < node->child_count; i++)
        count += count_nodes(arena, node->children[i]);
    return count;
}

// Returns false and reports an error if the vectors of all nodes would need too much memory.
static bool fits_in_memory(const Reader *reader, const SystemAttrs *settings) {
    enum { MAX_UNCOUNTED = 64, COPIES = 16 };
    if (settings->dimensions <= MAX_UNCOUNTED)
        return true;
    double bytes =
        settings->dimensions * sizeof(double) * COPIES * (double)(count_nodes(reader->arena, reader->node) + 1);
    if (bytes <= (double)(UINT64_C(1) << 30))
        return true;
    reader_report(reader, "invalid-system", "",
                  STR("the vectors of the system would take more than 1 GiB; use fewer dimensions or nodes; the system "
                      "is skipped"));
    return false;
}

// Simulates up to settings->time (step 6) and returns the new clock.
static double simulate_system(PhysicsTree *tree, const Reader *reader, const SystemAttrs *settings, double last,
                              double clock, uint64_t *steps) {
    PhysTime time = {.last = last,
                     .now = settings->time,
                     .clock = clock,
                     .resolution = settings->resolution,
                     .lockstep = tree->frame->lockstep,
                     .performance = tree->frame->performance,
                     .speed_of_light = settings->speed_of_light,
                     .parts = tree->frame->parts,
                     .shift = tree->frame->shift,
                     .shift_key = tree->frame->shift_key,
                     .keep_last_finite = mirror_can_lend(tree)};
    PhysResult result = phys_simulate(tree->engine, &time);
    *steps = result.steps;
    if (result.status == PHYS_NO_MEMORY)
        reader_report(reader, "physics-memory", "",
                      STR("out of memory for the particles; the system is not simulated"));
    else if (result.status == PHYS_DROPPED_TIME)
        reader_report(reader, "step-limit", "",
                      STR("the frame needs more than 1000000 steps; the rest are skipped; use a larger 'resolution'"));
    else if (result.status == PHYS_STOPPED)
        tree->scene->stopped = budget_check(tree->scene->budget);
    else if (result.status == PHYS_OK)
        physics_report_divergence(tree, reader, result.clock,
                                  fmin(time.resolution, time.now - time.last) / fmax(1, time.parts));
    tree->out_of_memory |= result.status == PHYS_NO_MEMORY;
    mirror_store(tree, result.status == PHYS_OK || result.status == PHYS_DROPPED_TIME);
    return result.clock;
}

// Checks the forces as soon as the length of a step is known. In the first frame, in which no time has passed, it is
// known if the system follows the time of the script.
static void check_stability(PhysicsTree *tree, const Reader *reader, const SystemAttrs *settings, double last) {
    const Symbol *time = reader->schema->slots[ROW_PHYSICS_TIME].name;
    double frame = settings->time > last                   ? settings->time - last
                   : node_get(reader->node, time).len == 0 ? 1 / tree->frame->fps
                                                           : 0;
    if (frame > 0)
        physics_report_instability(tree, reader, fmin(settings->resolution, frame) / fmax(1, tree->frame->parts));
}

// Reads a tree from scratch.
static void read_tree(PhysicsTree *tree) {
    tree->scene->tree_was_read = true;
    tree->body_count = 0;
    mirror_open(tree);
    physics_read_bodies(tree);
    physics_read_forces(tree);
    mirror_remove_vanished(tree);
}

static uint64_t update_system(Scene *scene, PhysicsSystem *system, const Reader *reader, const SystemAttrs *settings,
                              const SceneFrame *frame) {
    State *state = frame->state;
    double clock = scene_number(state, system->clock, 0);
    system->had_simulated = clock > 0;
    double last = scene_number(state, system->last, settings->time);
    double iteration = floor(scene_number(state, system->iteration, -1)) + 1;
    Value stored_run = state_slot_get(state, system->run);
    if (stored_run.len > 0 && !value_equal(NULL, stored_run, value_number(settings->run))) {
        mirror_remove(&system->mirror, state);
        set_number(frame, system->start, settings->time);
        clock = 0;
        iteration = 0;
    }
    set_number(frame, system->run, settings->run);
    set_number(frame, system->iteration, iteration);
    if (isnan(scene_number(state, system->start, NAN)))
        set_number(frame, system->start, settings->time);

    PhysicsTree tree = {.scene = scene,
                        .system = system,
                        .frame = frame,
                        .root = reader->node,
                        .dimensions = reader->dimensions,
                        .prefix = settings->state,
                        .engine = system->engine,
                        .from_state = iteration > 0,
                        .run = settings->run,
                        .iteration = iteration};
    uint64_t reports = scene->schema->report_count;
    if (iteration == 0)
        physics_lint_settings(reader, settings, frame);
    if (!physics_reuse(&tree))
        read_tree(&tree);
    bool faultless = scene->schema->report_count == reports;
    uint64_t steps = 0;
    check_stability(&tree, reader, settings, last);
    if (settings->time > last) {
        clock = simulate_system(&tree, reader, settings, last, clock, &steps);
    } else {
        tree.out_of_memory |= !phys_skip_frame(tree.engine);
        mirror_store(&tree, false);
    }
    if (!faultless)
        system->mirror.state = MIRROR_STALE; // so that the next frame reads the tree again and repeats the reports
    scene->exhausted |= tree.out_of_memory;
    physics_cache_tree(&tree);
    system->origins_frame = scene->frame_number;
    set_number(frame, system->last, settings->time);
    set_number(frame, system->clock, clock);
    return steps;
}

// Marks a skipped system as present, so that its list of particles is retained. A system that was absent has none.
static void retain_skipped(Scene *scene, Value prefix, const SceneFrame *frame) {
    uint32_t occurrence;
    StateSlot start = state_find(frame->state, prefix);
    PhysicsSystem **known = start == STATE_NO_SLOT ? NULL : known_system(scene, start, &occurrence, frame->arena);
    if (!known || (*known)->last_frame + 1 != scene->frame_number)
        return;
    PhysicsSystem *system = place_system(scene, known);
    system->last_frame = scene->frame_number;
    system->node = NULL;
}

uint64_t physics_update(Scene *scene, const Node *node, const SceneFrame *frame) {
    Reader reader = {scene->schema, frame->arena, node, KIND_PHYSICS, 1};
    SystemAttrs settings;
    if (!read_settings(scene, &reader, frame, &settings) || !fits_in_memory(&reader, &settings)) {
        retain_skipped(scene, settings.state, frame);
        if (scene->schema->lint)
            reader_report_inside(&reader);
        return 0;
    }
    reader.dimensions = (uint32_t)settings.dimensions;
    PhysicsSystem *system = find_system(scene, settings.state, frame);
    if (!system || !system->engine) {
        reader_report(&reader, "physics-memory", "", STR("out of memory; the system is skipped"));
        scene->exhausted = true;
        return 0;
    }
    if (system->occurrence == 1)
        reader_report(&reader, "duplicate-prefix", "",
                      STR("another !physics has the same attribute 'state'; give each system its own"));
    system->last_frame = scene->frame_number;
    system->node = node;
    return system->steps = update_system(scene, system, &reader, &settings, frame);
}
