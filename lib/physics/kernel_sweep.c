// kernel_sweep.c: forces on single particles, barriers and motion for LANES particles at once; the formulas are those
// of force_single.c, barrier.c and integrate.c.
#include "maths/random.h"
#include "physics/kernels.h"
#include "physics/simd.h"
#include "physics/sweep.h"

#include <string.h>

// LANES particles on their way through a step.
typedef struct Block {
    size_t first;
    size_t active; // lanes that are not anchors
    Mask live;     // those lanes
    Real place[PHYS_VECTOR_DIMENSIONS];
    Real velocity[PHYS_VECTOR_DIMENSIONS];
    Real force[PHYS_VECTOR_DIMENSIONS];
    Real mass;
} Block;

KERNEL Real vector_part(PhysVector vector, size_t k) {
    return real_set(phys_at(vector, k));
}

// (force_k + acceleration_k · m) · S
KERNEL void add_constant(const Force *force, size_t n, Block *block) {
    for (size_t k = 0; k < n; k++) {
        Real acceleration = real_mul(vector_part(force->given.vector2, k), block->mass);
        Real sum = real_add(vector_part(force->given.vector, k), acceleration);
        block->force[k] = real_add_where(block->live, block->force[k], real_mul(sum, real_set(force->strength)));
    }
}

// S · normal(seed)[index]; anchors take no items.
KERNEL void add_random(const Force *force, size_t n, Block *block, uint64_t *item) {
    double normals[PHYS_VECTOR_DIMENSIONS * LANES], lanes[PHYS_VECTOR_DIMENSIONS][LANES] = {{0}};
    random_normals(LANES_LEVEL, force->given.key, *item, n * block->active, normals);
    *item += n * block->active;
    unsigned bits = mask_bits(block->live);
    const double *next = normals;
    for (size_t lane = 0; lane < LANES; lane++)
        for (size_t k = 0; k < n && bits >> lane & 1; k++)
            lanes[k][lane] = *next++;
    for (size_t k = 0; k < n; k++) {
        Real f = real_mul(real_set(force->strength), real_load(lanes[k]));
        block->force[k] = real_add_where(block->live, block->force[k], f);
    }
}

// S · direction_k · q
KERNEL void add_field(const Force *force, const Columns *columns, size_t n, Block *block) {
    Real charge = real_load(columns->charge + block->first);
    for (size_t k = 0; k < n; k++) {
        Real f = real_mul(real_mul(real_set(force->strength), vector_part(force->given.vector, k)), charge);
        block->force[k] = real_add_where(block->live, block->force[k], f);
    }
}

// r ≠ 0:  − (v_k − flow_k) · c,  c = min(S · sqrt(Σ (v−flow)²) · r^(n−1), m / delta)
KERNEL void add_drag(const Force *force, const Columns *columns, size_t n, double delta, Block *block) {
    Real relative[PHYS_VECTOR_DIMENSIONS], square = real_zero();
    for (size_t k = 0; k < n; k++) {
        relative[k] = real_sub(block->velocity[k], vector_part(force->given.vector, k));
        square = real_add(square, real_mul(relative[k], relative[k]));
    }
    Real coefficient = real_mul(real_set(force->strength), real_sqrt(square));
    coefficient = real_mul(coefficient, real_load(columns->section + block->first));
    Real limit = real_div(block->mass, real_set(delta));
    coefficient = real_select(real_less(limit, coefficient), limit, coefficient);
    Mask applies = real_differs_where(block->live, real_load(columns->radius + block->first), real_zero());
    for (size_t k = 0; k < n; k++)
        block->force[k] = real_sub_where(applies, block->force[k], real_mul(relative[k], coefficient));
}

// r ≠ 0 and m ≠ 0:  gravity_k · (S · (m − r^n · density))
KERNEL void add_buoyancy(const Force *force, const Columns *columns, size_t n, Block *block) {
    Real displaced = real_mul(real_load(columns->volume + block->first), real_set(force->given.density));
    Real weight = real_mul(real_set(force->strength), real_sub(block->mass, displaced));
    Mask applies = real_differs_where(block->live, real_load(columns->radius + block->first), real_zero());
    applies = real_differs_where(applies, block->mass, real_zero());
    for (size_t k = 0; k < n; k++) {
        Real f = real_mul(vector_part(force->given.vector, k), weight);
        block->force[k] = real_add_where(applies, block->force[k], f);
    }
}

