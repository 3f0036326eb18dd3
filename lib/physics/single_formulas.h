// single_formulas.h: formulas for single particles, LANES at once (spec physics.md): forces (4.2), motion (4.3) and
// soft boundaries of barriers (4.4). Symbols: v velocity, p position, r radius, m mass, q charge, S strength.
//
// Each force has a formula single_NAME, and its potential potential_NAME or NO_POTENTIAL(Single, NAME). The force is
// the negative gradient of the potential, and the potential of a barrier is 0 between its boundaries.
#pragma once

#include "maths/random.h"
#include "physics/integrate.h"
#include "physics/kernels.h"
#include "physics/lanes.h"

// LANES particles in a step. Component k of a vector is at [k · step]. With several lanes, the vectors are copies in
// registers (step 1). With one lane, they point into the columns (step is the columns' stride).
typedef struct Block {
    size_t first;  // column of the first lane
    size_t active; // number of lanes that are not anchors
    size_t step;
    Mask live; // lanes that are not anchors
    Real *position;
    Real *velocity;
    Real *force;
    Real mass;
} Block;

#if LANES == 1
// Returns a block that points to particle i in the columns.
KERNEL Block block_at(const Columns *columns, size_t i) {
    return (Block){.first = i,
                   .active = 1,
                   .step = columns->stride,
                   .live = true,
                   .position = columns->position + i,
                   .velocity = columns->velocity + i,
                   .force = columns->force + i,
                   .mass = columns->mass[phys_numbers_at(columns, i)]};
}
#endif

// Inputs of a formula.
typedef struct Singles {
    const IntegratePass *pass;
    const Columns *columns;
    const Force *force;
    size_t n; // dimensions
    Block *block;
} Singles;

KERNEL Real vector_component(PhysVector vector, size_t k) {
    return real_set(phys_at(vector, k));
}

KERNEL Real position_component(const Block *block, size_t k) {
    return block->position[k * block->step];
}

KERNEL Real velocity_component(const Block *block, size_t k) {
    return block->velocity[k * block->step];
}

// Adds component k of a force in the lanes where the force applies.
KERNEL void add_force_component(Block *block, size_t k, Mask applies, Real f) {
    Real *sum = &block->force[k * block->step];
    *sum = real_add_where(applies, *sum, f);
}

KERNEL Mask where_not_zero(Mask mask, Real x) {
    return real_differs_where(mask, x, real_zero());
}

// Potential of a force on single particles. energy.c chooses it by the force's row.
typedef Real SinglePotential(const Singles *s);

// Σ vector_k · p_k
KERNEL Real position_along(const Singles *s, PhysVector vector) {
    Real sum = real_zero();
    for (size_t k = 0; k < s->n; k++)
        sum += vector_component(vector, k) * position_component(s->block, k);
    return sum;
}

// (force_k + acceleration_k · m) · S
KERNEL void single_constant(const Singles *s) {
    const PhysForce *given = &s->force->given;
    for (size_t k = 0; k < s->n; k++) {
        Real acceleration = vector_component(given->vector2, k) * s->block->mass;
        Real sum = vector_component(given->vector, k) + acceleration;
        add_force_component(s->block, k, s->block->live, sum * real_set(s->force->strength));
    }
}

KERNEL Real potential_constant(const Singles *s) {
    const PhysForce *given = &s->force->given;
    Real work = position_along(s, given->vector) + s->block->mass * position_along(s, given->vector2);
    return -real_set(s->force->strength) * work;
}

// S · direction_k · q
KERNEL void single_field(const Singles *s) {
    Real charge = real_load(s->columns->charge + s->block->first);
    for (size_t k = 0; k < s->n; k++) {
        Real along = real_set(s->force->strength) * vector_component(s->force->given.vector, k);
        add_force_component(s->block, k, s->block->live, along * charge);
    }
}

