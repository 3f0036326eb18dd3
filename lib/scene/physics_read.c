// physics_read.c: reads a `!physics` tree into the engine (spec physics.md sections 1, 3 and 4.2).
#include "base/heap.h"
#include "maths/random.h"
#include "physics/forces.h"
#include "scene/systems.h"
#include "value/format.h"
#include "value/value_hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static Reader reader_of(const PhysicsTree *tree, const Node *node, NodeKind kind) {
    return (Reader){tree->scene->schema, tree->frame->arena, node, kind, tree->dimensions};
}

void physics_read_defaults(Scene *scene) {
    schema_defaults(KIND_PHYSICS, &scene->system_defaults);
    schema_defaults(KIND_PARTICLE, &scene->body_defaults[false]);
    schema_defaults(KIND_ANCHOR, &scene->body_defaults[true]);
    scene->body_defaults[true].numbers.anchor = true;
    for (int kind = 0; kind < PHYS_FORCE_KINDS; kind++) {
        schema_defaults(schema_kind_of_force((PhysForceKind)kind), &scene->force_defaults[kind]);
        scene->force_defaults[kind].force.kind = (PhysForceKind)kind;
    }
}

void physics_read_particle(const PhysicsTree *tree, const Node *node, bool anchor, BodyAttrs *body) {
    const Reader reader = reader_of(tree, node, anchor ? KIND_ANCHOR : KIND_PARTICLE);
    *body = tree->scene->body_defaults[anchor];
    reader_fill(&reader, body);
}

void physics_check_body(const PhysicsTree *tree, const Node *node, bool anchor, const BodyAttrs *body,
                        PhysPreserve preserve) {
    const Reader reader = reader_of(tree, node, anchor ? KIND_ANCHOR : KIND_PARTICLE);
    int64_t frame = tree->frame->number;
    if (!preserve.position)
        reader_report_not_finite(&reader, ATTR_POSITION, body->numbers.position, frame,
                                 "no position is stored, and no force acts between this and other particles");
    if (!preserve.velocity && !anchor)
        reader_report_not_finite(&reader, ATTR_VELOCITY, body->numbers.velocity, frame,
                                 "no position or velocity is stored");
    if (!anchor)
        reader_report_not_finite(&reader, ATTR_FORCE, body->numbers.force, frame, "no force changes the velocity");
}

// Reports an id such as :last, whose state key the system itself uses.
static void check_reserved(PhysicsTree *tree, const Reader *reader, Value id) {
    const Scene *scene = tree->scene;
    const Symbol *const reserved[] = {scene->key_last, scene->key_clock, scene->key_run, scene->key_iteration};
    for (size_t i = 0; i < sizeof reserved / sizeof reserved[0]; i++)
        if (value_is_number(id) && id.as.number == reserved[i]->number) {
            reader_report(reader, "reserved-id", "",
                          STR("the system itself stores a value under this id; use another id"));
            tree->keys_collide = true;
        }
}

void physics_cache_node(const PhysicsTree *tree, uint32_t body, const Node *node, bool has_program_lifetime) {
    PhysicsSystem *system = tree->system;
    // Not needed if the next frame can recognise the whole tree by its address. Not possible if the node is freed after
    // this frame.
    if (tree->root->program_lifetime_children || !has_program_lifetime)
        return;
    if (!heap_reserve((void **)&system->nodes, &system->node_capacity, body, sizeof *system->nodes))
        return;
    while (system->node_count <= body)
        system->nodes[system->node_count++] = NULL;
    system->nodes[body] = node;
}

