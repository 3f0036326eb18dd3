// groups.c: sorts particles and forces into the order in which a step processes them.
#include "physics/internal.h"
#include "physics/kernels.h"

static size_t slot_of(const ForceRecord *record) {
    return (size_t)record->group * STAGE_COUNT + phys_force_row(record->given.kind).stage;
}

// Sorts particles by group with a stable counting sort. Group numbers ascend in pre-order, so sorted particles are in
// pre-order. During the sort, the field `first` of a group counts down from the end of its range to the start.
static void arrange_particles(PhysSystem *system) {
    Group *groups = system->groups.bytes;
    if (system->group_count == 1) { // the columns are already in order, or in the sorted order of a list
        groups[0].first = 0;
        groups[0].count = system->particle_count;
        for (uint32_t i = 0; i < system->particle_count && system->column_order != ORDER_BY_CELL; i++)
            system->order[i] = system->column_of[i] = i;
        return;
    }
    for (uint32_t g = 0; g < system->group_count; g++)
        groups[g].count = 0;
    for (uint32_t i = 0; i < system->particle_count; i++)
        groups[phys_record(system, i)->group].count++;
    uint32_t end = 0;
    for (uint32_t g = 0; g < system->group_count; g++)
        groups[g].first = end += groups[g].count;
    for (uint32_t i = system->particle_count; i-- > 0;) {
        uint32_t column = --groups[phys_record(system, i)->group].first;
        system->order[column] = i;
        system->column_of[i] = column;
    }
}

// Writes the force to its place, because copies of this large struct would take a notable part of a frame.
static void write_force(const PhysSystem *system, const ForceRecord *record, uint32_t number, Force *force) {
    const double *vectors = system->vectors.bytes;
    force->given = record->given;
    force->strength = 0;
    force->item = 0;
    force->number = number;
    force->given.vector = record->vector ? vectors + record->vector - 1 : NULL;
    force->given.vector2 = record->vector2 ? vectors + record->vector2 - 1 : NULL;
    if (phys_force_row(force->given.kind).stage != STAGE_LINK)
        return;
    bool valid = force->given.from < system->particle_count && force->given.to < system->particle_count;
    // An invalid link becomes a link of column 0 with itself, which the kernel skips without reading columns.
    force->given.from = valid ? system->column_of[force->given.from] : 0;
    force->given.to = valid ? system->column_of[force->given.to] : 0;
}

// Sorts forces by group and stage with a stable counting sort, as in arrange_particles.
static void arrange_forces(PhysSystem *system) {
    ForceRecord *records = system->force_records.bytes;
    Force *forces = system->forces.bytes;
    size_t slots = (size_t)system->group_count * STAGE_COUNT;
    for (size_t s = 0; s <= slots; s++)
        system->starts[s] = 0;
    for (uint32_t i = 0; i < system->force_count; i++)
        system->starts[slot_of(&records[i])]++;
    for (size_t s = 1; s <= slots; s++)
        system->starts[s] += system->starts[s - 1];
    for (uint32_t i = system->force_count; i-- > 0;) {
        records[i].arranged = --system->starts[slot_of(&records[i])];
        write_force(system, &records[i], i, &forces[records[i].arranged]);
    }
}

void phys_link_populated(Group *groups, uint32_t group_count) {
    for (uint32_t g = 0; g < group_count; g++)
        groups[g].populated = groups[g].count ? g : g ? groups[groups[g].parent].populated : NO_GROUP;
}

void phys_link_groups(PhysSystem *system) {
    Group *groups = system->groups.bytes;
    phys_link_populated(groups, system->group_count);
    for (uint32_t g = 0; g < system->group_count; g++) {
        Group *group = &groups[g];
        const Group *parent = g ? &groups[group->parent] : NULL;
        for (int stage = 0; stage < STAGE_COUNT; stage++) {
            const uint32_t *start = system->starts + (size_t)g * STAGE_COUNT + stage;
            group->nearest[stage] = start[0] != start[1] ? g : parent ? parent->nearest[stage] : NO_GROUP;
        }
    }
}

bool phys_arrange(PhysSystem *system) {
    uint64_t particles = system->particle_count, slots = (uint64_t)system->group_count * STAGE_COUNT;
    if (system->column_order == ORDER_BY_CELL &&
        (system->group_count > 1 || system->particle_count != system->columns.count))
        phys_forget_order(system);
    uint64_t retained = system->column_order == ORDER_BY_CELL ? 2 * particles * sizeof(uint32_t) : 0;
    if (!phys_buffer_reserve(system, &system->indices, retained, 2 * particles + slots + 1, sizeof(uint32_t)))
        return false;
    system->order = system->indices.bytes;
    system->column_of = system->order + particles;
    system->starts = system->column_of + particles;
    system->handle_count = system->particle_count;
    arrange_particles(system);
    return true;
}

bool phys_arrange_forces(PhysSystem *system) {
    if (!phys_buffer_reserve(system, &system->forces, 0, system->force_count, sizeof(Force)) ||
        !phys_buffer_reserve(system, &system->terms, 0, system->force_count, sizeof(PairTerm)) ||
        !phys_buffer_reserve(system, &system->chain, 0, system->force_count, sizeof(Force *)))
        return false;
    arrange_forces(system);
    phys_link_groups(system);
    return true;
}
