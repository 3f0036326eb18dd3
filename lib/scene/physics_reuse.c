// physics_reuse.c: updates a system whose tree has the same particles as in the last frame.
//
// The engine keeps its values if they equal those in the state (mirror.h). Nodes with program lifetime (value/node.h)
// are unchanged if their address is the same. Other nodes are compared. A node is the same particle if its id and group
// equal those of the particle with the same number in the last tree.
#include "scene/systems.h"

// Updates the next particle or anchor. Returns false if the last frame's tree had a different one with this number.
// `identity` is the node that physics_cache_node stores.
__attribute__((noinline)) static bool reuse_body(PhysicsTree *tree, const Node *node, const Node *identity, bool anchor,
                                                 uint32_t group) {
    PhysicsSystem *system = tree->system;
    uint32_t body = tree->body_count++;
    if (2 * (uint64_t)body >= system->mirror.slot_count || phys_is_anchor(tree->engine, body) != anchor ||
        phys_particle_group(tree->engine, body) != group)
        return false;
    bool comparable = node->program_lifetime && system->generation == tree->frame->generation;
    if (comparable && body < system->node_count && system->nodes[body] == identity)
        return true;
    BodyAttrs read;
    physics_read_particle(tree, node, anchor, &read);
    if (!physics_has_id(tree, body, read.id))
        return false;
    PhysPreserve preserve = {false, false};
    if (!anchor) {
        preserve = mirror_preserve(tree, body);
        // These flags are ignored for values that the engine keeps.
        read.numbers.position_from_attribute = read.numbers.velocity_from_attribute = true;
    }
    physics_check_body(tree, node, anchor, &read, preserve);
    phys_update_particle(tree->engine, body, &read.numbers, preserve);
    if (body < system->node_count)
        system->nodes[body] = NULL;
    physics_cache_node(tree, body, identity, node->program_lifetime);
    return true;
}

__attribute__((noinline)) static bool reuse_run(PhysicsTree *tree, const NodeBatch *run, bool anchor, uint32_t group) {
    NodeRow row;
    node_batch_open(run, &row);
    arena_charge(tree->frame->arena, run->count);
    for (uint32_t i = 0; i < run->count; i++) {
        node_batch_row(run, i, &row);
        if (!reuse_body(tree, &row.node, node_batch_identity(run, i), anchor, group))
            return false;
    }
    return true;
}

static bool reuse_group(PhysicsTree *tree, const Node *parent, uint32_t group) {
    for (uint32_t i = 0; i < parent->child_count; i++) {
        const Node *child = parent->children[i];
        NodeKind kind = schema_kind(tree->scene->schema, child);
        arena_charge(tree->frame->arena, 1);
        if (kind == KIND_GROUP) {
            uint32_t number = tree->next_group++;
            if (number >= phys_group_count(tree->engine) || phys_group_parent(tree->engine, number) != group ||
                !reuse_group(tree, child, number))
                return false;
        } else if ((kind == KIND_PARTICLE || kind == KIND_ANCHOR) &&
                   !(child->is_batch ? reuse_run(tree, node_batch(child), kind == KIND_ANCHOR, group)
                                     : reuse_body(tree, child, child, kind == KIND_ANCHOR, group))) {
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
    if (!mirror_reuse(tree))
        return false;
    if (same_children(tree)) {
        for (uint32_t i = 0; i < system->random_count; i++)
            phys_set_key(tree->engine, system->randoms[i].force, physics_random_key(tree, system->randoms[i].randoms));
        tree->body_count = system->mirror.slot_count / 2;
        return true;
    }
    tree->next_group = 1;
    if (!reuse_group(tree, tree->root, 0) || 2 * (uint64_t)tree->body_count != system->mirror.slot_count ||
        tree->next_group != phys_group_count(tree->engine))
        return false;
    phys_begin_forces(tree->engine);
    physics_read_forces(tree);
    return !tree->out_of_memory;
}

void physics_cache_tree(const PhysicsTree *tree) {
    PhysicsSystem *system = tree->system;
    system->dimensions = tree->dimensions;
    system->generation = tree->frame->generation;
    system->children = tree->root->program_lifetime_children ? tree->root->children : NULL;
    system->child_count = tree->root->child_count;
}
