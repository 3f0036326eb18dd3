// divergence.c: see divergence.h.
#include "physics/divergence.h"

#include "physics/internal.h"

#include <float.h>

enum { NO_PARTICLE = -1 };

// What a closer look finds in the rows of all particles except anchors.
typedef struct Extent {
    double position; // largest component of a position
    double velocity; // largest component of a velocity
    double largest;  // kinetic energy of the particle `fastest`
    int64_t fastest;
    int64_t overflowed; // first particle that overflowed, or NO_PARTICLE
} Extent;

// Returns the largest component of a vector. Returns infinity if one is infinite or NaN.
static double largest_component(const double *vector, size_t n) {
    double largest = 0;
    for (size_t k = 0; k < n; k++)
        largest = fabs(vector[k]) <= largest ? largest : isnan(vector[k]) ? INFINITY : fabs(vector[k]);
    return largest;
}

static inline double square_of(const double *vector, size_t n) {
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += vector[k] * vector[k];
    return sum;
}

// Returns the kinetic energy. Sets *squares to a number that is at most PHYS_DIVERGENT² only if no component is above
// PHYS_DIVERGENT. This is all that most checks compute.
static double kinetic_energy(const PhysSystem *system, double *squares) {
    double energy = 0, sum = 0;
    size_t n = system->dimensions;
    const double *row = system->rows.bytes;
    for (uint32_t i = 0; i < system->particle_count; i++, row += 2 * n) {
        double square = square_of(row + n, n);
        energy += phys_record(system, i)->mass * square / 2;
        sum += square + square_of(row, n);
    }
    *squares = sum;
    return energy;
}

// Returns true if a particle has overflowed. With PhysTime.keep_last_finite, its row then holds the last finite
// vectors. If a vector in the row is not finite, the script gave it.
static bool has_overflowed(const PhysSystem *system, uint32_t particle, double position, double velocity) {
    bool finite = phys_position_finite(system, particle) && phys_velocity_finite(system, particle);
    if (system->watch.huge || !isfinite(position) || !isfinite(velocity))
        return false;
    return !finite || position > PHYS_DIVERGENT || velocity > PHYS_DIVERGENT;
}

static Extent measure(const PhysSystem *system) {
    Extent extent = {.fastest = NO_PARTICLE, .overflowed = NO_PARTICLE};
    size_t n = system->dimensions;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        const ParticleRecord *record = phys_record(system, i);
        const double *row = phys_row(system, i);
        if (record->anchor)
            continue;
        double position = largest_component(row, n), velocity = largest_component(row + n, n);
        double energy = record->mass * square_of(row + n, n) / 2;
        if (extent.overflowed == NO_PARTICLE && has_overflowed(system, i, position, velocity))
            extent.overflowed = i;
        extent.position = position > extent.position ? position : extent.position;
        extent.velocity = velocity > extent.velocity ? velocity : extent.velocity;
        if (energy > extent.largest) {
            extent.largest = energy;
            extent.fastest = i;
        }
    }
    return extent;
}

void phys_watch_start(PhysSystem *system) {
    double squares;
    system->watch = (Watch){.steps = system->steps, .energy = kinetic_energy(system, &squares)};
    Extent extent = measure(system);
    system->watch.huge = extent.position > PHYS_DIVERGENT || extent.velocity > PHYS_DIVERGENT;
}

// Compares the energy with that of the last check and stores it. Returns true if it has grown fast in both checks.
static bool grows_fast(PhysSystem *system, double energy) {
    enum { GROWTH_BITS = 2, GROWTHS = 2 }; // 4 to the power of 10 is about a million
    Watch *watch = &system->watch;
    uint64_t steps = system->steps - watch->steps;
    bool grown = watch->energy > 0 && isfinite(energy) && steps < DBL_MAX_EXP &&
                 energy >= watch->energy * ldexp(1, (int)(GROWTH_BITS * steps));
    watch->growths = grown ? watch->growths + 1 : 0;
    watch->steps = system->steps;
    watch->energy = energy;
    return watch->growths >= GROWTHS;
}

PhysDivergence phys_find_divergence(PhysSystem *system, uint32_t *particle) {
    enum { STEPS = 10 };
    Watch *watch = &system->watch;
    bool due = system->steps - watch->steps >= STEPS, may_overflow = system->any_not_finite;
    if (watch->found || (!due && !may_overflow))
        return PHYS_CONVERGENT;
    double squares = 0, energy = due ? kinetic_energy(system, &squares) : 0;
    bool grows = due && grows_fast(system, energy);
    may_overflow |= !(squares <= PHYS_DIVERGENT * PHYS_DIVERGENT);
    if (!grows && !may_overflow)
        return PHYS_CONVERGENT;
    Extent extent = measure(system);
    double path = extent.velocity * phys_step_length(&system->last_time, system->last_time.last);
    bool overflows = extent.overflowed != NO_PARTICLE;
    grows = grows && path > extent.position / 2 && extent.fastest != NO_PARTICLE;
    watch->found = overflows || grows;
    *particle = (uint32_t)(overflows ? extent.overflowed : extent.fastest);
    return overflows ? PHYS_OVERFLOW : grows ? PHYS_GROWTH : PHYS_CONVERGENT;
}
