// energy.c: see energy.h. Each potential is the integral of the force's K in spec physics.md section 4.
#include "physics/energy.h"

#include "base/heap.h"
#include "maths/maths.h"
#include "physics/forces.h"
#include "physics/internal.h"

#include <math.h>
#include <stdlib.h>

enum { PAIRS_A_UNIT = 4, BODIES_A_UNIT = 4 };

// The force whose energy is computed.
typedef struct Source {
    const PhysSystem *system;
    PhysForce force;
    double strength;
    uint32_t group;       // group of the force
    uint32_t group_end;   // the groups inside it are numbered group + 1 to group_end - 1
    const uint32_t *ends; // pair forces: `group_end` of each group
    double energy;
} Source;

// A particle on which the force acts.
typedef struct Body {
    double x; // first component of the position
    uint32_t handle;
} Body;

// Returns the energy of a displacement: the integral of strength * d^power.
static double displacement_energy(const Source *source, double displacement) {
    double power = fmax(source->force.power, 0) + 1;
    return source->strength * maths_pow(displacement, power) / power;
}

// --- pair forces

// Returns the potential at distance `length`, without a maximum distance, of a force that decreases with the square of
// the distance. `k` is the product of strength and sources; positive if the force attracts. Particles that overlap
// attract with the force at the distance at which they touch.
static double inverse_square_energy(double k, double contact, double length) {
    return length >= contact ? -k / length : -k / contact - k / (contact * contact) * (contact - length);
}

static double contact_energy(const Source *source, const ParticleRecord *a, const ParticleRecord *b, double length) {
    double contact = a->radius + b->radius, depth = contact - length;
    if (a->radius == 0 || b->radius == 0 || !(depth > 0))
        return 0;
    if (source->force.kind == PHYS_COLLISION)
        return displacement_energy(source, depth);
    // Adhesion: K = S · o · (l − a), o = r₁+r₂ − l
    double overlap = source->force.overlap;
    double rest = fabs(a->radius - b->radius) * overlap + contact * (1 - overlap);
    return -source->strength * depth * depth * ((contact - rest) / 2 - depth / 3);
}

static double energy_at(const Source *source, const ParticleRecord *a, const ParticleRecord *b, double length) {
    if (source->force.kind == PHYS_GRAVITY)
        return inverse_square_energy(source->strength * (a->mass * b->mass), a->radius + b->radius, length);
    if (source->force.kind == PHYS_ELECTROSTATIC)
        return inverse_square_energy(-source->strength * (a->charge * b->charge), a->radius + b->radius, length);
    return contact_energy(source, a, b, length);
}

static double distance_between(const PhysSystem *system, uint32_t i, uint32_t j) {
    const double *a = phys_position(system, i), *b = phys_position(system, j);
    double square = 0;
    for (uint32_t k = 0; k < system->dimensions; k++)
        square += (b[k] - a[k]) * (b[k] - a[k]);
    return sqrt(square);
}

// Returns true if the particles' groups interact: one encloses the other, or they are the same.
static bool interact(const Source *source, const ParticleRecord *a, const ParticleRecord *b) {
    uint32_t outer = a->group < b->group ? a->group : b->group, inner = a->group < b->group ? b->group : a->group;
    return inner < source->ends[outer] && !(a->anchor && b->anchor);
}

static void add_pair(Source *source, uint32_t i, uint32_t j) {
    const ParticleRecord *a = phys_record(source->system, i), *b = phys_record(source->system, j);
    double length = distance_between(source->system, i, j), limit = source->force.max_distance;
    if (!(length > 0 && length < INFINITY) || (limit > 0 && length >= limit) || !interact(source, a, b))
        return;
    source->energy += energy_at(source, a, b, length) - (limit > 0 ? energy_at(source, a, b, limit) : 0);
}

static int by_position(const void *a, const void *b) {
    const Body *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->handle > q->handle) - (p->handle < q->handle);
}

// Fills `bodies` with the particles in the force's group and the groups inside it, sorted by the first component of
// their position. Returns their number, and sets *range to a distance beyond which the force does not act.
static size_t collect_bodies(const Source *source, Body *bodies, double *range) {
    const PhysSystem *system = source->system;
    size_t count = 0;
    double radius = 0;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const ParticleRecord *record = phys_record(system, i);
        double x = phys_position(system, i)[0];
        if (record->group < source->group || record->group >= source->group_end || !isfinite(x))
            continue;
        bodies[count++] = (Body){x, i};
        radius = fmax(radius, record->radius);
    }
    bool contact = phys_force_row(source->force.kind).reach == REACH_CONTACT;
    *range = contact ? 2 * radius : INFINITY;
    if (source->force.max_distance > 0)
        *range = fmin(*range, source->force.max_distance);
    qsort(bodies, count, sizeof *bodies, by_position);
    return count;
}

// Sets ends[g] to the number after the last group inside group g. Groups are numbered in pre-order.
static void find_ends(const PhysSystem *system, uint32_t *ends) {
    const Group *groups = system->groups.bytes;
    for (uint32_t g = 0; g < system->group_count; g++)
        ends[g] = g + 1;
    for (uint32_t g = system->group_count - 1; g > 0; g--)
        if (ends[groups[g].parent] < ends[g])
            ends[groups[g].parent] = ends[g];
}