KERNEL void add_single(SweepPass *pass, size_t n, uint32_t number, Block *block) {
    const Force *force = pass->singles[number];
    switch (force->given.kind) {
    case PHYS_CONSTANT:
        add_constant(force, n, block);
        break;
    case PHYS_RANDOM:
        add_random(force, n, block, &pass->items[number]);
        break;
    case PHYS_FIELD:
        add_field(force, pass->columns, n, block);
        break;
    case PHYS_DRAG:
        add_drag(force, pass->columns, n, pass->delta, block);
        break;
    default:
        add_buoyancy(force, pass->columns, n, block);
        break;
    }
}

// start + Σ (p_k − position_k) · normal_k
KERNEL Real height_above(const PhysForce *barrier, size_t n, const Block *block, Real start) {
    Real sum = start;
    for (size_t k = 0; k < n; k++) {
        Real along = real_sub(block->place[k], vector_part(barrier->vector, k));
        sum = real_add(sum, real_mul(along, vector_part(barrier->vector2, k)));
    }
    return sum;
}

// x^power in the lanes of a mask
static __attribute__((noinline)) Real power_where(Mask mask, Real x, double power) {
    double lanes[LANES];
    real_store(lanes, x);
    unsigned bits = mask_bits(mask);
    for (unsigned lane = 0; lane < LANES; lane++)
        if (bits >> lane & 1)
            lanes[lane] = phys_power(lanes[lane], power);
    return real_load(lanes);
}

// min > 0 and 0 ≤ s < min:  + normal_k · ((min − s)^power · strength)
// else s > max:             − normal_k · ((s − max)^power · strength)
KERNEL void add_barrier(const Force *force, size_t n, Block *block) {
    const PhysForce *barrier = &force->given;
    Real s = height_above(barrier, n, block, real_zero()), minimum = real_set(barrier->minimum);
    Mask below = mask_first(0), above = mask_first(0);
    if (barrier->has_minimum && barrier->minimum > 0)
        below = real_less_where(real_at_most_where(block->live, real_zero(), s), s, minimum);
    if (barrier->has_maximum)
        above = real_less_where(mask_and(block->live, mask_not(below)), real_set(barrier->maximum), s);
    if (!mask_any(below) && !mask_any(above))
        return;
    Real depth = real_select(below, real_sub(minimum, s), real_sub(s, real_set(barrier->maximum)));
    Real size = real_mul(power_where(mask_or(below, above), depth, barrier->power), real_set(force->strength));
    for (size_t k = 0; k < n; k++) {
        Real f = real_mul(vector_part(barrier->vector2, k), size);
        block->force[k] = real_add_where(below, block->force[k], f);
        block->force[k] = real_sub_where(above, block->force[k], f);
    }
}

// m ≠ 0 and every component of the force is finite:
//     c = delta / m;  v_k = v_k + F_k · c
//     if speed_of_light > 0 and Σ v_k² > speed_of_light²:  v_k = v_k · (speed_of_light / sqrt(Σ v_k²))
// p_k = p_k + v_k · delta
KERNEL void move(const SweepPass *pass, size_t n, Block *block) {
    Mask pushed = real_differs_where(block->live, block->mass, real_zero());
    for (size_t k = 0; k < n; k++)
        pushed = real_at_most_where(pushed, real_absolute(block->force[k]), real_set(DBL_MAX));
    Real c = real_div(real_set(pass->delta), block->mass), square = real_zero(), v[PHYS_VECTOR_DIMENSIONS];
    for (size_t k = 0; k < n; k++) {
        v[k] = real_add(block->velocity[k], real_mul(block->force[k], c));
        square = real_add(square, real_mul(v[k], v[k]));
    }
    double light = pass->speed_of_light;
    Mask fast = mask_first(0);
    if (light > 0)
        fast = real_less_where(pushed, real_set(light * light), square);
    if (mask_any(fast)) {
        Real factor = real_div(real_set(light), real_sqrt(square));
        for (size_t k = 0; k < n; k++)
            v[k] = real_select(fast, real_mul(v[k], factor), v[k]);
    }
    for (size_t k = 0; k < n; k++) {
        block->velocity[k] = real_select(pushed, v[k], block->velocity[k]);
        block->place[k] = real_add(block->place[k], real_mul(block->velocity[k], real_set(pass->delta)));
    }
}