// Adds a body to the mirror and marks its slots. Returns false if out of memory.
static bool register_body(PhysicsTree *tree, bool anchor, StateSlot position, StateSlot velocity) {
    uint32_t body = tree->body_count, mark = 2 * (tree->scene->body_base + body);
    // Set before the marks, so that the next tree finds them outdated even if reading is aborted here.
    tree->scene->body_count = body + 1;
    if (velocity == STATE_NO_SLOT || !mirror_add(tree, position, velocity, anchor) ||
        !physics_set_mark(tree, position, mark) ||
        (!physics_mark(tree, velocity) && !physics_set_mark(tree, velocity, mark + 1)))
        return false;
    tree->keys_collide |= physics_mark(tree, velocity) != mark + 1;
    tree->body_count++;
    return true;
}

// Adds a body. Returns false and reports an error if its id is invalid or a duplicate. Also returns false if out of
// memory.
static bool add_body(PhysicsTree *tree, const Node *node, Value id, bool anchor) {
    double numbers[PHYSICS_KEY_NUMBERS];
    Reader reader = reader_of(tree, node, anchor ? KIND_ANCHOR : KIND_PARTICLE);
    StateSlot slot = id.len ? state_slot(tree->frame->state, physics_key(tree, id, false, numbers)) : STATE_NO_SLOT;
    if (slot == STATE_NO_SLOT) {
        if (!id.len || !state_key_valid(id)) // otherwise out of memory, which the state reports
            reader_report(&reader, "missing-id", "",
                          id.len ? STR("attribute 'id' must be numbers, symbols or strings; the node is ignored")
                                 : STR("attribute 'id' is missing or null; the node is ignored"));
        return false;
    }
    if (physics_find_slot(tree, slot) != PHYSICS_NO_BODY) {
        reader_report(&reader, "duplicate-id", "",
                      STR("an earlier particle or anchor has the same id; this one is ignored"));
        return false;
    }
    check_reserved(tree, &reader, id);
    StateSlot velocity = state_slot(tree->frame->state, physics_key(tree, id, true, numbers));
    // If the slot is marked, its key is also the key of another particle's velocity, and the other way round.
    bool position_collides = physics_mark(tree, slot) != 0;
    if (position_collides || (velocity != STATE_NO_SLOT && physics_mark(tree, velocity) != 0)) {
        tree->keys_collide = true;
        reader_report(&reader, "colliding-keys", "",
                      position_collides ? STR("the position has the same key in the state as the velocity of another "
                                              "particle; use another id")
                                        : STR("the velocity has the same key in the state as the position of another "
                                              "particle; use another id"));
    }
    if (register_body(tree, anchor, slot, velocity))
        return true;
    tree->out_of_memory = true;
    return false;
}

// Reads a particle or anchor. `identity` is the node that physics_cache_node stores.
__attribute__((noinline)) static void read_body(PhysicsTree *tree, const Node *node, const Node *identity, bool anchor,
                                                uint32_t group) {
    BodyAttrs body;
    double position, velocity;
    physics_read_particle(tree, node, anchor, &body);
    if (!add_body(tree, node, body.id, anchor))
        return;
    physics_cache_node(tree, tree->body_count - 1, identity, node->program_lifetime);
    PhysParticle *numbers = &body.numbers;
    if (!anchor) {
        const StateSlot *slots = tree->system->mirror.slots + 2 * (size_t)(tree->body_count - 1);
        numbers->position =
            mirror_start(tree, slots[0], numbers->position, &position, &numbers->position_from_attribute);
        numbers->velocity =
            mirror_start(tree, slots[1], numbers->velocity, &velocity, &numbers->velocity_from_attribute);
    }
    physics_check_body(
        tree, node, anchor, &body,
        (PhysPreserve){!anchor && !numbers->position_from_attribute, !anchor && !numbers->velocity_from_attribute});
    phys_add_particle(tree->engine, group, numbers);
}

enum { BODY_WORK = 16 };

__attribute__((noinline)) static void read_run(PhysicsTree *tree, const NodeBatch *run, bool anchor, uint32_t group) {
    NodeRow row;
    node_batch_open(run, &row);
    for (uint32_t i = 0; i < run->count; i++) {
        arena_charge(tree->frame->arena, BODY_WORK);
        node_batch_row(run, i, &row);
        read_body(tree, &row.node, node_batch_identity(run, i), anchor, group);
    }
}

