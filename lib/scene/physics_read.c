// physics_read.c: a `!physics` tree to the engine's terms (spec physics.md sections 1, 3 and 4.2).
#include "maths/random.h"
#include "scene/systems.h"

#include "value/format.h"
#include "value/seed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static Reader reader_of(const PhysicsTree *tree, const Node *node) {
    return (Reader){&tree->scene->schema, tree->frame->arena, node, tree->dimensions};
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

// The system's own keys are prefix;:last and so on: a particle of that id fights with them.
static void check_reserved(PhysicsTree *tree, const Reader *reader, Value id) {
    const Scene *scene = tree->scene;
    const Symbol *const reserved[] = {scene->key_last, scene->key_clock, scene->key_run, scene->key_iteration};
    for (size_t i = 0; i < sizeof reserved / sizeof reserved[0]; i++)
        if (id.len == 1 && id.kind == VALUE_NUMBERS && id.as.number == reserved[i]->number) {
            reader_report(reader, "reserved-id", "", STR("the system keeps a value of its own under this id"));
            tree->shared = true;
        }
}

void physics_keep_node(const PhysicsTree *tree, uint32_t body, const Node *node) {
    PhysicsSystem *system = tree->system;
    if (tree->root->program_lifetime_children || !node->program_lifetime)
        return; // the whole tree is known by its address, or the node does not last
    if (!scene_reserve((void **)&system->nodes, &system->node_capacity, body, sizeof *system->nodes))
        return;
    while (system->node_count <= body)
        system->nodes[system->node_count++] = NULL;
    system->nodes[body] = node;
}

// Remembers a body under its slots. False if memory is used up.
static bool remember_body(PhysicsTree *tree, const Node *node, bool anchor, StateSlot position, StateSlot velocity) {
    uint32_t body = tree->body_count, mark = 2 * (tree->scene->body_base + body);
    if (velocity == STATE_NO_SLOT || !mirror_add(tree, position, velocity, anchor) ||
        !physics_set_mark(tree, position, mark) ||
        (!physics_mark(tree, velocity) && !physics_set_mark(tree, velocity, mark + 1)))
        return false;
    tree->shared |= physics_mark(tree, velocity) != mark + 1;
    physics_keep_node(tree, body, node);
    tree->body_count++;
    return true;
}

// Adds a body; false if it has no usable id or one that was seen already (reported), or memory is used up.
static bool add_body(PhysicsTree *tree, const Node *node, Value id, bool anchor) {
    double numbers[PHYSICS_KEY_NUMBERS];
    Reader reader = reader_of(tree, node);
    StateSlot slot = id.len ? state_slot(tree->frame->state, physics_key(tree, id, false, numbers)) : STATE_NO_SLOT;
    if (slot == STATE_NO_SLOT) {
        reader_report(&reader, "missing-id", "",
                      id.len ? STR("this id cannot be a state key; ignored") : STR("no id; ignored"));
        return false;
    }
    if (physics_find_slot(tree, slot) != PHYSICS_NO_BODY) {
        reader_report(&reader, "duplicate-id", "", STR("a particle with this id is there already; ignored"));
        return false;
    }
    check_reserved(tree, &reader, id);
    tree->shared |= physics_mark(tree, slot) != 0; // the velocity of another
    StateSlot velocity = state_slot(tree->frame->state, physics_key(tree, id, true, numbers));
    if (remember_body(tree, node, anchor, slot, velocity))
        return true;
    tree->failed = true;
    return false;
}

__attribute__((noinline)) static void read_body(PhysicsTree *tree, const Node *node, bool anchor, uint32_t group) {
    Value id;
    PhysParticle numbers;
    double position, velocity;
    physics_read_particle(tree, node, anchor, &id, &numbers);
    if (!add_body(tree, node, id, anchor))
        return;
    Reader reader = reader_of(tree, node);
    reader_lint(&reader, anchor ? KIND_ANCHOR : KIND_PARTICLE);
    if (!anchor) {
        const StateSlot *slots = tree->system->mirror.slots + 2 * (size_t)(tree->body_count - 1);
        numbers.position = mirror_start(tree, slots[0], numbers.position, &position, &numbers.position_from_attribute);
        numbers.velocity = mirror_start(tree, slots[1], numbers.velocity, &velocity, &numbers.velocity_from_attribute);
    }
    phys_add_particle(tree->engine, group, &numbers);
}