KERNEL Real potential_field(const Singles *s) {
    Real charge = real_load(s->columns->charge + s->block->first);
    return -real_set(s->force->strength) * charge * position_along(s, s->force->given.vector);
}

// r ≠ 0:  − (v_k − flow_k) · c,  c = min(S · sqrt(Σ (v−flow)²) · r^(n−1), m / delta)
KERNEL void single_drag(const Singles *s) {
    PhysVector flow = s->force->given.vector;
    Real square = real_zero();
    for (size_t k = 0; k < s->n; k++) {
        Real relative = velocity_component(s->block, k) - vector_component(flow, k);
        square += relative * relative;
    }
    Real c = real_set(s->force->strength) * real_sqrt(square);
    c *= real_load(s->columns->section + s->block->first);
    Real limit = s->block->mass / real_set(s->pass->delta);
    // With this order of the comparison, c stays NaN if it is NaN (0 · ∞), and move_particles ignores the sum of
    // forces. With the opposite order, c would be the limit, which stops the particle.
    c = real_select(real_less(limit, c), limit, c);
    Mask applies = where_not_zero(s->block->live, real_load(s->columns->radius + s->block->first));
    for (size_t k = 0; k < s->n; k++) {
        Real relative = velocity_component(s->block, k) - vector_component(flow, k);
        Real *sum = &s->block->force[k * s->block->step];
        *sum = real_sub_where(applies, *sum, relative * c);
    }
}

NO_POTENTIAL(Single, drag)

// Sets the lanes in which r ≠ 0 and m ≠ 0. Returns m − r^n · density.
KERNEL Real buoyant_mass(const Singles *s, Mask *applies) {
    Real displaced = real_load(s->columns->volume + s->block->first) * real_set(s->force->given.density);
    *applies = where_not_zero(s->block->live, real_load(s->columns->radius + s->block->first));
    *applies = where_not_zero(*applies, s->block->mass);
    return s->block->mass - displaced;
}

// r ≠ 0 and m ≠ 0:  gravity_k · (S · (m − r^n · density))
KERNEL void single_buoyancy(const Singles *s) {
    Mask applies;
    Real weight = real_set(s->force->strength) * buoyant_mass(s, &applies);
    for (size_t k = 0; k < s->n; k++)
        add_force_component(s->block, k, applies, vector_component(s->force->given.vector, k) * weight);
}

KERNEL Real potential_buoyancy(const Singles *s) {
    Mask applies;
    Real weight = real_set(s->force->strength) * buoyant_mass(s, &applies);
    return real_or_zero(applies, -weight * position_along(s, s->force->given.vector));
}

// Returns the number of items of the stream that have been used in this frame: in earlier steps, and by earlier
// particles in this step.
KERNEL uint64_t items_before(const Singles *s, size_t lane) {
    const uint32_t *draws = s->columns->random_offset;
    return s->force->item + (draws ? s->n * draws[s->block->first + lane] : s->pass->draw_count);
}

#if LANES == 1

// The force is strength · normal(seed)[index]. `index` increases by one for each component of each particle. It
// continues to count from step to step within a frame.
KERNEL void single_random(const Singles *s) {
    uint64_t item = items_before(s, 0);
    for (size_t k = 0; k < s->n; k++)
        add_force_component(s->block, k, s->block->live,
                            s->force->strength * random_normal(s->force->given.key, item + k));
}

#else

// Returns how many live lanes, starting at `lane`, use consecutive items of the random stream.
KERNEL size_t consecutive_draws(const Singles *s, size_t lane, unsigned bits, size_t active) {
    const uint32_t *draws = s->columns->random_offset;
    if (!draws)
        return active;
    size_t count = 1;
    while (lane + count < LANES && bits >> (lane + count) & 1 &&
           draws[s->block->first + lane + count] == draws[s->block->first + lane] + count)
        count++;
    return count;
}