static void read_group_bodies(PhysicsTree *tree, const Node *parent, uint32_t group) {
    for (uint32_t i = 0; i < parent->child_count; i++) {
        arena_charge(tree->frame->arena, BODY_WORK);
        const Node *child = parent->children[i];
        NodeKind kind = schema_kind(tree->scene->schema, child);
        switch (kind) {
        case KIND_PARTICLE:
        case KIND_ANCHOR:
            if (child->is_batch)
                read_run(tree, node_batch(child), kind == KIND_ANCHOR, group);
            else
                read_body(tree, child, child, kind == KIND_ANCHOR, group);
            break;
        case KIND_GROUP:
            read_group_bodies(tree, child, phys_add_group(tree->engine, group));
            break;
        default:
            break; // forces are read by physics_read_forces, when all particles are known
        }
    }
}

void physics_read_bodies(PhysicsTree *tree) {
    physics_clear_marks(tree);
    tree->system->node_count = 0;
    // The difference is about the number of particles in batches.
    phys_expect_particles(tree->engine, node_child_count(tree->root) - tree->root->child_count);
    read_group_bodies(tree, tree->root, 0);
    tree->scene->marked_system = tree->system;
    tree->system->mirror.slot_count = 2 * tree->body_count;
}

// Finds the ends of a distance force. First tries the ends that the force had in the last frame. If an end does not
// exist, returns false. *has_first is then true if only `to` does not exist.
static bool find_ends(PhysicsTree *tree, Value from, Value to, Link *link, bool *has_first) {
    PhysicsSystem *system = tree->system;
    uint32_t number = tree->next_link++;
    if (number < system->link_count) {
        *link = system->links[number];
        if (link->from < tree->body_count && physics_has_id(tree, link->from, from) && link->to < tree->body_count &&
            physics_has_id(tree, link->to, to))
            return true;
    }
    int64_t first = physics_find_body(tree, from), second = physics_find_body(tree, to);
    *has_first = first != PHYSICS_NO_BODY;
    *link = (Link){(uint32_t)first, (uint32_t)second};
    if (first == PHYSICS_NO_BODY || second == PHYSICS_NO_BODY)
        return false;
    bool room = heap_reserve((void **)&system->links, &system->link_capacity, number, sizeof *link);
    if (room && number <= system->link_count) {
        system->links[number] = *link;
        system->link_count += number == system->link_count;
    }
    return true;
}

// Sets the ends of a distance force to the particles with the ids `from` and `to`. If a particle does not exist,
// reports this and returns false.
static bool bind_ends(PhysicsTree *tree, const Reader *reader, const ForceAttrs *read, PhysForce *force) {
    Link link;
    bool first = false;
    if (find_ends(tree, read->from, read->to, &link, &first)) {
        force->from = link.from;
        force->to = link.to;
        return true;
    }
    Text text = text_new(reader->arena);
    text_add_format(&text, "%s=", first ? "to" : "from");
    format_value(&text, reader->schema->symbols, first ? read->to : read->from);
    text_add_c(&text, ": no particle or anchor has this id; the force is ignored");
    reader_report_attr(reader, "unknown-particle", first ? ATTR_TO : ATTR_FROM, text_str(&text));
    return false;
}

// The seed of a !random is prefix;run;iteration, followed by one 0 for each !random before it (spec 4.2).
uint64_t physics_random_key(PhysicsTree *tree, uint32_t randoms_before) {
    if (!tree->random_key || randoms_before < tree->random_count) {
        Vector seed = vector_new(tree->frame->arena);
        vector_add(&seed, tree->prefix);
        vector_add_number(&seed, tree->run);
        vector_add_number(&seed, tree->iteration);
        tree->random_key = value_seed_hash(NULL, vector_finish(&seed));
        tree->random_count = 0;
    }
    arena_charge(tree->frame->arena, 1 + (randoms_before - tree->random_count) / 8);
    for (; tree->random_count < randoms_before; tree->random_count++)
        tree->random_key = random_hash_step(tree->random_key, random_hash_number(0));
    return tree->random_key;
}

