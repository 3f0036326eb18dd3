// stability.c: see stability.h.
#include "physics/stability.h"

#include "base/heap.h"
#include "physics/internal.h"

#include <string.h>

// Largest λ·δ² of a stable system, and the value to which a suggested strength or resolution leads.
#define LIMIT 4.0
#define SUGGESTED 2.0

enum { ITEMS_A_UNIT = 8 }; // particles or springs

// Stores a force that is unstable, and suggests values. `largest` is an upper bound of λ·δ².
static bool store_instability(PhysInstability *found, const PhysSystem *system, uint32_t number, double largest,
                              double delta) {
    double strength = phys_force_record(system, number)->given.strength;
    *found = (PhysInstability){number, strength * SUGGESTED / largest, delta * sqrt(SUGGESTED / largest)};
    return true;
}

// --- forces on all particles of a group

// The particles on which a force can act: those in `group` and the groups inside it.
typedef struct Bodies {
    uint32_t group;
    bool all;        // also those without a radius
    uint32_t fixed;  // number of anchors and particles that are never accelerated
    uint32_t movers; // number of the others
    double heaviest; // largest masses of movers
    double second;
    double lightest; // smallest mass of movers
    double smallest; // smallest and largest radius
    double largest;
} Bodies;

static void add_network_body(Bodies *bodies, const ParticleRecord *record) {
    double mass = record->mass;
    bodies->smallest = fmin(bodies->smallest, record->radius);
    bodies->largest = fmax(bodies->largest, record->radius);
    if (record->anchor || mass == 0) {
        bodies->fixed++;
        return;
    }
    bodies->movers++;
    bodies->lightest = fmin(bodies->lightest, mass);
    bodies->second = fmax(bodies->second, fmin(mass, bodies->heaviest));
    bodies->heaviest = fmax(bodies->heaviest, mass);
}

// Fills `bodies`, unless it already holds these particles. Returns false if the system must stop.
static bool collect_network_bodies(const PhysSystem *system, uint32_t group, bool all, Bodies *bodies) {
    if (bodies->group == group && bodies->all == all)
        return true;
    uint32_t end = phys_group_end(system, group);
    *bodies = (Bodies){.group = group, .all = all, .lightest = INFINITY, .smallest = INFINITY};
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const ParticleRecord *record = phys_record(system, i);
        if (record->group >= group && record->group < end && (all || record->radius > 0))
            add_network_body(bodies, record);
    }
    return phys_charge(system, 1 + (system->particle_count + end - group) / ITEMS_A_UNIT);
}

// Checks a soft boundary.
static bool is_barrier_unstable(const PhysSystem *system, uint32_t number, const Bodies *bodies, double delta,
                                PhysInstability *found) {
    const PhysForce *barrier = &phys_force_record(system, number)->given;
    double square = barrier->strength * delta * delta;
    bool soft = (barrier->has_minimum && barrier->minimum > 0) || barrier->has_maximum;
    return soft && bodies->movers > 0 && square > LIMIT * bodies->heaviest &&
           store_instability(found, system, number, square / bodies->lightest, delta);
}

// Checks a force between all pairs. Two free particles are thrown apart once and meet no more, so that their energy
// does not grow further; more particles, or an anchor, are needed. The suggestion allows for as many equal neighbours
// as a ball has in the densest packings of the first three dimensions: 2, 6 and 12.
static bool are_pairs_unstable(const PhysSystem *system, uint32_t number, const Bodies *bodies, double delta,
                               PhysInstability *found) {
    const PhysForce *force = &phys_force_record(system, number)->given;
    bool adhesion = force->kind == PHYS_ADHESION;
    double square = force->strength * delta * delta * (adhesion ? 2 * force->overlap : 1), n = system->dimensions;
    double softest = square * (adhesion ? bodies->smallest : 1), stiffest = square * (adhesion ? bodies->largest : 1);
    double mass = bodies->fixed ? bodies->heaviest : 1 / (1 / bodies->heaviest + 1 / bodies->second);
    return bodies->movers > 0 && bodies->movers + 2 * bodies->fixed > 2 && softest > LIMIT * mass &&
           store_instability(found, system, number, n * (n + 1) * stiffest * 2 / bodies->lightest, delta);
}

