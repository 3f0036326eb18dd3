// physics_bind.c: one frame of a `!physics` system, between tree, state and engine (spec physics.md section 2).
#include "scene/systems.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

Value scene_key(Arena *arena, Value prefix, Value id, const Symbol *last) {
    Vector key = vector_new(arena);
    vector_add(&key, prefix);
    vector_add(&key, id);
    if (last)
        vector_add_number(&key, last->number);
    return vector_finish(&key);
}

double scene_number(const State *state, StateSlot slot, double fallback) {
    Value v = state_slot_get(state, slot);
    return v.kind == VALUE_NUMBERS && v.len == 1 ? v.as.number : fallback;
}

// The system of a prefix that has not been updated in this frame, or NULL; *occurrence counts those that have.
static PhysicsSystem *known_system(const Scene *scene, StateSlot start, uint32_t *occurrence) {
    *occurrence = 0;
    for (PhysicsSystem *system = scene->systems; system; system = system->next) {
        if (system->start != start)
            continue;
        if (system->seen != scene->frame_number)
            return system;
        ++*occurrence;
    }
    return NULL;
}

static PhysicsSystem *new_system(Scene *scene, StateSlot start, uint32_t occurrence, const SceneFrame *frame) {
    PhysicsSystem *system = calloc(1, sizeof *system);
    if (!system)
        return NULL;
    PhysicsSystem **end = &scene->systems;
    while (*end)
        end = &(*end)->next;
    *end = system;
    Value prefix = state_slot_key(frame->state, start);
    *system = (PhysicsSystem){
        .start = start,
        .occurrence = occurrence,
        .seen = scene->frame_number - 1,
        .run = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_run)),
        .iteration = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_iteration)),
        .clock = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_clock)),
        .last = state_slot(frame->state, scene_key(frame->arena, prefix, VALUE_NULL, scene->key_last)),
        .engine = phys_new(),
    };
    if (system->engine)
        phys_set_options(system->engine, &scene->physics);
    return system;
}

// The record of the system with this prefix, made if it is new; NULL if memory is used up.
static PhysicsSystem *find_system(Scene *scene, Value prefix, const SceneFrame *frame) {
    StateSlot start = state_slot(frame->state, prefix);
    if (start == STATE_NO_SLOT)
        return NULL;
    uint32_t occurrence;
    PhysicsSystem *system = known_system(scene, start, &occurrence);
    if (!system)
        return new_system(scene, start, occurrence, frame);
    if (system->seen + 1 != scene->frame_number)
        system->slot_count = 0; // it was absent: its keys stay, and it has no last tree
    return system;
}

// Keeps a copy of the slots of a tree's particles.
static bool keep_slots(PhysicsSystem *system, const StateSlot *slots, uint32_t count) {
    system->slot_count = 0;
    if (system->slot_capacity < count) {
        StateSlot *larger = realloc(system->slots, count * sizeof *larger);
        if (!larger)
            return false;
        system->slots = larger;
        system->slot_capacity = count;
    }
    if (count)
        memcpy(system->slots, slots, count * sizeof *slots);
    system->slot_count = count;
    return true;
}

bool scene_next_system(const Scene *scene, const void **cursor, SceneSystem *saved) {
    const PhysicsSystem *system = *cursor ? ((const PhysicsSystem *)*cursor)->next : scene->systems;
    if (!system)
        return false;
    *cursor = system;
    bool absent = system->seen != scene->frame_number; // then it has no last tree
    *saved = (SceneSystem){system->start, system->occurrence, system->slots, absent ? 0 : system->slot_count};
    return true;
}

bool scene_restore_system(Scene *scene, const SceneSystem *saved, const SceneFrame *frame) {
    PhysicsSystem *system = new_system(scene, saved->prefix, saved->occurrence, frame);
    if (!system || !keep_slots(system, saved->slots, saved->slot_count))
        return false;
    system->seen = scene->frame_number; // the next update is that of the frame after
    return true;
}

static void set_number(const SceneFrame *frame, StateSlot slot, double x) {
    state_slot_set(frame->state, slot, value_number(x));
}

// Removes the position and velocity keys of the last frame's particles.
static void forget_particles(PhysicsSystem *system, const SceneFrame *frame) {
    for (uint32_t i = 0; i < system->slot_count; i++)
        state_slot_set(frame->state, system->slots[i], VALUE_NULL);
    system->slot_count = 0;
}