// Resolves one bound. If `fixed` is given (not NaN), it replaces the bound. If neither is given, sets the bound to 0
// and returns false.
static bool resolve_bound(double fixed, double *bound) {
    *bound = isnan(fixed) ? *bound : fixed;
    bool given = !isnan(*bound);
    *bound = given ? *bound : 0;
    return given;
}

// Reports a `theta` that cannot have an effect, and sets it to 0. If `lint` is set, also reports a `theta` without
// benefit.
static void check_theta(const PhysicsTree *tree, const Reader *reader, PhysForce *force) {
    if (tree->dimensions != 2 && tree->dimensions != 3) {
        reader_report_attr(reader, "no-far-field", ATTR_THETA,
                           STR("attribute 'theta' needs 2 or 3 dimensions; all pairs are computed"));
        force->theta = 0;
    } else if (reader->schema->lint && tree->body_count < phys_far_min_useful(force->theta)) {
        Str text = str_format(reader->arena,
                              "attribute 'theta' saves time only for more than about %.0f particles; all pairs, which "
                              "are exact, would be faster here",
                              round(phys_far_min_useful(force->theta) / 100) * 100);
        reader_report_attr(reader, "small-far-field", ATTR_THETA, text);
    }
}

// Reports vectors of a force that are not finite.
static void check_vectors(PhysicsTree *tree, const Reader *reader, const ForceAttrs *read) {
    const char *effect = reader->kind == KIND_BARRIER ? "no positions of the particles in its group are stored"
                                                      : "no force changes the velocities of particles in its group";
    for (int i = reader->schema->first_row[reader->kind]; i < reader->schema->first_row[reader->kind + 1]; i++) {
        const SchemaRow *row = &schema_rows[i];
        if (schema_types[row->type].shape == SHAPE_VECTOR)
            tree->force_not_finite |= reader_report_not_finite(
                reader, row->name, *(const PhysVector *)(const void *)((const char *)read + row->field),
                tree->frame->number, effect);
    }
}

// Returns true for a force with a random stream.
static bool is_random(NodeKind kind) {
    PhysForceKind force = schema_force(kind);
    return force != PHYS_FORCE_KINDS && phys_force_row(force).need == NEED_STREAM;
}

// Fills `force` from the node of a force or barrier. Returns false if the node must be ignored.
static bool read_force(PhysicsTree *tree, const Reader *reader, uint32_t randoms, PhysForce *force) {
    ForceAttrs read = tree->scene->force_defaults[schema_force(reader->kind)];
    reader_fill(reader, &read);
    check_vectors(tree, reader, &read);
    *force = read.force;
    force->has_minimum = resolve_bound(read.fixed, &force->minimum);
    force->has_maximum = resolve_bound(read.fixed, &force->maximum);
    if (force->theta > 0)
        check_theta(tree, reader, force);
    ForceRow row = phys_force_row(force->kind);
    if (row.need == NEED_STREAM)
        force->key = physics_random_key(tree, randoms);
    if (row.stage == STAGE_LINK)
        return bind_ends(tree, reader, &read, force);
    if (row.stage == STAGE_BARRIER && !force->vector2) {
        reader_report_attr(reader, "bad-normal", ATTR_NORMAL,
                           STR("attribute 'normal' is missing, 0 or not finite; the barrier is ignored"));
        return false;
    }
    return true;
}