// Returns `count` numbers of a stream from `item` on: some of pass->draws, or `own`, which has space for them. `rest`:
// count of the numbers that are drawn for the rest of the range, or more if some particles are anchors. The block is
// not a parameter, because its address would keep its vectors out of registers.
static const double *draw(const IntegratePass *pass, const Force *force, uint64_t item, size_t count, size_t rest,
                          double *own) {
    Draws *draws = pass->draws;
    if (!draws->force) {
        draws->force = force;
        draws->count = 0;
    }
    if (draws->force != force || pass->columns->random_offset) {
        random_normals(LANES_LEVEL, force->given.key, item, count, own);
        return own;
    }
    if (draws->count < count || item + count > draws->first + draws->count) {
        enum { MAX = sizeof draws->numbers / sizeof *draws->numbers };
        draws->first = item;
        draws->count = rest < MAX ? rest : MAX;
        random_normals(LANES_LEVEL, force->given.key, item, draws->count, draws->numbers);
    }
    return draws->numbers + (item - draws->first);
}

// Computes S · normal(seed)[index] for many lanes at once. Anchors use no items.
KERNEL void single_random(const Singles *s) {
    double normals[PHYS_VECTOR_DIMENSIONS * LANES], lanes[PHYS_VECTOR_DIMENSIONS][LANES] = {{0}};
    const double *next = normals;
    unsigned bits = mask_bits(s->block->live);
    for (size_t drawn = 0, lane = 0; drawn < s->block->active; lane++) {
        if (!(bits >> lane & 1))
            continue;
        size_t count = consecutive_draws(s, lane, bits, s->block->active - drawn);
        size_t rest = s->n * (s->pass->end - s->block->first);
        const double *numbers =
            draw(s->pass, s->force, items_before(s, lane), s->n * count, rest, normals + s->n * drawn);
        next = drawn ? normals : numbers; // without random_offset, there is only one iteration
        drawn += count;
        lane += count - 1;
    }
    Real parts[PHYS_VECTOR_DIMENSIONS];
    if (s->n == 2 && bits == ALL_LANES) { // fast, because no numbers are stored one by one
        static const uint32_t pairs[] = {0, 2, 4, 6, 8, 10, 12, 14};
        real_load_pairs(next, pairs, parts);
    } else {
        for (size_t lane = 0; lane < LANES; lane++)
            for (size_t k = 0; k < s->n && bits >> lane & 1; k++)
                lanes[k][lane] = *next++;
        for (size_t k = 0; k < s->n; k++)
            parts[k] = real_load(lanes[k]);
    }
    for (size_t k = 0; k < s->n; k++)
        add_force_component(s->block, k, s->block->live, real_set(s->force->strength) * parts[k]);
}

#endif

NO_POTENTIAL(Single, random)

// start + Σ (p_k − position_k) · normal_k
KERNEL Real height_above(const PhysForce *barrier, size_t n, const Block *block, Real start) {
    Real sum = start;
    for (size_t k = 0; k < n; k++) {
        Real along = position_component(block, k) - vector_component(barrier->vector, k);
        sum += along * vector_component(barrier->vector2, k);
    }
    return sum;
}

// The soft boundaries of a barrier.
typedef struct Soft {
    Mask below, above; // lanes in which a particle is beyond the minimum or the maximum
    Real depth;        // distance by which it is; other lanes are undefined
} Soft;

// With s = Σ (p_k − position_k) · normal_k:
//   min > 0 and 0 ≤ s < min:  below, depth = min − s
//   else s > max:             above, depth = s − max
// Returns false if no lane is beyond a boundary.
KERNEL bool find_soft(const Singles *s, Soft *soft) {
    const PhysForce *barrier = &s->force->given;
    if (!barrier->has_minimum && !barrier->has_maximum)
        return false;
    Real height = height_above(barrier, s->n, s->block, real_zero());
    Real minimum = real_set(barrier->minimum), maximum = real_set(barrier->maximum);
    soft->below = soft->above = mask_first(0);
    if (barrier->has_minimum && barrier->minimum > 0)
        soft->below = real_less_where(real_at_most_where(s->block->live, real_zero(), height), height, minimum);
    if (barrier->has_maximum)
        soft->above = real_less_where(s->block->live & mask_not(soft->below), maximum, height);
    soft->depth = real_select(soft->below, minimum - height, height - maximum);
    return mask_any(soft->below | soft->above);
}