// Lanes that some barrier has to turn back: not x ≥ 0.
KERNEL Mask hits(const SweepPass *pass, size_t n, const Block *block) {
    Mask clear = block->live;
    Real start = real_sub(real_set(-0.0), real_load(pass->columns->radius + block->first));
    for (uint32_t b = 0; b < pass->barrier_count; b++)
        clear = real_at_most_where(clear, real_zero(), height_above(&pass->barriers[b]->given, n, block, start));
    return mask_and(block->live, mask_not(clear));
}

KERNEL void bounce(const SweepPass *pass, size_t n, const Block *block, const Real *before) {
    unsigned bits = mask_bits(hits(pass, n, block));
    if (!bits)
        return;
    double lanes[PHYS_VECTOR_DIMENSIONS][LANES];
    for (size_t k = 0; k < n; k++)
        real_store(lanes[k], before[k]);
    for (; bits; bits &= bits - 1) {
        size_t lane = (size_t)__builtin_ctz(bits);
        double had[PHYS_VECTOR_DIMENSIONS];
        for (size_t k = 0; k < n; k++)
            had[k] = lanes[k][lane];
        phys_sweep_bounce(pass, block->first + lane, had);
    }
}

KERNEL Mask live_lanes(const Columns *columns, size_t i, size_t count) {
    unsigned char anchors[8]; // readable beyond the end
    uint64_t all;
    memcpy(anchors, columns->anchor + i, sizeof anchors);
    memcpy(&all, anchors, sizeof all);
    Mask live = mask_first(count);
    if (!all)
        return live;
    double moving[LANES];
    for (size_t lane = 0; lane < LANES; lane++)
        moving[lane] = anchors[lane] ? 0 : 1;
    return real_differs_where(live, real_load(moving), real_zero());
}

KERNEL void sweep_block(SweepPass *pass, size_t n, size_t i, size_t count) {
    const Columns *columns = pass->columns;
    Block block = {.first = i, .live = live_lanes(columns, i, count), .mass = real_load(columns->mass + i)};
    block.active = (size_t)__builtin_popcount(mask_bits(block.live));
    Real before[PHYS_VECTOR_DIMENSIONS];
    for (size_t k = 0; k < n; k++) {
        block.place[k] = real_load(columns->position + k * columns->stride + i);
        block.velocity[k] = before[k] = real_load(columns->velocity + k * columns->stride + i);
        block.force[k] = real_load(columns->force + k * columns->stride + i);
    }
    for (uint32_t f = 0; f < pass->single_count; f++)
        add_single(pass, n, f, &block);
    for (uint32_t b = 0; b < pass->barrier_count; b++)
        if (pass->barriers[b]->given.has_minimum || pass->barriers[b]->given.has_maximum)
            add_barrier(pass->barriers[b], n, &block);
    move(pass, n, &block);
    for (size_t k = 0; k < n; k++) {
        real_store_where(block.live, columns->position + k * columns->stride + i, block.place[k]);
        real_store_where(block.live, columns->velocity + k * columns->stride + i, block.velocity[k]);
        if (pass->keep_force)
            real_store_where(block.live, columns->force + k * columns->stride + i, block.force[k]);
    }
    if (pass->barrier_count)
        bounce(pass, n, &block, before);
}

KERNEL void sweep(SweepPass *pass, size_t n, size_t first, size_t end) {
    for (size_t i = first; i < end; i += LANES)
        sweep_block(pass, n, i, end - i);
}

static void sweep_1(SweepPass *pass, size_t first, size_t end) {
    sweep(pass, 1, first, end);
}

static void sweep_2(SweepPass *pass, size_t first, size_t end) {
    sweep(pass, 2, first, end);
}

static void sweep_3(SweepPass *pass, size_t first, size_t end) {
    sweep(pass, 3, first, end);
}

void PER_ISA(sweep_all)(SweepPass *pass, size_t first, size_t end) {
    if (pass->columns->dimensions == 1)
        sweep_1(pass, first, end);
    else if (pass->columns->dimensions == 2)
        sweep_2(pass, first, end);
    else
        sweep_3(pass, first, end);
}
