// physics_lint.c: reports of forces and settings that are valid but do nothing in a system. They are checked when the
// system starts, because a script may change attributes later.
#include "physics/forces.h"
#include "scene/systems.h"
#include "value/format.h"

#include <math.h>

static bool has_physics_attr(const Reader *reader, const Node *node, AttrRow row) {
    return node_mentions(node, reader->schema->slots[row].name);
}

// Adds the number of particles and anchors in a group to *count. Returns true if one of them has the attribute of the
// given rows of !particle and !anchor.
static bool group_has(PhysicsTree *tree, const Reader *reader, const Node *group, const AttrRow rows[2],
                      uint64_t *count) {
    for (uint32_t i = 0; i < group->child_count; i++) {
        const Node *child = group->children[i];
        NodeKind kind = schema_kind(reader->schema, child);
        arena_charge(reader->arena, 1);
        bool body = kind == KIND_PARTICLE || kind == KIND_ANCHOR;
        *count += body;
        const Reader inner = {reader->schema, reader->arena, child, kind, reader->dimensions};
        if (body ? has_physics_attr(reader, child, rows[kind == KIND_ANCHOR]) || !reader_knows_attrs(&inner)
                 : kind == KIND_GROUP && group_has(tree, reader, child, rows, count))
            return true;
    }
    return false;
}

// Reports a force that needs a radius or a charge, if no particle on which it acts has one.
static void lint_need(PhysicsTree *tree, const Reader *reader, const Node *group, PhysForceKind kind) {
    ForceNeed need = phys_force_row(kind).need;
    bool charge = need == NEED_CHARGE;
    const AttrRow rows[2] = {charge ? ROW_PARTICLE_CHARGE : ROW_PARTICLE_RADIUS,
                             charge ? ROW_ANCHOR_CHARGE : ROW_ANCHOR_RADIUS};
    uint64_t count = 0;
    if (!charge && need != NEED_RADIUS && need != NEED_SECTION && need != NEED_VOLUME)
        return;
    if (group_has(tree, reader, group, rows, &count) || count == 0)
        return;
    reader_report(reader, charge ? "no-charge" : "no-radius", "",
                  charge
                      ? STR("no particle here has a charge, so the force does nothing; add charge=1 to the particles")
                      : STR("no particle here has a radius, so the force does nothing; add radius=1 to the particles"));
}

// Reports a spring without length, and the strength of a barrier that is only a wall.
static void lint_bounds(const Reader *reader, const PhysForce *force) {
    if (force->has_minimum || force->has_maximum || !reader_knows_attrs(reader))
        return;
    if (force->kind == PHYS_DISTANCE && !has_physics_attr(reader, reader->node, ROW_DISTANCE_FIXED) &&
        !has_physics_attr(reader, reader->node, ROW_DISTANCE_MINIMUM) &&
        !has_physics_attr(reader, reader->node, ROW_DISTANCE_MIN) &&
        !has_physics_attr(reader, reader->node, ROW_DISTANCE_MAXIMUM) &&
        !has_physics_attr(reader, reader->node, ROW_DISTANCE_MAX))
        reader_report(reader, "no-bounds", "",
                      STR("without 'fixed', 'min' or 'max', the force is always 0; for a spring of length 10, write "
                          "fixed=10"));
    if (force->kind == PHYS_BARRIER && has_physics_attr(reader, reader->node, ROW_BARRIER_STRENGTH) &&
        !has_physics_attr(reader, reader->node, ROW_BARRIER_FIXED) &&
        !has_physics_attr(reader, reader->node, ROW_BARRIER_MINIMUM) &&
        !has_physics_attr(reader, reader->node, ROW_BARRIER_MIN) &&
        !has_physics_attr(reader, reader->node, ROW_BARRIER_MAXIMUM) &&
        !has_physics_attr(reader, reader->node, ROW_BARRIER_MAX))
        reader_report_attr(
            reader, "no-bounds", ATTR_STRENGTH,
            STR("without 'min' or 'max', a barrier is only a wall, and its strength has no effect; to push "
                "particles that are nearer than 10, write min=10"));
}

static bool is_in_group(const PhysSystem *engine, uint32_t particle, uint32_t group) {
    uint32_t at = phys_particle_group(engine, particle);
    while (at > group) // the parent of a group has a lower number
        at = phys_group_parent(engine, at);
    return at == group;
}

// Returns true if there are particles in a group and all of them are behind a barrier.
static bool all_behind(const PhysicsTree *tree, uint32_t group, const PhysForce *barrier) {
    bool found = false;
    for (uint32_t i = 0; i < tree->body_count; i++) {
        if (phys_is_anchor(tree->engine, i) || !is_in_group(tree->engine, i, group))
            continue;
        const double *position = phys_position(tree->engine, i);
        double distance = 0;
        for (uint32_t k = 0; k < tree->dimensions; k++)
            distance += (position[k] - (barrier->vector ? barrier->vector[k] : 0)) * barrier->vector2[k];
        if (!(distance < 0))
            return false;
        found = true;
    }
    return found;
}

static void lint_side(const PhysicsTree *tree, const Reader *reader, uint32_t group, const PhysForce *barrier) {
    arena_charge(reader->arena, tree->body_count);
    if (tree->force_not_finite || !all_behind(tree, group, barrier)) // such a position has been reported
        return;
    Value normal = node_get(reader->node, reader->schema->slots[ROW_BARRIER_NORMAL].name);
    double *turned = arena_alloc_array(reader->arena, normal.len, sizeof *turned);
    for (uint32_t i = 0; i < normal.len; i++)
        turned[i] = 0 - value_numbers(&normal)[i];
    Text text = text_new(reader->arena);
    text_add_c(&text, "all particles start behind the barrier; if its normal should point to them, write normal=");
    format_value(&text, reader->schema->symbols, value_numbers_view(turned, normal.len));
    reader_report_attr(reader, "barrier-side", ATTR_NORMAL, text_str(&text));
}

void physics_lint_force(PhysicsTree *tree, const Reader *reader, const Node *parent, uint32_t group,
                        const PhysForce *force) {
    lint_need(tree, reader, parent, force->kind);
    lint_bounds(reader, force);
    if (phys_force_row(force->kind).stage == STAGE_BARRIER)
        lint_side(tree, reader, group, force);
}

void physics_lint_settings(const Reader *reader, const SystemAttrs *settings, const SceneFrame *frame) {
    enum { MIN_STEP = 2 }; // smaller numbers can be meant as a number of seconds
    const SchemaSlot *slots = reader->schema->slots;
    Value resolution = node_get(reader->node, slots[ROW_PHYSICS_RESOLUTION].name);
    if (frame->resolution > 0 || !(settings->resolution >= MIN_STEP) || settings->resolution <= 1 / frame->fps ||
        !value_is_number(resolution) || node_get(reader->node, slots[ROW_PHYSICS_TIME].name).len > 0)
        return;
    Text text = text_new(reader->arena);
    text_add_c(&text, "resolution is the longest time step in seconds, and a step is never longer than a frame; for ");
    format_value(&text, reader->schema->symbols, resolution);
    text_add_c(&text, " steps per second, write resolution=1/");
    format_value(&text, reader->schema->symbols, resolution);
    reader_report_attr(reader, "long-resolution", ATTR_RESOLUTION, text_str(&text));
}
