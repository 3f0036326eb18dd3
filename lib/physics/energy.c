// energy.c: see energy.h. The potentials of all forces are beside their formulas, with which this file shares the
// geometry of pairs, the groups whose particles interact, and the conditions under which a force applies.
#define LANES 1
#include "physics/energy.h"

#include "base/heap.h"
#include "maths/maths.h"
#include "physics/pair_formulas.h"
#include "physics/pair_wavefront.h"
#include "physics/single_formulas.h"

#include <stdlib.h>
#include <string.h>

enum { PAIRS_A_UNIT = 4, BODIES_A_UNIT = 4 };

// The force whose energy is computed. At most one of the potentials is set; none: the force has no potential.
typedef struct EnergySource {
    const PhysSystem *system;
    Force force;
    ForceRow row;
    PairTerm term; // pair forces
    PairPotential *pair;
    LinkPotential *link;
    SinglePotential *single;
    uint32_t group;     // group of the force
    uint32_t group_end; // the groups inside it are numbered group + 1 to group_end - 1
    double energy;
} EnergySource;

static void choose_potential(EnergySource *source) {
#define ENTRY(KIND, name, ...) [PHYS_##KIND] = potential_##name,
    PairPotential *const pairs[PHYS_FORCE_KINDS] = {PHYS_FORCES(ENTRY, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)};
#define LINK(KIND, name) ENTRY(KIND, name, )
    LinkPotential *const links[PHYS_FORCE_KINDS] = {PHYS_FORCES(PHYS_NO_ROW, LINK, PHYS_NO_ROW, PHYS_NO_ROW)};
    SinglePotential *const singles[PHYS_FORCE_KINDS] = {PHYS_FORCES(PHYS_NO_ROW, PHYS_NO_ROW, ENTRY, ENTRY)};
#undef ENTRY
#undef LINK
    PhysForceKind kind = source->force.given.kind;
    source->pair = pairs[kind];
    source->link = links[kind];
    source->single = singles[kind];
}

// --- pair forces

// A particle on which a pair force acts.
typedef struct Body {
    const ParticleRecord *record;
    const double *position;
} Body;

static PairEnd end_of(const ParticleRecord *record) {
    return (PairEnd){.radius = record->radius, .mass = record->mass, .charge = record->charge};
}

// Returns the potential at distance `length`, without a maximum distance.
static double energy_at(const EnergySource *source, const PairEnd *a, const PairEnd *b, double length) {
    const PairGeometry geometry = lone_geometry(length, a, b);
    Pairs pairs = lone_pair(&geometry, a, b);
    pairs.term = &source->term;
    return pair_where(source->row.reach, source->row.need, &pairs) ? source->pair(&pairs) : 0;
}

static void add_pair_energy(EnergySource *source, const Body *from, const Body *to) {
    double length = phys_distance(from->position, to->position, source->system->dimensions, 1);
    double bound = source->term.bound;
    if (!(length > 0 && length < bound) || (from->record->anchor && to->record->anchor))
        return;
    const PairEnd a = end_of(from->record), b = end_of(to->record);
    source->energy += energy_at(source, &a, &b, length) - (bound < INFINITY ? energy_at(source, &a, &b, bound) : 0);
}

static int by_group_and_position(const void *a, const void *b) {
    const Body *p = a, *q = b;
    uint32_t g = p->record->group, h = q->record->group;
    double x = p->position[0], y = q->position[0];
    if (g != h)
        return (g > h) - (g < h);
    return x != y ? (x > y) - (x < y) : (p->position > q->position) - (p->position < q->position);
}

// Fills `bodies` with the particles in the groups of the force, sorted by group and by the first component of their
// positions, and sets the ranges of the groups. Returns a distance beyond which the force does not act.
static double collect_bodies(const EnergySource *source, Body *bodies, Group *groups) {
    const PhysSystem *system = source->system;
    uint32_t count = 0;
    double radius = 0;
    for (uint32_t g = 0; g < system->group_count; g++)
        groups[g] = (Group){.parent = phys_group_parent(system, g)};
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const ParticleRecord *record = phys_record(system, i);
        const double *position = phys_row(system, i);
        if (record->group < source->group || record->group >= source->group_end || !isfinite(position[0]))
            continue;
        bodies[count++] = (Body){record, position};
        groups[record->group].count++;
        radius = fmax(radius, record->radius);
    }
    qsort(bodies, count, sizeof *bodies, by_group_and_position);
    for (uint32_t g = 1; g < system->group_count; g++)
        groups[g].first = groups[g - 1].first + groups[g - 1].count;
    phys_link_populated(groups, system->group_count);
    return fmin(source->row.reach == REACH_CONTACT ? 2 * radius : INFINITY, source->term.bound);
}

