// physics_slots.c: finds particles by their ids and slots, if possible without hashing.
//
// The mark of a state slot shows which particle uses the slot, in the tree that was read last. One array, indexed by
// slot, holds the marks of all systems. A mark is 2 * (base + handle) for a position, plus 1 for a velocity. Marks
// below 2 * base are outdated: they belong to earlier trees.
#include "base/heap.h"
#include "scene/systems.h"
#include "value/format.h"

#include <string.h>

Value scene_key(Arena *arena, Value prefix, Value id, const Symbol *last) {
    Vector key = vector_new(arena);
    vector_add(&key, prefix);
    vector_add(&key, id);
    if (last)
        vector_add_number(&key, last->number);
    return vector_finish(&key);
}

Value physics_key(const PhysicsTree *tree, Value id, bool velocity, double numbers[PHYSICS_KEY_NUMBERS]) {
    const Symbol *last = velocity ? tree->scene->key_velocity : NULL;
    Value prefix = tree->prefix;
    if (!value_is_numeric(prefix) || !value_is_numeric(id) || prefix.len >= PHYSICS_KEY_NUMBERS / 3 ||
        id.len >= PHYSICS_KEY_NUMBERS / 3)
        return scene_key(tree->frame->arena, prefix, id, last);
    memcpy(numbers, value_numbers(&prefix), prefix.len * sizeof *numbers);
    memcpy(numbers + prefix.len, value_numbers(&id), id.len * sizeof *numbers);
    uint32_t len = prefix.len + id.len;
    if (velocity)
        numbers[len++] = last->number;
    return value_numbers_view(numbers, len);
}

bool physics_has_id(const PhysicsTree *tree, uint32_t body, Value id) {
    double numbers[PHYSICS_KEY_NUMBERS];
    const State *state = tree->frame->state;
    StateSlot slot = tree->system->mirror.slots[2 * (size_t)body];
    if (id.len == 0)
        return false;
    if (id.len > 1 || id.kind != VALUE_NUMBERS)
        return state_slot_has_key(state, slot, physics_key(tree, id, false, numbers));
    // The prefix of a system never changes, so only the last number of the key must be compared.
    double own = state_slot_last_number(state, slot, tree->prefix.len + 1);
    return memcmp(&own, &id.as.number, sizeof own) == 0;
}

uint32_t physics_mark(const PhysicsTree *tree, StateSlot slot) {
    const Scene *scene = tree->scene;
    uint32_t mark = slot < scene->body_capacity ? scene->bodies[slot] : 0;
    return mark / 2 < scene->body_base ? 0 : mark;
}

bool physics_set_mark(const PhysicsTree *tree, StateSlot slot, uint32_t mark) {
    Scene *scene = tree->scene;
    if (slot >= scene->body_capacity) {
        uint32_t capacity = slot < 128 ? 256 : slot + slot / 2;
        uint32_t *larger = heap_resize(scene->bodies, capacity * sizeof *larger);
        if (!larger)
            return false;
        memset(larger + scene->body_capacity, 0, (capacity - scene->body_capacity) * sizeof *larger);
        scene->bodies = larger;
        scene->body_capacity = capacity;
    }
    scene->bodies[slot] = mark;
    return true;
}

void physics_clear_marks(const PhysicsTree *tree) {
    enum { MAX_BASE = 1 << 29 }; // so that base + handle does not overflow
    Scene *scene = tree->scene;
    scene->marked_system = NULL;
    scene->body_base += scene->body_count + 1;
    scene->body_count = 0;
    if (scene->body_base < MAX_BASE)
        return;
    if (scene->bodies)
        memset(scene->bodies, 0, scene->body_capacity * sizeof *scene->bodies);
    scene->body_base = 1;
}

int64_t physics_find_slot(const PhysicsTree *tree, StateSlot slot) {
    uint32_t mark = physics_mark(tree, slot);
    return mark && mark % 2 == 0 ? (int64_t)(mark / 2 - tree->scene->body_base) : PHYSICS_NO_BODY;
}

void physics_free_marks(const PhysicsTree *tree) {
    enum { MIN_FREED_CAPACITY = 1 << 16 }; // smaller arrays are not worth freeing
    Scene *scene = tree->scene;
    if (!tree->root->program_lifetime_children || scene->body_capacity < MIN_FREED_CAPACITY)
        return;
    physics_clear_marks(tree);
    heap_free(scene->bodies);
    scene->bodies = NULL;
    scene->body_capacity = 0;
}