static PhysStatus add_sorted_pairs(Source *source, Body *bodies) {
    const PhysSystem *system = source->system;
    PhysStatus status = PHYS_OK;
    double range;
    size_t count = collect_bodies(source, bodies, &range);
    for (size_t i = 0; i < count && status == PHYS_OK; i++) {
        size_t j = i + 1;
        for (; j < count && bodies[j].x - bodies[i].x <= range; j++)
            add_pair(source, bodies[i].handle, bodies[j].handle);
        if (!phys_charge(system, 1 + (j - i) / PAIRS_A_UNIT))
            status = PHYS_STOPPED;
    }
    return status;
}

static PhysStatus add_pairs(Source *source) {
    const PhysSystem *system = source->system;
    uint32_t *ends = heap_calloc(system->group_count, sizeof *ends);
    Body *bodies = heap_calloc((size_t)system->particle_count + 1, sizeof *bodies);
    PhysStatus status = PHYS_NO_MEMORY;
    if (ends && bodies) {
        find_ends(system, ends);
        source->ends = ends;
        source->group_end = ends[source->group];
        status = add_sorted_pairs(source, bodies);
    }
    heap_free(ends);
    heap_free(bodies);
    return status;
}

static void add_link(Source *source) {
    const PhysForce *link = &source->force;
    uint32_t count = source->system->particle_count;
    if (link->from == link->to || link->from >= count || link->to >= count ||
        (phys_is_anchor(source->system, link->from) && phys_is_anchor(source->system, link->to)))
        return;
    double length = distance_between(source->system, link->from, link->to);
    if (!(length > 0 && length < INFINITY))
        return;
    if (link->has_minimum && length < link->minimum)
        source->energy = displacement_energy(source, link->minimum - length);
    else if (link->has_maximum && length > link->maximum)
        source->energy = displacement_energy(source, length - link->maximum);
}

// --- forces on single particles

static double product(const PhysSystem *system, PhysVector vector, const double *position) {
    double sum = 0;
    for (uint32_t k = 0; k < system->dimensions && vector; k++)
        sum += vector[k] * position[k];
    return sum;
}

static double buoyancy_energy(const Source *source, const ParticleRecord *record, const double *position) {
    const PhysSystem *system = source->system;
    if (record->radius == 0 || record->mass == 0)
        return 0;
    double displaced = maths_pow(record->radius, system->dimensions) * source->force.density;
    return -source->strength * (record->mass - displaced) * product(system, source->force.vector, position);
}

static double barrier_energy(const Source *source, const double *position) {
    const PhysForce *barrier = &source->force;
    double distance = 0;
    for (uint32_t k = 0; k < source->system->dimensions && barrier->vector2; k++)
        distance += (position[k] - (barrier->vector ? barrier->vector[k] : 0)) * barrier->vector2[k];
    if (barrier->has_minimum && barrier->minimum > 0 && distance >= 0 && distance < barrier->minimum)
        return displacement_energy(source, barrier->minimum - distance);
    if (barrier->has_maximum && distance > barrier->maximum)
        return displacement_energy(source, distance - barrier->maximum);
    return 0;
}

static double single_energy(const Source *source, const ParticleRecord *record, const double *position) {
    const PhysForce *force = &source->force;
    const PhysSystem *system = source->system;
    if (force->kind == PHYS_CONSTANT)
        return -source->strength *
               (product(system, force->vector, position) + record->mass * product(system, force->vector2, position));
    if (force->kind == PHYS_FIELD)
        return -source->strength * record->charge * product(system, force->vector, position);
    return force->kind == PHYS_BUOYANCY ? buoyancy_energy(source, record, position) : barrier_energy(source, position);
}

// Returns the number after the last group inside group g.
static uint32_t end_of_group(const PhysSystem *system, uint32_t g) {
    const Group *groups = system->groups.bytes;
    uint32_t end = g + 1;
    while (end < system->group_count && groups[end].parent >= g)
        end++;
    return end;
}

static PhysStatus add_singles(Source *source) {
    const PhysSystem *system = source->system;
    if (!phys_charge(system, 1 + system->particle_count / BODIES_A_UNIT))
        return PHYS_STOPPED;
    source->group_end = end_of_group(system, source->group);
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const ParticleRecord *record = phys_record(system, i);
        double energy = 0;
        if (record->group >= source->group && record->group < source->group_end && !record->anchor)
            energy = single_energy(source, record, phys_position(system, i));
        source->energy += isfinite(energy) ? energy : 0;
    }
    return PHYS_OK;
}

PhysStatus phys_potential_energy(const PhysSystem *system, uint32_t number, double clock, double *energy) {
    Source source = {.system = system};
    PhysStatus status = PHYS_OK;
    *energy = NAN;
    if (!phys_get_force(system, number, &source.force) || source.force.kind == PHYS_RANDOM ||
        source.force.kind == PHYS_DRAG)
        return PHYS_OK;
    source.strength = source.force.strength * phys_ramp(source.force.ease, clock);
    source.group = ((const ForceRecord *)system->force_records.bytes)[number].group;
    Stage stage = phys_force_row(source.force.kind).stage;
    if (stage == STAGE_LINK)
        add_link(&source);
    else
        status = stage == STAGE_PAIR ? add_pairs(&source) : add_singles(&source);
    *energy = status == PHYS_OK ? source.energy : NAN;
    return status;
}
