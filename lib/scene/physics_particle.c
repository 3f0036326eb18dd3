// physics_particle.c: the attributes of particles and anchors, of which there may be very many.
//
// Most nodes name the same attributes in the same order as the one before, with values of the right form. They are read
// in one go; at the first surprise the node is read once more by the careful functions of attrs.h, which report.
#include "scene/systems.h"

#include <math.h>

static double at_least_zero(double x) {
    return x < 0 ? 0 : x;
}

static void read_carefully(const PhysicsTree *tree, const Node *node, bool anchor, Value *id, PhysParticle *numbers) {
    Reader reader = {&tree->scene->schema, tree->frame->arena, node, tree->dimensions};
    reader_check_names(&reader, anchor ? KIND_ANCHOR : KIND_PARTICLE);
    *id = attr_value(&reader, anchor ? ROW_ANCHOR_ID : ROW_PARTICLE_ID);
    *numbers = (PhysParticle){.anchor = anchor};
    if (anchor) {
        numbers->position = attr_vector(&reader, ROW_ANCHOR_POSITION);
        numbers->radius = at_least_zero(attr_float(&reader, ROW_ANCHOR_RADIUS));
        numbers->mass = at_least_zero(attr_float(&reader, ROW_ANCHOR_MASS));
        numbers->charge = attr_float(&reader, ROW_ANCHOR_CHARGE);
        return;
    }
    numbers->position = attr_vector(&reader, ROW_PARTICLE_POSITION);
    numbers->velocity = attr_vector(&reader, ROW_PARTICLE_VELOCITY);
    numbers->force = attr_vector(&reader, ROW_PARTICLE_FORCE);
    numbers->ease = attr_float(&reader, ROW_PARTICLE_EASE);
    numbers->radius = at_least_zero(attr_float(&reader, ROW_PARTICLE_RADIUS));
    numbers->mass = at_least_zero(attr_float(&reader, ROW_PARTICLE_MASS));
    numbers->charge = attr_float(&reader, ROW_PARTICLE_CHARGE);
}

static bool plain_vector(const Attr *attr, uint32_t n, PhysVector *vector) {
    if (attr->value.kind != VALUE_NUMBERS || attr->value.len != n)
        return false;
    *vector = value_numbers(&attr->value);
    return true;
}

static bool plain_number(const Attr *attr, double *number) {
    if (attr->value.kind != VALUE_NUMBERS || attr->value.len != 1 || isnan(attr->value.as.number))
        return false;
    *number = attr->value.as.number;
    return true;
}

// One attribute of a particle; false if it is not simply one of the schema's.
static bool read_plainly(const PhysicsTree *tree, const Attr *attr, AttrRow row, Value *id, PhysParticle *numbers) {
    switch (row) {
    case ROW_PARTICLE_ID:
        *id = attr->value;
        return true;
    case ROW_PARTICLE_POSITION:
        return plain_vector(attr, tree->dimensions, &numbers->position);
    case ROW_PARTICLE_VELOCITY:
        return plain_vector(attr, tree->dimensions, &numbers->velocity);
    case ROW_PARTICLE_FORCE:
        return plain_vector(attr, tree->dimensions, &numbers->force);
    case ROW_PARTICLE_EASE:
        return plain_number(attr, &numbers->ease);
    case ROW_PARTICLE_RADIUS:
        return plain_number(attr, &numbers->radius);
    case ROW_PARTICLE_MASS:
        return plain_number(attr, &numbers->mass);
    case ROW_PARTICLE_CHARGE:
        return plain_number(attr, &numbers->charge);
    default:
        return false;
    }
}

// The row of an attribute of a particle; `guess` is the one after that of the attribute before.
static int row_of(const Schema *schema, const Symbol *name, int guess) {
    int first = schema->first_row[KIND_PARTICLE], end = first + schema->row_count[KIND_PARTICLE];
    for (int row = guess; row < end; row++)
        if (schema->attrs[row] == name)
            return row;
    for (int row = first; row < guess; row++)
        if (schema->attrs[row] == name)
            return row;
    return ROW_COUNT;
}

void physics_read_particle(const PhysicsTree *tree, const Node *node, bool anchor, Value *id, PhysParticle *numbers) {
    *id = VALUE_NULL;
    *numbers = (PhysParticle){.mass = 1};
    int row = ROW_PARTICLE_ID;
    bool plain = !anchor;
    for (uint32_t i = 0; plain && i < node->attr_count; i++) {
        row = row_of(&tree->scene->schema, node->attrs[i].name, row);
        plain = read_plainly(tree, &node->attrs[i], (AttrRow)row, id, numbers);
        row++;
    }
    if (!plain) {
        read_carefully(tree, node, anchor, id, numbers);
        return;
    }
    numbers->radius = at_least_zero(numbers->radius);
    numbers->mass = at_least_zero(numbers->mass);
}