static void read_group_bodies(PhysicsTree *tree, const Node *parent, uint32_t group) {
    for (uint32_t i = 0; i < parent->child_count; i++) {
        const Node *child = parent->children[i];
        switch (schema_kind(&tree->scene->schema, child)) {
        case KIND_PARTICLE:
            read_body(tree, child, false, group);
            break;
        case KIND_ANCHOR:
            read_body(tree, child, true, group);
            break;
        case KIND_GROUP:
            read_group_bodies(tree, child, phys_add_group(tree->engine, group));
            break;
        default:
            break; // forces come in the second pass, when all particles are known
        }
    }
}

void physics_read_bodies(PhysicsTree *tree) {
    physics_clear_marks(tree);
    tree->system->node_count = 0;
    read_group_bodies(tree, tree->root, 0);
    tree->scene->body_count = tree->body_count;
    tree->scene->marked = tree->system;
    tree->system->mirror.slot_count = 2 * tree->body_count;
}

static PhysForce pair_force(const Reader *reader, PhysForceKind kind, AttrRow strength, AttrRow ease,
                            AttrRow max_distance) {
    return (PhysForce){.kind = kind,
                       .strength = attr_float(reader, strength),
                       .ease = attr_float(reader, ease),
                       .power = 1,
                       .max_distance = attr_float(reader, max_distance)};
}

// Bounds of !distance and !barrier: `fixed` gives both, else the long name wins over the short one.
static void read_bounds(const Reader *reader, PhysForce *force, const AttrRow lower[3], const AttrRow upper[3]) {
    force->has_minimum = attr_first(reader, lower, 3, &force->minimum);
    force->has_maximum = attr_first(reader, upper, 3, &force->maximum);
}

// The ends of a distance force; those of the force at this place in the last frame are tried first.
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
    bool room = scene_reserve((void **)&system->links, &system->link_capacity, number, sizeof *link);
    if (room && number <= system->link_count) {
        system->links[number] = *link;
        system->link_count += number == system->link_count;
    }
    return true;
}

static bool read_distance(PhysicsTree *tree, const Reader *reader, PhysForce *force) {
    static const AttrRow lower[] = {ROW_DISTANCE_FIXED, ROW_DISTANCE_MINIMUM, ROW_DISTANCE_MIN};
    static const AttrRow upper[] = {ROW_DISTANCE_FIXED, ROW_DISTANCE_MAXIMUM, ROW_DISTANCE_MAX};
    Value from = attr_value(reader, ROW_DISTANCE_FROM), to = attr_value(reader, ROW_DISTANCE_TO);
    Link link;
    bool first = false;
    if (!find_ends(tree, from, to, &link, &first)) {
        Text text = text_new(reader->arena);
        text_add_format(&text, "%s=", first ? "to" : "from");
        format_value(&text, reader->schema->symbols, first ? to : from);
        text_add_c(&text, " names no particle; ignored");
        reader_report_attr(reader, "no-such-particle",
                           reader->schema->attrs[first ? ROW_DISTANCE_TO : ROW_DISTANCE_FROM], text_str(&text));
        return false;
    }
    *force = (PhysForce){.kind = PHYS_DISTANCE,
                         .strength = attr_float(reader, ROW_DISTANCE_STRENGTH),
                         .ease = attr_float(reader, ROW_DISTANCE_EASE),
                         .power = attr_float(reader, ROW_DISTANCE_POWER),
                         .from = link.from,
                         .to = link.to};
    read_bounds(reader, force, lower, upper);
    return true;
}

// normal / sqrt(Σ normal_k²); NULL (reported) if that is no direction.
static const double *unit_normal(const Reader *reader) {
    const double *normal = attr_vector(reader, ROW_BARRIER_NORMAL);
    double sum = 0;
    for (uint32_t k = 0; normal && k < reader->dimensions; k++)
        sum += normal[k] * normal[k];
    double length = sqrt(sum);
    if (!(length > 0) || !isfinite(length)) {
        reader_report_attr(reader, "bad-normal", reader->schema->attrs[ROW_BARRIER_NORMAL],
                           STR("normal is no direction; the barrier is ignored"));
        return NULL;
    }
    double *unit = arena_alloc_array(reader->arena, reader->dimensions, sizeof *unit);
    for (uint32_t k = 0; k < reader->dimensions; k++)
        unit[k] = normal[k] / length;
    return unit;
}