// Removes the keys of particles that were in the last frame's tree and are not in this one's, and remembers this one's.
static void remember_particles(PhysicsSystem *system, const PhysicsTree *tree) {
    uint32_t count = 2 * tree->body_count;
    bool same = system->slot_count == count;
    for (uint32_t i = 0; same && i < tree->body_count; i++)
        same = system->slots[2 * i] == tree->bodies[i].position;
    if (same)
        return;
    for (uint32_t i = 0; i < system->slot_count; i += 2)
        if (!physics_find_slot(tree, system->slots[i])) {
            state_slot_set(tree->frame->state, system->slots[i], VALUE_NULL);
            state_slot_set(tree->frame->state, system->slots[i + 1], VALUE_NULL);
        }
    StateSlot *slots = arena_alloc_array(tree->frame->arena, count, sizeof *slots);
    for (uint32_t i = 0; i < tree->body_count; i++) {
        slots[2 * i] = tree->bodies[i].position;
        slots[2 * i + 1] = tree->bodies[i].velocity;
    }
    keep_slots(system, slots, count);
}

static bool all_finite(const double *numbers, uint32_t n) {
    for (uint32_t k = 0; k < n; k++)
        if (!isfinite(numbers[k]))
            return false;
    return true;
}

static void store(const PhysicsTree *tree, bool simulated) {
    uint32_t n = tree->dimensions;
    for (uint32_t i = 0; i < tree->body_count; i++) {
        const Body *body = &tree->bodies[i];
        if (!simulated && !body->anchor)
            continue;
        const double *position = phys_position(tree->engine, body->handle);
        const double *velocity = phys_velocity(tree->engine, body->handle);
        if (all_finite(position, n))
            state_slot_set(tree->frame->state, body->position, value_numbers_view(position, n));
        if (all_finite(velocity, n))
            state_slot_set(tree->frame->state, body->velocity, value_numbers_view(velocity, n));
    }
}

// The system's own attributes.
typedef struct Settings {
    double dimensions;
    double time;
    double resolution;
    double run;
    double speed_of_light;
} Settings;

static bool read_settings(const Reader *reader, const SceneFrame *frame, Settings *settings) {
    *settings = (Settings){
        .dimensions = floor(attr_float(reader, ROW_PHYSICS_DIMENSIONS)),
        .time = attr_time(reader, ROW_PHYSICS_TIME, frame->time),
        .resolution = attr_float_or(reader, ROW_PHYSICS_RESOLUTION, 1 / frame->fps),
        .run = floor(attr_float(reader, ROW_PHYSICS_RUN)),
        .speed_of_light = attr_float(reader, ROW_PHYSICS_SPEED_OF_LIGHT),
    };
    if (frame->resolution > 0)
        settings->resolution = frame->resolution;
    if (!isfinite(settings->run))
        settings->run = 0;
    Value prefix = attr_value(reader, ROW_PHYSICS_STATE);
    const char *why = NULL;
    if (prefix.len == 0)
        why = "no state prefix; the system is skipped";
    else if (!state_key_valid(prefix))
        why = "state cannot be a key; the system is skipped";
    else if (!(settings->dimensions >= 1))
        why = "dimensions must be at least 1; the system is skipped";
    else if (settings->dimensions > 1e9)
        why = "dimensions beyond 1000000000; the system is skipped";
    else if (!isfinite(settings->time))
        why = "time is not finite; the system is skipped";
    else if (!(settings->resolution > 0) || !isfinite(settings->resolution))
        why = "resolution must be above 0 and finite; the system is skipped";
    if (why)
        reader_report(reader, "skipped-system", "", str_from(why));
    return !why;
}

// Number of nodes below, up to a limit: decides whether vectors of so many dimensions can be held at all.
static uint64_t count_nodes(const Node *node) {
    uint64_t count = node->child_count;
    for (uint32_t i = 0; i < node->child_count; i++)
        count += count_nodes(node->children[i]);
    return count;
}

static bool fits_in_memory(const Reader *reader, const Settings *settings) {
    enum { FEW = 64, COPIES = 16 };
    if (settings->dimensions <= FEW)
        return true;
    double bytes = settings->dimensions * sizeof(double) * COPIES * (double)(count_nodes(reader->node) + 1);
    if (bytes <= (double)(UINT64_C(1) << 30))
        return true;
    reader_report(reader, "skipped-system", "",
                  STR("too many dimensions for so many nodes (limit 1 GiB); the system is skipped"));
    return false;
}

