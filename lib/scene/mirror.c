// mirror.c: implementation of mirror.h (spec physics.md section 2, steps 5 and 6).
//
// Order in a frame: mirror_reuse, or else mirror_open, mirror_add for each body and mirror_remove_vanished. After the
// simulation, mirror_store puts rows and entries in sync.
#include "scene/mirror.h"

#include "base/heap.h"
#include "base/number.h"
#include "scene/systems.h"

#include <string.h>

void mirror_free(Mirror *mirror) {
    heap_free(mirror->slots);
    heap_free(mirror->last_slots);
    heap_free(mirror->anchors);
    heap_free(mirror->ids);
}

bool mirror_restore(Mirror *mirror, const StateSlot *slots, uint32_t count) {
    if (!heap_reserve((void **)&mirror->slots, &mirror->slot_capacity, count, sizeof *slots))
        return false;
    if (count)
        memcpy(mirror->slots, slots, count * sizeof *slots);
    mirror->slot_count = count;
    return true;
}

static void detach_entries(const Mirror *mirror, State *state, const StateSlot *slots, uint32_t count) {
    for (uint32_t i = 0; mirror->owner && i < count; i++)
        state_slot_detach(state, slots[i], mirror->owner);
}

static void detach_all(const Mirror *mirror, State *state) {
    detach_entries(mirror, state, mirror->slots, mirror->slot_count);
    detach_entries(mirror, state, mirror->last_slots, mirror->last_count);
}

void mirror_leave(Mirror *mirror, State *state) {
    detach_all(mirror, state);
    mirror->slot_count = 0;
    mirror->state = MIRROR_STALE;
}

void mirror_remove(Mirror *mirror, State *state) {
    for (uint32_t i = 0; i < mirror->slot_count; i++)
        state_slot_set(state, mirror->slots[i], VALUE_NULL);
    mirror->slot_count = 0;
    if (mirror->state == MIRROR_CURRENT)
        mirror->state = MIRROR_STALE;
}

void mirror_open(PhysicsTree *tree) {
    State *state = tree->frame->state;
    Mirror *mirror = &tree->system->mirror, before = *mirror;
    if (!mirror->owner)
        mirror->owner = state_add_owner(state);
    if (mirror->state == MIRROR_OPEN) {
        detach_all(mirror, state);
    } else {
        mirror->slots = before.last_slots;
        mirror->slot_capacity = before.last_capacity;
        mirror->last_slots = before.slots;
        mirror->last_count = before.slot_count;
        mirror->last_capacity = before.slot_capacity;
    }
    mirror->slot_count = mirror->anchor_count = 0;
    mirror->ids_cached = false;
    mirror->state = MIRROR_OPEN;
    phys_begin(tree->engine, tree->dimensions);
}

bool mirror_add(PhysicsTree *tree, StateSlot position, StateSlot velocity, bool anchor) {
    Mirror *mirror = &tree->system->mirror;
    uint32_t count = 2 * tree->body_count;
    if (!heap_reserve((void **)&mirror->slots, &mirror->slot_capacity, count + 1, sizeof *mirror->slots) ||
        !heap_reserve((void **)&mirror->anchors, &mirror->anchor_capacity, mirror->anchor_count,
                      sizeof *mirror->anchors))
        return false;
    if (anchor)
        mirror->anchors[mirror->anchor_count++] = tree->body_count;
    mirror->slots[count] = position;
    mirror->slots[count + 1] = velocity;
    return true;
}

PhysVector mirror_start(const PhysicsTree *tree, StateSlot slot, PhysVector attribute, double *single,
                        bool *from_attribute) {
    Value stored = tree->from_state ? state_slot_get(tree->frame->state, slot) : VALUE_NULL;
    *from_attribute = stored.kind != VALUE_NUMBERS || stored.len != tree->dimensions;
    if (*from_attribute)
        return attribute;
    *single = stored.as.number;
    return stored.len == 1 ? single : stored.as.numbers;
}

void mirror_remove_vanished(const PhysicsTree *tree) {
    const Mirror *mirror = &tree->system->mirror;
    for (uint32_t i = 0; i < mirror->last_count; i++)
        if (!physics_mark(tree, mirror->last_slots[i]))
            state_slot_set(tree->frame->state, mirror->last_slots[i], VALUE_NULL);
}

// Returns true if the entry is missing. Otherwise returns false, and sets *in_sync to false if the entry differs from
// the row.
static bool is_missing(const PhysicsTree *tree, StateSlot slot, const double *row, bool *in_sync) {
    const State *state = tree->frame->state;
    Value v = state_slot_get(state, slot);
    if (v.len == 0)
        return true;
    if (tree->dimensions > 1)
        *in_sync = *in_sync && state_slot_references(state, slot, tree->system->mirror.owner);
    else
        *in_sync = *in_sync && value_is_number(v) && !memcmp(&v.as.number, row, sizeof *row);
    return false;
}

// Some writes to the state do not mark the owner as modified: those that create an entry that was missing and, in one
// dimension, those that change an entry. Returns true if there were none of these.
static bool unreferenced_in_sync(const PhysicsTree *tree) {
    const Mirror *mirror = &tree->system->mirror;
    if (tree->dimensions > 1 && mirror->missing == 0)
        return true;
    uint32_t missing = 0;
    bool in_sync = true;
    for (uint32_t i = 0; in_sync && i < mirror->slot_count / 2; i++) {
        if (phys_is_anchor(tree->engine, i))
            continue;
        const StateSlot *slots = mirror->slots + 2 * (size_t)i;
        missing += is_missing(tree, slots[0], phys_position(tree->engine, i), &in_sync);
        missing += is_missing(tree, slots[1], phys_velocity(tree->engine, i), &in_sync);
    }
    return in_sync && missing == mirror->missing;
}