static bool read_barrier(const Reader *reader, PhysForce *force) {
    static const AttrRow lower[] = {ROW_BARRIER_FIXED, ROW_BARRIER_MINIMUM, ROW_BARRIER_MIN};
    static const AttrRow upper[] = {ROW_BARRIER_FIXED, ROW_BARRIER_MAXIMUM, ROW_BARRIER_MAX};
    const double *normal = unit_normal(reader);
    if (!normal)
        return false;
    *force = (PhysForce){.kind = PHYS_BARRIER,
                         .strength = attr_float(reader, ROW_BARRIER_STRENGTH),
                         .ease = attr_float(reader, ROW_BARRIER_EASE),
                         .power = attr_float(reader, ROW_BARRIER_POWER),
                         .restitution = clamp(attr_float(reader, ROW_BARRIER_RESTITUTION), 0, 1),
                         .vector = attr_vector(reader, ROW_BARRIER_POSITION),
                         .vector2 = normal};
    read_bounds(reader, force, lower, upper);
    return true;
}

static PhysForce read_buoyancy(const Reader *reader) {
    const double *gravity = attr_vector(reader, ROW_BUOYANCY_GRAVITY);
    if (!gravity) {
        // The default points down along the last axis.
        double *down = arena_alloc_array(reader->arena, reader->dimensions, sizeof *down);
        for (uint32_t k = 0; k < reader->dimensions; k++)
            down[k] = k + 1 == reader->dimensions ? -1 : 0;
        gravity = down;
    }
    return (PhysForce){.kind = PHYS_BUOYANCY,
                       .strength = attr_float(reader, ROW_BUOYANCY_STRENGTH),
                       .ease = attr_float(reader, ROW_BUOYANCY_EASE),
                       .density = attr_float(reader, ROW_BUOYANCY_DENSITY),
                       .vector = gravity};
}

// The seed of a !random: prefix;run;iteration and a 0 for each !random before it (spec 4.2).
uint64_t physics_random_key(const PhysicsTree *tree, uint32_t randoms_before) {
    Vector seed = vector_new(tree->frame->arena);
    vector_add(&seed, tree->prefix);
    vector_add_number(&seed, tree->run);
    vector_add_number(&seed, tree->iteration);
    uint64_t key = value_seed_hash(vector_finish(&seed));
    for (uint32_t i = 0; i < randoms_before; i++)
        key = random_hash_step(key, random_hash_number(0));
    return key;
}