// Marks the slots of the tree again if another tree has been read since they were marked.
static void rebuild_marks(PhysicsTree *tree) {
    const PhysicsSystem *system = tree->system;
    if (tree->scene->marked_system == system)
        return;
    physics_clear_marks(tree);
    tree->scene->body_count = tree->body_count;
    for (uint32_t i = 0; i < system->mirror.slot_count; i++)
        if (!physics_set_mark(tree, system->mirror.slots[i], 2 * (tree->scene->body_base + i / 2) + i % 2))
            tree->out_of_memory = true;
    tree->scene->marked_system = system;
}

int64_t physics_find_body(PhysicsTree *tree, Value id) {
    double numbers[PHYSICS_KEY_NUMBERS];
    if (id.len == 0)
        return PHYSICS_NO_BODY;
    rebuild_marks(tree);
    StateSlot slot = state_find(tree->frame->state, physics_key(tree, id, false, numbers));
    return slot == STATE_NO_SLOT ? PHYSICS_NO_BODY : physics_find_slot(tree, slot);
}

void physics_own_slots(PhysicsSystem *system, StateSlot *slots[PHYSICS_OWN_SLOTS]) {
    StateSlot *const all[PHYSICS_OWN_SLOTS] = {&system->start, &system->run, &system->iteration, &system->clock,
                                               &system->last};
    memcpy(slots, all, sizeof all);
}

// Returns the first slot of a system that another system owns, and enters all others in `owners`, by slot. Returns
// STATE_NO_SLOT if there is none.
static StateSlot enter_slots(PhysicsSystem *system, PhysicsSystem **owners) {
    StateSlot *own[PHYSICS_OWN_SLOTS], shared = STATE_NO_SLOT;
    physics_own_slots(system, own);
    for (uint32_t i = 0; i < PHYSICS_OWN_SLOTS + system->mirror.slot_count; i++) {
        StateSlot slot = i < PHYSICS_OWN_SLOTS ? *own[i] : system->mirror.slots[i - PHYSICS_OWN_SLOTS];
        if (slot == STATE_NO_SLOT) // out of memory
            continue;
        if (owners[slot] && owners[slot] != system && shared == STATE_NO_SLOT)
            shared = slot;
        if (!owners[slot])
            owners[slot] = system;
    }
    return shared;
}

// Reports a key that two systems share.
static void report_shared_key(Scene *scene, PhysicsSystem *system, StateSlot slot, const SceneFrame *frame) {
    const Reader reader = {scene->schema, frame->arena, system->node, KIND_PHYSICS, 1};
    Text text = text_new(frame->arena);
    text_add_c(&text, "another !physics also stores the key $(");
    format_value(&text, scene->schema->symbols, state_slot_key(frame->state, slot));
    text_add_c(&text, "); use another 'state'");
    reader_report(&reader, "colliding-keys", "", text_str(&text));
}

void physics_report_shared_keys(Scene *scene, const SceneFrame *frame) {
    uint32_t count = state_slot_count(frame->state), length = 0;
    bool possible = false; // only if one prefix begins with another, which is shorter
    for (PhysicsSystem *system = scene->systems; system && scene->tree_was_read; system = system->next) {
        uint32_t len = state_slot_key(frame->state, system->start).len;
        possible |= length > 0 && len != length;
        length = len;
    }
    if (!possible)
        return;
    arena_charge(frame->arena, count);
    PhysicsSystem **owners = arena_alloc_array(frame->arena, count, sizeof *owners);
    memset(owners, 0, count * sizeof *owners);
    for (PhysicsSystem *system = scene->systems; system; system = system->next) {
        if (system->last_frame != scene->frame_number || system->occurrence > 0 || !system->node)
            continue;
        StateSlot shared = enter_slots(system, owners);
        if (shared == STATE_NO_SLOT)
            continue;
        report_shared_key(scene, system, shared, frame);
        // So that the next frame reads the trees again and repeats the report.
        system->mirror.state = owners[shared]->mirror.state = MIRROR_STALE;
    }
}
