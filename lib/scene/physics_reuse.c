// physics_reuse.c: the next frame of a system whose tree is the last frame's, or has the same particles with other
// numbers.
//
// What the engine holds need not be read again as long as the state shows it (systems.h). Children that are kept are
// the same if their address is. Others are gone through: a kept particle is the same if its address is; any other is
// the same particle if its id and group are those of the particle that stood here in the last frame.
#include "scene/systems.h"

#include <string.h>

// Does the state have a position or velocity of the particle? *same: what it has is what the engine has.
static bool stored(const PhysicsTree *tree, StateSlot slot, const double *numbers, bool *same) {
    const State *state = tree->frame->state;
    Value v = state_slot_get(state, slot);
    if (v.len == 0)
        return false;
    if (tree->dimensions > 1)
        *same = *same && state_slot_borrows(state, slot, tree->system->lender);
    else
        *same = *same && v.len == 1 && v.kind == VALUE_NUMBERS && !memcmp(&v.as.number, numbers, sizeof *numbers);
    return true;
}

// Entries that are not there yet, and single numbers, which the state holds itself, may have been written by others.
static bool entries_agree(const PhysicsTree *tree) {
    const PhysicsSystem *system = tree->system;
    if (tree->dimensions > 1 && system->absent == 0)
        return true;
    uint32_t absent = 0, anchor = 0;
    bool same = true;
    for (uint32_t i = 0; same && i < system->slot_count / 2; i++) {
        if (anchor < system->anchor_count && system->anchors[anchor] == i) {
            anchor++;
            continue;
        }
        const StateSlot *slots = system->slots + 2 * (size_t)i;
        absent += !stored(tree, slots[0], phys_position(tree->engine, i), &same);
        absent += !stored(tree, slots[1], phys_velocity(tree->engine, i), &same);
    }
    return same && absent == system->absent;
}

static bool is_anchor(PhysicsTree *tree, uint32_t body) {
    const PhysicsSystem *system = tree->system;
    bool anchor = tree->next_anchor < system->anchor_count && system->anchors[tree->next_anchor] == body;
    tree->next_anchor += anchor;
    return anchor;
}

// Takes the numbers of the next particle. False if it is not the one that was here in the last frame.
__attribute__((noinline)) static bool reuse_body(PhysicsTree *tree, const Node *node, bool anchor, uint32_t group) {
    PhysicsSystem *system = tree->system;
    uint32_t body = tree->body_count++;
    if (2 * (uint64_t)body >= system->slot_count || is_anchor(tree, body) != anchor ||
        phys_particle_group(tree->engine, body) != group)
        return false;
    bool kept = node->program_lifetime && system->generation == tree->frame->generation;
    if (kept && body < system->node_count && system->nodes[body] == node)
        return true;
    BodyAttrs read;
    physics_read_particle(tree, node, anchor, &read);
    if (!physics_has_id(tree, body, read.id))
        return false;
    PhysPreserve preserve = {false, false};
    if (!anchor) {
        const StateSlot *slots = system->slots + 2 * (size_t)body;
        preserve.position = state_slot_get(tree->frame->state, slots[0]).len > 0;
        preserve.velocity = state_slot_get(tree->frame->state, slots[1]).len > 0;
        read.numbers.position_from_attribute = read.numbers.velocity_from_attribute = true; // if not preserved
    }
    phys_update_particle(tree->engine, body, &read.numbers, preserve);
    if (body < system->node_count)
        system->nodes[body] = NULL;
    physics_keep_node(tree, body, node);
    return true;
}

static bool reuse_group(PhysicsTree *tree, const Node *parent, uint32_t group) {
    for (uint32_t i = 0; i < parent->child_count; i++) {
        const Node *child = parent->children[i];
        NodeKind kind = schema_kind(tree->scene->schema, child);
        if (kind == KIND_GROUP) {
            uint32_t number = tree->next_group++;
            if (number >= phys_group_count(tree->engine) || phys_group_parent(tree->engine, number) != group ||
                !reuse_group(tree, child, number))
                return false;
        } else if ((kind == KIND_PARTICLE || kind == KIND_ANCHOR) &&
                   !reuse_body(tree, child, kind == KIND_ANCHOR, group)) {
            return false;
        }
    }
    return true;
}

static bool same_children(const PhysicsTree *tree) {
    const PhysicsSystem *system = tree->system;
    const Node *root = tree->root;
    return root->program_lifetime_children && root->children == system->children &&
           root->child_count == system->child_count && system->generation == tree->frame->generation;
}

bool physics_reuse(PhysicsTree *tree) {
    PhysicsSystem *system = tree->system;
    bool disturbed = system->lender && state_take_disturbed(tree->frame->state, system->lender);
    if (!system->described || disturbed || !tree->from_state || system->dimensions != tree->dimensions ||
        !entries_agree(tree))
        return false;
    if (same_children(tree)) {
        for (uint32_t i = 0; i < system->random_count; i++)
            phys_set_key(tree->engine, system->randoms[i].force, physics_random_key(tree, system->randoms[i].randoms));
        tree->body_count = system->slot_count / 2;
        return true;
    }
    tree->next_group = 1;
    if (!reuse_group(tree, tree->root, 0) || 2 * (uint64_t)tree->body_count != system->slot_count ||
        tree->next_group != phys_group_count(tree->engine))
        return false;
    phys_begin_forces(tree->engine);
    physics_read_forces(tree);
    return !tree->failed;
}