static bool is_group_force_unstable(const PhysSystem *system, uint32_t number, double delta, Bodies *bodies,
                                    PhysInstability *found) {
    const ForceRecord *record = phys_force_record(system, number);
    const PhysForce *force = &record->given;
    bool barrier = force->kind == PHYS_BARRIER, adhesion = force->kind == PHYS_ADHESION;
    if ((!barrier && !adhesion && force->kind != PHYS_COLLISION) || (!adhesion && force->power != 1) ||
        !(force->strength > 0) || (!barrier && force->max_distance > 0) ||
        !collect_network_bodies(system, record->group, barrier, bodies))
        return false;
    return barrier ? is_barrier_unstable(system, number, bodies, delta, found)
                   : are_pairs_unstable(system, number, bodies, delta, found);
}

// --- springs between given particles

// The `!distance` forces with equal bounds.
typedef struct Network {
    const PhysSystem *system;
    double *stiffness; // by particle: sum of the stiffness of its springs, divided by its mass
    double *vector;    // by particle: n components of the trial vector, multiplied by the root of the mass
    double *product;   // the same for the product with the matrix
} Network;

static const PhysForce *spring_at(const PhysSystem *system, uint32_t number) {
    const PhysForce *force = &phys_force_record(system, number)->given;
    bool acts = force->kind == PHYS_DISTANCE && force->power == 1 && force->strength > 0 && force->from != force->to &&
                force->has_maximum; // with a minimum alone, the spring throws its ends apart once
    return acts ? force : NULL;
}

// Returns 1/m of a particle, 0 for anchors and particles that are never accelerated.
static double inverse_mass(const PhysSystem *system, uint32_t particle) {
    const ParticleRecord *record = phys_record(system, particle);
    return record->anchor || record->mass == 0 ? 0 : 1 / record->mass;
}

static bool is_two_sided(const PhysForce *spring) {
    return spring->has_minimum && spring->has_maximum && spring->minimum == spring->maximum;
}

// Returns the elongation of a spring in the trial vector. Adds its force to `product`, unless this is NULL.
static double apply_spring(const Network *network, const PhysForce *spring, double *product) {
    size_t n = network->system->dimensions, a = n * spring->from, b = n * spring->to;
    const double *from = phys_position(network->system, spring->from), *to = phys_position(network->system, spring->to);
    double root_a = sqrt(inverse_mass(network->system, spring->from));
    double root_b = sqrt(inverse_mass(network->system, spring->to)), square = 0, sum = 0;
    for (size_t k = 0; k < n; k++) {
        square += (to[k] - from[k]) * (to[k] - from[k]);
        sum += (to[k] - from[k]) * (root_b * network->vector[b + k] - root_a * network->vector[a + k]);
    }
    if (!(square > 0) || !isfinite(square))
        return 0;
    for (size_t k = 0; k < n && product; k++) {
        double force = spring->strength * sum / square * (to[k] - from[k]);
        product[a + k] -= root_a * force;
        product[b + k] += root_b * force;
    }
    return sum / sqrt(square);
}

// Multiplies the trial vector by M^-1/2 K M^-1/2. Returns the Rayleigh quotient, which is at most λ, and makes the
// product the new trial vector, of length 1. Returns 0 if the product is 0.
static double iterate(Network *network) {
    const PhysSystem *system = network->system;
    size_t count = (size_t)system->dimensions * system->particle_count;
    double quotient = 0, square = 0, norm = 0, *product = network->product;
    memset(product, 0, count * sizeof *product);
    for (uint32_t f = 0; f < system->force_count; f++) {
        const PhysForce *spring = spring_at(system, f);
        if (spring && is_two_sided(spring))
            apply_spring(network, spring, product);
    }
    for (size_t i = 0; i < count; i++) {
        quotient += network->vector[i] * product[i];
        square += product[i] * product[i];
        norm += network->vector[i] * network->vector[i];
    }
    for (size_t i = 0; i < count && square > 0; i++)
        product[i] /= sqrt(square);
    network->product = network->vector;
    network->vector = product;
    return norm > 0 ? quotient / norm : 0;
}