// Adds the pairs of a body of `group` and a body of `other`, which encloses it or is the same.
static PhysStatus add_groups(EnergySource *source, const Body *bodies, const Group *group, const Group *other,
                             double range) {
    size_t first = other->first, end = first + other->count;
    for (size_t i = group->first; i < (size_t)group->first + group->count; i++) {
        if (group == other)
            first = i + 1;
        for (size_t step = other->count; step > 0 && group != other; step /= 2) // skips bodies before the range
            while (first + step <= end && bodies[i].position[0] - bodies[first + step - 1].position[0] > range)
                first += step;
        size_t j = first;
        for (; j < end && bodies[j].position[0] - bodies[i].position[0] <= range; j++)
            add_pair_energy(source, &bodies[i], &bodies[j]);
        if (!phys_charge(source->system, 1 + (j - first) / PAIRS_A_UNIT))
            return PHYS_STOPPED;
    }
    return PHYS_OK;
}

static PhysStatus add_pair_energies(EnergySource *source) {
    const PhysSystem *system = source->system;
    Group *groups = heap_calloc(system->group_count, sizeof *groups);
    Body *bodies = heap_calloc((size_t)system->particle_count + 1, sizeof *bodies);
    PhysStatus status = groups && bodies ? PHYS_OK : PHYS_NO_MEMORY;
    double range = status == PHYS_OK ? collect_bodies(source, bodies, groups) : 0;
    for (uint32_t g = source->group; g < source->group_end && status == PHYS_OK; g++)
        for (uint32_t other = groups[g].count ? g : NO_GROUP; other != NO_GROUP && status == PHYS_OK;
             other = phys_next_enclosing(groups, other, source->group))
            status = add_groups(source, bodies, &groups[g], &groups[other], range);
    heap_free(groups);
    heap_free(bodies);
    return status;
}

static PhysStatus add_link(EnergySource *source) {
    const PhysSystem *system = source->system;
    const PhysForce *link = &source->force.given;
    uint32_t count = system->particle_count;
    if (link->from == link->to || link->from >= count || link->to >= count ||
        (phys_is_anchor(system, link->from) && phys_is_anchor(system, link->to)))
        return PHYS_OK;
    double length = phys_distance(phys_row(system, link->from), phys_row(system, link->to), system->dimensions, 1);
    if (length > 0 && length < INFINITY)
        source->energy = source->link(link, source->force.strength, length);
    return PHYS_OK;
}

// --- forces on single particles

static double single_energy(const EnergySource *source, uint32_t particle) {
    const ParticleRecord *record = phys_record(source->system, particle);
    ForceNeed need = source->row.need;
    size_t n = source->system->dimensions;
    double *row = phys_row(source->system, particle), radius = record->radius, mass = record->mass;
    double charge = record->charge, section = need == NEED_SECTION ? maths_pow(radius, (double)n - 1) : 0;
    double volume = need == NEED_VOLUME ? maths_pow(radius, (double)n) : 0;
    const Columns columns = {.dimensions = n,
                             .count = 1,
                             .stride = 1,
                             .position = row,
                             .velocity = row + n,
                             .force = row, // not written by potentials
                             .radius = &radius,
                             .mass = &mass,
                             .charge = &charge,
                             .section = &section,
                             .volume = &volume};
    Block block = block_at(&columns, 0);
    return source->single(&(Singles){NULL, &columns, &source->force, n, &block});
}

static PhysStatus add_singles(EnergySource *source) {
    const PhysSystem *system = source->system;
    if (!phys_charge(system, 1 + system->particle_count / BODIES_A_UNIT))
        return PHYS_STOPPED;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const ParticleRecord *record = phys_record(system, i);
        double energy = 0;
        if (record->group >= source->group && record->group < source->group_end && !record->anchor)
            energy = single_energy(source, i);
        source->energy += isfinite(energy) ? energy : 0;
    }
    return PHYS_OK;
}

PhysStatus phys_potential_energy(const PhysSystem *system, uint32_t number, double clock, double *energy) {
    EnergySource source = {.system = system};
    Force *force = &source.force;
    *energy = NAN;
    if (!phys_get_force(system, number, &force->given))
        return PHYS_OK;
    choose_potential(&source);
    force->strength = force->given.strength * phys_ramp(force->given.ease, clock);
    phys_fill_terms(&source.term, (ForceRange){force, force + 1});
    source.row = phys_force_row(force->given.kind);
    source.group = phys_force_record(system, number)->group;
    source.group_end = phys_group_end(system, source.group);
    PhysStatus (*add)(EnergySource *) = source.pair     ? add_pair_energies
                                        : source.link   ? add_link
                                        : source.single ? add_singles
                                                        : NULL;
    PhysStatus status = add ? add(&source) : PHYS_OK;
    *energy = add && status == PHYS_OK ? source.energy : NAN;
    return status;
}