bool mirror_reuse(PhysicsTree *tree) {
    Mirror *mirror = &tree->system->mirror;
    bool modified = mirror->owner && state_clear_modified(tree->frame->state, mirror->owner);
    if (mirror->state != MIRROR_CURRENT || modified || !tree->from_state ||
        tree->system->dimensions != tree->dimensions || !unreferenced_in_sync(tree))
        return false;
    mirror->state = MIRROR_STALE;
    return true;
}

PhysPreserve mirror_preserve(const PhysicsTree *tree, uint32_t body) {
    const StateSlot *slots = tree->system->mirror.slots + 2 * (size_t)body;
    const State *state = tree->frame->state;
    return (PhysPreserve){state_slot_get(state, slots[0]).len > 0, state_slot_get(state, slots[1]).len > 0};
}

bool mirror_can_lend(const PhysicsTree *tree) {
    return !tree->keys_collide && !tree->out_of_memory && (tree->system->mirror.owner || tree->dimensions == 1) &&
           phys_particle_count(tree->engine) == tree->body_count;
}

static void copy_body(const PhysicsTree *tree, uint32_t body) {
    uint32_t n = tree->dimensions;
    const StateSlot *slots = tree->system->mirror.slots + 2 * (size_t)body;
    const double *rows[] = {phys_position(tree->engine, body), phys_velocity(tree->engine, body)};
    for (int i = 0; i < 2; i++)
        if (rows[i] && numbers_finite(rows[i], n, 1))
            state_slot_set(tree->frame->state, slots[i], value_numbers_view(rows[i], n));
}

// Detaches the entries of anchors. If an anchor was a particle in the last frame, its entries still reference rows.
// Stores copies if `store` is set.
static void copy_anchors(const PhysicsTree *tree, bool store) {
    const Mirror *mirror = &tree->system->mirror;
    for (uint32_t i = 0; i < mirror->anchor_count; i++) {
        detach_entries(mirror, tree->frame->state, mirror->slots + 2 * (size_t)mirror->anchors[i], 2);
        if (store)
            copy_body(tree, mirror->anchors[i]);
    }
}

// Makes an entry reference its row. The row holds a finite result if `result` is set, else the vector with which the
// frame started. Returns false if entry and row are not in sync afterwards.
static bool lend_entry(const PhysicsTree *tree, StateSlot slot, const double *row, bool result) {
    Mirror *mirror = &tree->system->mirror;
    State *state = tree->frame->state;
    uint32_t n = tree->dimensions;
    Value stored = state_slot_get(state, slot);
    if (!result && stored.len == 0) {
        mirror->missing++;
        return true;
    }
    // If from_state is false, the run started with the values of attributes instead of the stored values.
    bool same_source = stored.len == 0 || tree->from_state;
    bool in_sync = same_source && (result || (stored.kind == VALUE_NUMBERS && stored.len == n));
    if (n > 1 && in_sync) {
        state_slot_reference(state, slot, mirror->owner, row, n);
        return true;
    }
    state_slot_detach(state, slot, mirror->owner);
    if (result)
        state_slot_set(state, slot, value_numbers_view(row, n));
    return in_sync;
}

static bool lend_bodies(PhysicsTree *tree, bool simulated) {
    const PhysSystem *engine = tree->engine;
    bool in_sync = true;
    tree->system->mirror.missing = 0;
    for (uint32_t i = 0; i < tree->body_count; i++) {
        if (phys_is_anchor(engine, i))
            continue;
        const StateSlot *slots = tree->system->mirror.slots + 2 * (size_t)i;
        in_sync &= lend_entry(tree, slots[0], phys_position(engine, i), simulated && phys_position_finite(engine, i));
        in_sync &= lend_entry(tree, slots[1], phys_velocity(engine, i), simulated && phys_velocity_finite(engine, i));
    }
    return in_sync;
}

// Gives copies to entries that still reference rows of the previous description. If `referenced` is true, leaves out
// the entries of the new tree, because they already reference the new description.
static void close_last(PhysicsTree *tree, bool referenced) {
    Mirror *mirror = &tree->system->mirror;
    State *state = tree->frame->state;
    for (uint32_t i = 0; mirror->owner && i < mirror->last_count; i++)
        if (!referenced || !physics_mark(tree, mirror->last_slots[i]))
            state_slot_detach(state, mirror->last_slots[i], mirror->owner);
    if (mirror->owner)
        state_clear_modified(state, mirror->owner); // set by the mirror's own writes
    mirror->last_count = 0;
    physics_free_marks(tree);
}

void mirror_store(PhysicsTree *tree, bool simulated) {
    Mirror *mirror = &tree->system->mirror;
    bool rebuilt = mirror->state == MIRROR_OPEN, can_lend = mirror_can_lend(tree), in_sync = can_lend;
    // In the recorded conformance cases, anchors of a system without particles are not stored until time passes.
    bool anchors = simulated || tree->body_count > mirror->anchor_count;
    if (!can_lend && simulated) {
        for (uint32_t i = 0; i < tree->body_count; i++)
            copy_body(tree, i);
    } else {
        copy_anchors(tree, anchors);
        if (can_lend && (rebuilt || (simulated && (mirror->missing || tree->dimensions == 1))))
            in_sync = lend_bodies(tree, simulated);
    }
    if (rebuilt)
        close_last(tree, can_lend);
    mirror->state = in_sync ? MIRROR_CURRENT : MIRROR_STALE;
}