// Returns a lower bound of λ, and usually nearly λ: the Rayleigh quotient after some steps of the power iteration.
static double largest_eigenvalue(Network *network) {
    enum { STEPS = 40 };
    const PhysSystem *system = network->system;
    size_t count = (size_t)system->dimensions * system->particle_count;
    double lambda = 0;
    for (size_t i = 0; i < count; i++) // any vector that has no symmetry
        network->vector[i] = (i % 2 ? -1 : 1) + (double)(i * 7919 % 1009) / 1009;
    for (int s = 0; s < STEPS; s++) {
        if (!phys_charge(system, 1 + (count + system->force_count) / ITEMS_A_UNIT))
            return 0;
        lambda = iterate(network);
    }
    return lambda;
}

// Returns an upper bound of λ in which spring `number` has a part: for each spring, the stiffness at one end plus that
// at the other.
static double upper_bound(const Network *network) {
    double bound = 0;
    for (uint32_t f = 0; f < network->system->force_count; f++) {
        const PhysForce *spring = spring_at(network->system, f);
        if (spring)
            bound = fmax(bound, network->stiffness[spring->from] + network->stiffness[spring->to]);
    }
    return bound;
}

// Returns the spring with the most energy in the trial vector.
static uint32_t strongest_spring(const Network *network) {
    double largest = 0;
    uint32_t found = 0;
    for (uint32_t f = 0; f < network->system->force_count; f++) {
        const PhysForce *spring = spring_at(network->system, f);
        double elongation = spring && is_two_sided(spring) ? apply_spring(network, spring, NULL) : 0;
        double energy = spring ? spring->strength * elongation * elongation : 0;
        if (energy > largest) {
            largest = energy;
            found = f;
        }
    }
    return found;
}

// Checks each spring by itself, then those with equal bounds together.
static bool are_springs_unstable(Network *network, double delta, PhysInstability *found) {
    const PhysSystem *system = network->system;
    uint32_t two_sided = 0;
    for (uint32_t f = 0; f < system->force_count; f++) {
        const PhysForce *spring = spring_at(system, f);
        if (!spring)
            continue;
        network->stiffness[spring->from] += spring->strength * inverse_mass(system, spring->from);
        network->stiffness[spring->to] += spring->strength * inverse_mass(system, spring->to);
        two_sided += is_two_sided(spring);
    }
    double limit = LIMIT / (delta * delta), bound = upper_bound(network) * delta * delta;
    for (uint32_t f = 0; f < system->force_count; f++) {
        const PhysForce *spring = spring_at(system, f);
        if (spring &&
            spring->strength * (inverse_mass(system, spring->from) + inverse_mass(system, spring->to)) > limit)
            return store_instability(found, system, f, bound, delta);
    }
    return two_sided > 1 && bound > LIMIT && largest_eigenvalue(network) > limit &&
           store_instability(found, system, strongest_spring(network), bound, delta);
}

static bool find_springs(const PhysSystem *system, double delta, PhysInstability *found) {
    bool any = false, unstable = false;
    size_t vectors = (size_t)system->dimensions * system->particle_count, count = system->particle_count;
    for (uint32_t f = 0; f < system->force_count && !any; f++)
        any = spring_at(system, f);
    double *memory = any ? heap_calloc(2 * vectors + count, sizeof *memory) : NULL;
    if (memory) {
        Network network = {system, memory + 2 * vectors, memory, memory + vectors};
        unstable = are_springs_unstable(&network, delta, found);
    }
    heap_free(memory);
    return unstable;
}

bool phys_find_instability(const PhysSystem *system, double delta, PhysInstability *found) {
    Bodies bodies = {.group = NO_GROUP};
    if (system->failed || !(delta > 0) || !phys_charge(system, 1 + system->force_count / ITEMS_A_UNIT))
        return false;
    for (uint32_t f = 0; f < system->force_count; f++)
        if (is_group_force_unstable(system, f, delta, &bodies, found))
            return true;
    return find_springs(system, delta, found);
}