// Fills `force` from a force applier or barrier; false if it is to be ignored.
static bool read_force(PhysicsTree *tree, const Reader *reader, SceneKind kind, uint32_t randoms, PhysForce *force) {
    switch (kind) {
    case KIND_CONSTANT:
        *force = (PhysForce){.kind = PHYS_CONSTANT,
                             .strength = attr_float(reader, ROW_CONSTANT_STRENGTH),
                             .ease = attr_float(reader, ROW_CONSTANT_EASE),
                             .vector = attr_vector(reader, ROW_CONSTANT_FORCE),
                             .vector2 = attr_vector(reader, ROW_CONSTANT_ACCELERATION)};
        return true;
    case KIND_RANDOM:
        *force = (PhysForce){.kind = PHYS_RANDOM,
                             .strength = attr_float(reader, ROW_RANDOM_STRENGTH),
                             .ease = attr_float(reader, ROW_RANDOM_EASE),
                             .key = physics_random_key(tree, randoms)};
        return true;
    case KIND_FIELD:
        *force = (PhysForce){.kind = PHYS_FIELD,
                             .strength = attr_float(reader, ROW_FIELD_STRENGTH),
                             .ease = attr_float(reader, ROW_FIELD_EASE),
                             .vector = attr_vector(reader, ROW_FIELD_DIRECTION)};
        return true;
    case KIND_DRAG:
        *force = (PhysForce){.kind = PHYS_DRAG,
                             .strength = attr_float(reader, ROW_DRAG_STRENGTH),
                             .ease = attr_float(reader, ROW_DRAG_EASE),
                             .vector = attr_vector(reader, ROW_DRAG_FLOW)};
        return true;
    case KIND_BUOYANCY:
        *force = read_buoyancy(reader);
        return true;
    case KIND_COLLISION:
        *force =
            pair_force(reader, PHYS_COLLISION, ROW_COLLISION_STRENGTH, ROW_COLLISION_EASE, ROW_COLLISION_MAX_DISTANCE);
        force->power = attr_float(reader, ROW_COLLISION_POWER);
        return true;
    case KIND_GRAVITY:
        *force = pair_force(reader, PHYS_GRAVITY, ROW_GRAVITY_STRENGTH, ROW_GRAVITY_EASE, ROW_GRAVITY_MAX_DISTANCE);
        return true;
    case KIND_ELECTROSTATIC:
        *force = pair_force(reader, PHYS_ELECTROSTATIC, ROW_ELECTROSTATIC_STRENGTH, ROW_ELECTROSTATIC_EASE,
                            ROW_ELECTROSTATIC_MAX_DISTANCE);
        return true;
    case KIND_ADHESION:
        *force = pair_force(reader, PHYS_ADHESION, ROW_ADHESION_STRENGTH, ROW_ADHESION_EASE, ROW_ADHESION_MAX_DISTANCE);
        force->overlap = clamp(attr_float(reader, ROW_ADHESION_OVERLAP), 0, 1);
        return true;
    case KIND_DISTANCE:
        return read_distance(tree, reader, force);
    case KIND_BARRIER:
        return read_barrier(reader, force);
    default:
        return false;
    }
}

static void report_unknown_kind(const Reader *reader) {
    const Symbol *nearest = NULL;
    int least = 4;
    for (int kind = KIND_PARTICLE; kind <= KIND_BARRIER; kind++) {
        int distance = str_distance(reader->node->kind->name, reader->schema->kinds[kind]->name);
        if (distance < least) {
            least = distance;
            nearest = reader->schema->kinds[kind];
        }
    }
    Text out = text_new(reader->arena);
    text_add_c(&out, "no such node inside !physics; ignored");
    if (nearest)
        text_add_format(&out, ", did you mean !%.*s?", (int)nearest->name.len, nearest->name.bytes);
    reader_report(reader, "unknown-node", "", text_str(&out));
}

static bool is_inside_physics(SceneKind kind) {
    return kind > KIND_PHYSICS && kind <= KIND_BARRIER;
}

// One child of a group that is no particle and no group. Kept out of the recursion, whose frames must stay small.
__attribute__((noinline)) static void read_applier(PhysicsTree *tree, const Node *node, SceneKind kind, uint32_t group,
                                                   uint32_t randoms) {
    Reader reader = reader_of(tree, node);
    PhysForce force;
    if (!is_inside_physics(kind)) {
        report_unknown_kind(&reader);
        return;
    }
    reader_check_names(&reader, kind);
    if (!read_force(tree, &reader, kind, randoms, &force))
        return;
    uint32_t number = phys_add_force(tree->engine, group, &force);
    PhysicsSystem *system = tree->system;
    if (kind != KIND_RANDOM)
        return;
    if (scene_reserve((void **)&system->randoms, &system->random_capacity, system->random_count,
                      sizeof *system->randoms))
        system->randoms[system->random_count++] = (RandomForce){number, randoms};
    else
        tree->failed = true;
}

static void read_group_forces(PhysicsTree *tree, const Node *parent, uint32_t group, uint32_t randoms) {
    for (uint32_t i = 0; i < parent->child_count; i++) {
        const Node *child = parent->children[i];
        SceneKind kind = schema_kind(&tree->scene->schema, child);
        if (kind == KIND_GROUP) {
            read_group_forces(tree, child, tree->next_group++, randoms);
        } else if (kind != KIND_PARTICLE && kind != KIND_ANCHOR) {
            read_applier(tree, child, kind, group, randoms);
            randoms += kind == KIND_RANDOM;
        }
    }
}

void physics_read_forces(PhysicsTree *tree) {
    tree->next_group = 1;
    tree->next_link = 0;
    tree->system->random_count = 0;
    read_group_forces(tree, tree->root, 0, 0);
}