// Step 6: simulates up to `settings->time`; returns the clock afterwards.
static double simulate(const PhysicsTree *tree, const Reader *reader, const Settings *settings, double last,
                       double clock, uint64_t *steps) {
    PhysTime time = {.last = last,
                     .now = settings->time,
                     .clock = clock,
                     .resolution = settings->resolution,
                     .lockstep = tree->frame->lockstep,
                     .performance = tree->frame->performance,
                     .speed_of_light = settings->speed_of_light,
                     .interrupt = tree->frame->interrupt};
    PhysResult result = phys_simulate(tree->engine, &time);
    *steps = result.steps;
    if (result.status == PHYS_NO_MEMORY)
        reader_report(reader, "physics-memory", "",
                      STR("not enough memory for the system's particles; nothing is simulated"));
    else if (result.status == PHYS_DROPPED_TIME)
        reader_report(reader, "dropped-time", "",
                      STR("more steps in one frame than can be made (limit 1000000); the rest is dropped"));
    store(tree, result.status != PHYS_NO_MEMORY);
    return result.status == PHYS_NO_MEMORY ? clock : result.clock;
}

static uint64_t update(Scene *scene, PhysicsSystem *system, const Reader *reader, const Settings *settings,
                       const SceneFrame *frame) {
    State *state = frame->state;
    double clock = scene_number(state, system->clock, 0);
    double last = scene_number(state, system->last, settings->time);
    double iteration = floor(scene_number(state, system->iteration, -1)) + 1;
    Value stored_run = state_slot_get(state, system->run);
    if (stored_run.len > 0 && !value_equal(stored_run, value_number(settings->run))) {
        forget_particles(system, frame);
        set_number(frame, system->start, settings->time);
        clock = 0;
        iteration = 0;
    }
    set_number(frame, system->run, settings->run);
    set_number(frame, system->iteration, iteration);
    if (isnan(scene_number(state, system->start, NAN)))
        set_number(frame, system->start, settings->time);

    PhysicsTree tree = {.scene = scene,
                        .frame = frame,
                        .root = reader->node,
                        .dimensions = reader->dimensions,
                        .prefix = attr_value(reader, ROW_PHYSICS_STATE),
                        .engine = system->engine,
                        .from_state = iteration > 0,
                        .run = settings->run,
                        .iteration = iteration};
    phys_begin(tree.engine, tree.dimensions);
    physics_read_bodies(&tree);
    physics_read_forces(&tree);
    remember_particles(system, &tree);
    uint64_t steps = 0;
    if (settings->time > last)
        clock = simulate(&tree, reader, settings, last, clock, &steps);
    else if (tree.particle_count > 0)
        store(&tree, false); // anchors; the recorded language cases leave out those of a system without particles
    set_number(frame, system->last, settings->time);
    set_number(frame, system->clock, clock);
    index_free(&tree.by_slot);
    return steps;
}

// A system that is skipped in a frame is not absent: it keeps its list of particles.
static void keep_skipped(Scene *scene, Value prefix, const SceneFrame *frame) {
    uint32_t occurrence;
    StateSlot start = state_find(frame->state, prefix);
    PhysicsSystem *system = start == STATE_NO_SLOT ? NULL : known_system(scene, start, &occurrence);
    if (system)
        system->seen = scene->frame_number;
}

uint64_t physics_update(Scene *scene, const Node *node, const SceneFrame *frame) {
    Reader reader = {&scene->schema, frame->arena, node, 1};
    Settings settings;
    reader_check_names(&reader, KIND_PHYSICS);
    if (!read_settings(&reader, frame, &settings) || !fits_in_memory(&reader, &settings)) {
        keep_skipped(scene, attr_value(&reader, ROW_PHYSICS_STATE), frame);
        return 0;
    }
    reader.dimensions = (uint32_t)settings.dimensions;
    PhysicsSystem *system = find_system(scene, attr_value(&reader, ROW_PHYSICS_STATE), frame);
    if (!system || !system->engine) {
        reader_report(&reader, "physics-memory", "", STR("not enough memory; the system is skipped"));
        return 0;
    }
    if (system->occurrence > 0)
        reader_report(&reader, "shared-prefix", "", STR("another system has the same state prefix"));
    system->seen = scene->frame_number;
    system->dimensions = reader.dimensions;
    return system->steps = update(scene, system, &reader, &settings, frame);
}
