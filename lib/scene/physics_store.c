// physics_store.c: what the state has of a system's particles (spec physics.md section 2, steps 5 and 6).
//
// A position or velocity that is finite after a frame is stored, unless it equals what is stored. The engine keeps
// that rule itself (PhysTime.settle), so that an entry of two numbers or more can show the engine's own.
#include "scene/systems.h"

#include <math.h>

// Keeps copies of what entries show, unless they belong to the tree that was read last.
static void settle_slots(const PhysicsTree *tree, const PhysicsSystem *system, State *state, const StateSlot *slots,
                         uint32_t count) {
    for (uint32_t i = 0; system->lender && i < count; i++)
        if (!tree || !physics_has_slot(tree, slots[i]))
            state_slot_own_copy(state, slots[i], system->lender);
}

void physics_store_settle(PhysicsSystem *system, State *state) {
    settle_slots(NULL, system, state, system->slots, system->slot_count);
    settle_slots(NULL, system, state, system->old_slots, system->old_count);
    system->described = false;
}

static void swap_lists(PhysicsSystem *system) {
    StateSlot *slots = system->slots;
    uint32_t capacity = system->slot_capacity;
    system->old_count = system->slot_count;
    system->slots = system->old_slots;
    system->slot_capacity = system->old_capacity;
    system->old_slots = slots;
    system->old_capacity = capacity;
    system->slot_count = 0;
}

bool physics_can_show(const PhysicsTree *tree) {
    return !tree->shared && !tree->failed && (tree->system->lender || tree->dimensions == 1) &&
           phys_particle_count(tree->engine) == tree->body_count;
}

void physics_store_begin(PhysicsTree *tree) {
    PhysicsSystem *system = tree->system;
    if (system->open) // the last description broke off
        physics_store_settle(system, tree->frame->state);
    if (!system->lender)
        system->lender = state_add_lender(tree->frame->state);
    swap_lists(system);
    system->described = false;
    system->open = true;
    phys_begin(tree->engine, tree->dimensions);
}

static bool all_finite(const double *numbers, uint32_t n) {
    for (uint32_t k = 0; k < n; k++)
        if (!isfinite(numbers[k]))
            return false;
    return true;
}

// Stores copies of a particle's numbers.
static void copy_body(const PhysicsTree *tree, uint32_t body) {
    uint32_t n = tree->dimensions;
    const StateSlot *slots = tree->system->slots + 2 * (size_t)body;
    const double *numbers[] = {phys_position(tree->engine, body), phys_velocity(tree->engine, body)};
    for (int i = 0; i < 2; i++)
        if (numbers[i] && all_finite(numbers[i], n))
            state_slot_set(tree->frame->state, slots[i], value_numbers_view(numbers[i], n));
}

// An anchor is where its attribute says, while the state keeps what equals that: copies, for they are few. Where it was
// a particle in the last frame the entry may still show that, whether it is stored anew or not.
static void copy_anchors(const PhysicsTree *tree, bool store) {
    PhysicsSystem *system = tree->system;
    for (uint32_t i = 0; i < system->anchor_count; i++) {
        const StateSlot *slots = system->slots + 2 * (size_t)system->anchors[i];
        settle_slots(NULL, system, tree->frame->state, slots, 2);
        if (store)
            copy_body(tree, system->anchors[i]);
    }
}

// Lets an entry show the engine's numbers, if there is a result or they came from here. `fresh`: there is a result.
static void show(const PhysicsTree *tree, StateSlot slot, const double *numbers, bool fresh) {
    PhysicsSystem *system = tree->system;
    State *state = tree->frame->state;
    uint32_t n = tree->dimensions;
    Value stored = state_slot_get(state, slot);
    bool ours = stored.len == 0 || tree->from_state; // else the run began with other numbers than it has
    bool alike = stored.kind == VALUE_NUMBERS && stored.len == n;
    if (!fresh && stored.len == 0) {
        system->absent++;
    } else if (n > 1 && ours && (fresh || alike)) {
        state_slot_borrow(state, slot, system->lender, numbers, n);
    } else {
        state_slot_own_copy(state, slot, system->lender);
        if (fresh)
            state_slot_set(state, slot, value_numbers_view(numbers, n));
        system->described &= ours && (fresh || alike);
    }
}

static void show_bodies(PhysicsTree *tree, bool simulated) {
    PhysicsSystem *system = tree->system;
    uint32_t anchor = 0;
    system->absent = 0;
    for (uint32_t i = 0; i < tree->body_count; i++) {
        if (anchor < system->anchor_count && system->anchors[anchor] == i) {
            anchor++;
            continue;
        }
        const StateSlot *slots = system->slots + 2 * (size_t)i;
        show(tree, slots[0], phys_position(tree->engine, i), simulated && phys_position_finite(tree->engine, i));
        show(tree, slots[1], phys_velocity(tree->engine, i), simulated && phys_velocity_finite(tree->engine, i));
    }
}

// Where two keys are one, each particle is stored after the other, in order.
static void copy_bodies(const PhysicsTree *tree) {
    for (uint32_t i = 0; i < tree->body_count; i++)
        copy_body(tree, i);
}

void physics_store_remove_vanished(const PhysicsTree *tree) {
    const PhysicsSystem *system = tree->system;
    for (uint32_t i = 0; i < system->old_count; i += 2)
        if (!physics_has_position(tree, system->old_slots[i])) {
            state_slot_set(tree->frame->state, system->old_slots[i], VALUE_NULL);
            state_slot_set(tree->frame->state, system->old_slots[i + 1], VALUE_NULL);
        }
}

// What entries showed of the description before this one they keep, or show here.
static void finish_description(PhysicsTree *tree, bool shown) {
    PhysicsSystem *system = tree->system;
    State *state = tree->frame->state;
    settle_slots(shown ? tree : NULL, system, state, system->old_slots, system->old_count);
    if (system->lender)
        state_take_disturbed(state, system->lender); // by none but itself
    system->old_count = 0;
    system->open = false;
    physics_forget_slots(tree);
}

void physics_store(PhysicsTree *tree, bool simulated) {
    PhysicsSystem *system = tree->system;
    bool anew = system->open, shown = physics_can_show(tree);
    // The recorded language cases leave out the anchors of a system without particles as long as no time passes.
    bool anchors = simulated || tree->body_count > system->anchor_count;
    if (anew)
        system->described = shown;
    if (!shown && simulated) {
        copy_bodies(tree);
    } else {
        copy_anchors(tree, anchors);
        if (shown && (anew || (simulated && (system->absent || tree->dimensions == 1))))
            show_bodies(tree, simulated);
    }
    if (anew)
        finish_description(tree, shown);
    system->dimensions = tree->dimensions;
    system->generation = tree->frame->generation;
    system->children = tree->root->program_lifetime_children ? tree->root->children : NULL;
    system->child_count = tree->root->child_count;
}