// below:  + normal_k · (depth^power · S);  above:  − normal_k · (depth^power · S)
KERNEL void single_barrier(const Singles *s) {
    const PhysForce *barrier = &s->force->given;
    Soft soft;
    if (!find_soft(s, &soft))
        return;
    Real size = real_pow(false, soft.below | soft.above, soft.depth, barrier->power) * real_set(s->force->strength);
    for (size_t k = 0; k < s->n; k++) {
        Real f = vector_component(barrier->vector2, k) * size, *sum = &s->block->force[k * s->block->step];
        *sum = real_sub_where(soft.above, real_add_where(soft.below, *sum, f), f);
    }
}

KERNEL Real potential_barrier(const Singles *s) {
    Soft soft;
    if (!find_soft(s, &soft))
        return real_zero();
    Mask beyond = soft.below | soft.above;
    return real_or_zero(beyond, real_pow_integral(s->force->strength, beyond, soft.depth, s->force->given.power));
}

// Applies one force of STAGE_SINGLE or STAGE_BARRIER.
KERNEL void single_apply(const Singles *s) {
    switch (s->force->given.kind) {
#define SINGLE(KIND, name, ...)                                                                                        \
    case PHYS_##KIND:                                                                                                  \
        single_##name(s);                                                                                              \
        break;
#define OTHER(KIND, ...) case PHYS_##KIND:
        PHYS_FORCES(PHYS_NO_ROW, PHYS_NO_ROW, SINGLE, SINGLE)
        PHYS_FORCES(OTHER, OTHER, PHYS_NO_ROW, PHYS_NO_ROW)
#undef SINGLE
#undef OTHER
    case PHYS_FORCE_KINDS:
        __builtin_unreachable(); // these stages have no other kinds
    }
}

// v_k + F_k · c
KERNEL Real accelerated_component(const Block *block, size_t k, Real c) {
    return velocity_component(block, k) + block->force[k * block->step] * c;
}

// m ≠ 0 and every component of the force is finite:
//     c = delta / m;  v_k = v_k + F_k · c
//     if speed_of_light > 0 and Σ v_k² > speed_of_light²:  v_k = v_k · (speed_of_light / sqrt(Σ v_k²))
// p_k = p_k + v_k · delta
KERNEL void move_particles(size_t n, Block *block, double delta, double speed_of_light) {
    Mask pushed = where_not_zero(block->live, block->mass);
    for (size_t k = 0; k < n; k++)
        pushed = real_at_most_where(pushed, real_absolute(block->force[k * block->step]), real_set(DBL_MAX));
    Real c = real_set(delta) / block->mass, square = real_zero();
    for (size_t k = 0; k < n; k++) {
        Real v = accelerated_component(block, k, c);
        square += v * v;
    }
    Mask fast = mask_first(0);
    Real factor = real_zero();
    if (speed_of_light > 0)
        fast = real_less_where(pushed, real_set(speed_of_light * speed_of_light), square);
    if (mask_any(fast))
        factor = real_set(speed_of_light) / real_sqrt(square);
    for (size_t k = 0; k < n; k++) {
        Real v = accelerated_component(block, k, c), *velocity = &block->velocity[k * block->step];
        if (mask_any(fast))
            v = real_select(fast, v * factor, v);
        *velocity = real_select(pushed, v, *velocity);
        block->position[k * block->step] = position_component(block, k) + *velocity * real_set(delta);
    }
}