static void report_unknown_kind(const Reader *reader) {
    Text out = text_new(reader->arena);
    Str name = reader->node->kind->name;
    text_add_c(&out, "unknown inside !physics; the node is ignored");
    if (schema_rejection(name) == NODE_MISPLACED)
        schema_add_home(&out, name);
    else
        schema_add_nearest_kind(&out, name, PLACE_PHYSICS, "!", "");
    reader_report(reader, "unknown-node", "", text_str(&out));
}

// Stores the location of a force for scene_force_origin. Without memory, the location is unknown.
static void store_origin(PhysicsSystem *system, uint32_t force, const NodeOrigin *origin) {
    if (force == system->origin_count &&
        heap_reserve((void **)&system->origins, &system->origin_capacity, force, sizeof *system->origins))
        system->origins[system->origin_count++] = origin;
}

// Reads one force of a group. Not part of its recursive caller, because the stack frames of that function must be
// small.
__attribute__((noinline)) static void read_applier(PhysicsTree *tree, const Node *parent, const Node *node,
                                                   NodeKind kind, uint32_t group, uint32_t randoms) {
    Reader reader = reader_of(tree, node, kind);
    PhysForce force;
    if (schema_force(kind) == PHYS_FORCE_KINDS) {
        report_unknown_kind(&reader);
        return;
    }
    if (!read_force(tree, &reader, randoms, &force))
        return;
    if (!tree->from_state)
        physics_lint_force(tree, &reader, parent, group, &force);
    uint32_t number = phys_add_force(tree->engine, group, &force);
    PhysicsSystem *system = tree->system;
    store_origin(system, number, node->origin);
    if (!is_random(kind))
        return;
    if (heap_reserve((void **)&system->randoms, &system->random_capacity, system->random_count,
                     sizeof *system->randoms))
        system->randoms[system->random_count++] = (RandomForce){number, randoms};
    else
        tree->out_of_memory = true;
}

// Returns the number of particles and anchors in a group, at most 2.
static uint32_t count_bodies(PhysicsTree *tree, const Node *group) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < group->child_count && count < 2; i++) {
        const Node *child = group->children[i];
        NodeKind kind = schema_kind(tree->scene->schema, child);
        arena_charge(tree->frame->arena, 1);
        if (kind == KIND_GROUP)
            count += count_bodies(tree, child);
        else if (kind == KIND_PARTICLE || kind == KIND_ANCHOR)
            count += child->is_batch ? node_batch(child)->count : 1;
    }
    return count < 2 ? count : 2;
}

// Reports a pair force in a group with a single particle, which has no effect.
static void check_group(PhysicsTree *tree, const Node *group, const Node *node, NodeKind kind) {
    PhysForceKind force = schema_force(kind);
    if (force == PHYS_FORCE_KINDS || phys_force_row(force).stage != STAGE_PAIR || count_bodies(tree, group) > 1)
        return;
    const Reader reader = reader_of(tree, node, kind);
    reader_report(&reader, "lonely-force", "",
                  STR("the force acts only between particles of the same group, and this group has only one; put the "
                      "force outside the group"));
}

static void read_group_forces(PhysicsTree *tree, const Node *parent, uint32_t group, uint32_t randoms) {
    for (uint32_t i = 0; i < parent->child_count; i++) {
        const Node *child = parent->children[i];
        NodeKind kind = schema_kind(tree->scene->schema, child);
        arena_charge(tree->frame->arena, child->is_batch ? node_batch(child)->count : 1);
        if (kind == KIND_GROUP) {
            read_group_forces(tree, child, tree->next_group++, randoms);
        } else if (kind != KIND_PARTICLE && kind != KIND_ANCHOR) {
            if (group > 0 && tree->scene->schema->lint)
                check_group(tree, parent, child, kind);
            read_applier(tree, parent, child, kind, group, randoms);
            randoms += is_random(kind);
        }
    }
}

void physics_read_forces(PhysicsTree *tree) {
    tree->next_group = 1;
    tree->next_link = 0;
    tree->system->random_count = tree->system->origin_count = 0;
    read_group_forces(tree, tree->root, 0, 0);
}
