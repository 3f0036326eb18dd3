// kernel_integrate.c: single-particle forces, barriers, motion and reflections, for LANES particles at once. With one
// lane it supports any number of dimensions.
#include "physics/kernels.h"
#include "physics/single_formulas.h"

#include <string.h>

KERNEL void apply_forces(const IntegratePass *pass, size_t n, Block *block) {
    Singles singles = {.pass = pass, .columns = pass->columns, .n = n, .block = block};
    for (uint32_t f = 0; f < pass->force_count; f++) {
        singles.force = pass->forces[f];
        single_apply(&singles);
    }
}

#if LANES == 1

static void integrate_particle(IntegratePass *pass, size_t i) {
    const Columns *columns = pass->columns;
    size_t n = columns->dimensions;
    Block block = block_at(columns, i);
    double *before = phys_acceleration(columns) + n;
    for (size_t k = 0; k < n && pass->barrier_count; k++)
        before[k] = velocity_component(&block, k);
    apply_forces(pass, n, &block);
    pass->draw_count += n;
    move_particles(n, &block, pass->delta, pass->speed_of_light);
    if (pass->barrier_count)
        phys_integrate_reflect(pass, i, before);
}

void integrate_all_one(IntegratePass *pass, size_t first, size_t end) {
    const Columns *columns = pass->columns;
    for (size_t i = first; i < end; i++) {
        if (!columns->anchor[i])
            integrate_particle(pass, i);
        for (size_t k = 0; k < columns->dimensions && !pass->keep_force; k++)
            columns->force[k * columns->stride + i] = 0;
    }
}

#else

// Returns the lanes whose particles some barrier must reflect: x of barrier.c, the height above it, is negative or NaN.
KERNEL Mask lanes_behind_barrier(const IntegratePass *pass, size_t n, const Block *block) {
    Mask clear = block->live;
    const Force *const *barriers = phys_barriers(pass);
    const Columns *columns = pass->columns;
    const double *radius = columns->radius;
    Real start = real_set(-0.0) - (columns->uniform_mass ? real_set(radius[0]) : real_load(radius + block->first));
    for (uint32_t b = 0; b < pass->barrier_count; b++)
        clear = real_at_most_where(clear, real_zero(), height_above(&barriers[b]->given, n, block, start));
    return block->live & mask_not(clear);
}

KERNEL void reflect_lanes(const IntegratePass *pass, size_t n, const Block *block, const Real *before) {
    const Columns *columns = pass->columns;
    unsigned bits = mask_bits(lanes_behind_barrier(pass, n, block));
    if (!bits)
        return;
    double lanes[PHYS_VECTOR_DIMENSIONS][LANES];
    for (size_t k = 0; k < n; k++) {
        real_store(lanes[k], before[k]);
        // A reflection moves a particle again with the same force, which it reads from Columns.force.
        real_store_where(block->live, columns->force + k * columns->stride + block->first, block->force[k]);
    }
    for (; bits; bits &= bits - 1) {
        size_t lane = (size_t)__builtin_ctz(bits);
        double velocity_before[PHYS_VECTOR_DIMENSIONS];
        for (size_t k = 0; k < n; k++)
            velocity_before[k] = lanes[k][lane];
        phys_integrate_reflect(pass, block->first + lane, velocity_before);
    }
}

KERNEL Mask live_lanes(const Columns *columns, size_t i, size_t count) {
    unsigned char anchors[8]; // always 8, because columns->anchor is readable beyond its end
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

KERNEL void integrate_block(IntegratePass *pass, size_t n, size_t i, size_t count) {
    const Columns *columns = pass->columns;
    Real position[PHYS_VECTOR_DIMENSIONS], velocity[PHYS_VECTOR_DIMENSIONS], force[PHYS_VECTOR_DIMENSIONS];
    Real before[PHYS_VECTOR_DIMENSIONS];
    Mask live = columns->no_anchors ? mask_first(count) : live_lanes(columns, i, count);
    Real mass = columns->uniform_mass ? real_set(columns->mass[0]) : real_load(columns->mass + i);
    Block block = {i, 0, 1, live, position, velocity, force, mass};
    block.active = (size_t)__builtin_popcount(mask_bits(block.live));
    for (size_t k = 0; k < n; k++) {
        position[k] = real_load(columns->position + k * columns->stride + i);
        velocity[k] = before[k] = real_load(columns->velocity + k * columns->stride + i);
        force[k] = real_load(columns->force + k * columns->stride + i);
    }
    apply_forces(pass, n, &block);
    pass->draw_count += n * block.active;
    move_particles(n, &block, pass->delta, pass->speed_of_light);
    for (size_t k = 0; k < n; k++) {
        real_store_where(block.live, columns->position + k * columns->stride + i, position[k]);
        real_store_where(block.live, columns->velocity + k * columns->stride + i, velocity[k]);
        if (pass->keep_force)
            real_store_where(block.live, columns->force + k * columns->stride + i, force[k]);
    }
    if (pass->barrier_count)
        reflect_lanes(pass, n, &block, before);
    for (size_t k = 0; k < n && !pass->keep_force; k++)
        real_store_where(mask_first(count), columns->force + k * columns->stride + i, real_zero());
}

KERNEL void integrate_range(IntegratePass *pass, size_t n, size_t first, size_t end) {
    for (size_t i = first; i < end && !phys_integrate_stopped(pass); i += LANES)
        integrate_block(pass, n, i, end - i);
}

void PER_ISA(integrate_all)(IntegratePass *pass, size_t first, size_t end) {
#define INTEGRATE(n) integrate_range(pass, n, first, end)
    FOR_DIMENSIONS(pass->columns->dimensions, INTEGRATE);
}

// Returns true if all parts are finite in all lanes. Sets `zeros` to the lanes in which some part is 0.
KERNEL bool all_finite(const Real *parts, size_t count, Lanes *zeros) {
    Mask finite = mask_first(LANES), large = finite;
    for (size_t k = 0; k < count; k++) {
        large = real_differs_where(large, parts[k], real_zero());
        finite = real_at_most_where(finite, parts[k] - parts[k], real_zero());
    }
    *zeros = mask_bits(large) ^ ALL_LANES;
    return mask_bits(finite) == ALL_LANES;
}

// Returns true if, in this lane, a part and the corresponding number in the row are zeros of different sign.
KERNEL bool has_other_zero(const double *row, const Real *parts, size_t count, size_t lane) {
    for (size_t k = 0; k < count; k++)
        if (row[k] == 0 && parts[k][lane] == 0 && signbit(row[k]) != signbit(parts[k][lane]))
            return true;
    return false;
}

// Copies `parts` to the rows of LANES particles. A row has 2 n numbers.
KERNEL void write_lane_rows(size_t n, const uint32_t *order, double *rows, const Real *parts) {
    double *row[LANES];
    for (size_t lane = 0; lane < LANES; lane++)
        row[lane] = rows + 2 * n * order[lane];
    if (n == 1) {
        for (size_t lane = 0; lane < LANES; lane++)
            for (size_t k = 0; k < 2; k++)
                row[lane][k] = parts[k][lane];
        return;
    }
    real_store_rows(row, parts);
    for (size_t lane = 0; lane < LANES && n == 3; lane++)
        row[lane] += 2;
    if (n == 3)
        real_store_rows(row, parts + 2);
}

// With PhysTime.keep_last_finite, a number in a row stays if the result equals it. Equal numbers have the same bits,
// except for zeros of different sign. So in all other cases finite results can simply be copied.
KERNEL size_t write_range(const Columns *columns, size_t n, const uint32_t *order, double *rows, size_t first,
                          size_t end) {
    // AHEAD: prefetch distance in rows. MANY: number of rows above which they do not fit into the caches.
    enum { AHEAD = 64, MANY = 30000 };
    bool many = columns->count > MANY;
    for (; first + LANES <= end; first += LANES) {
        Real parts[2 * PHYS_VECTOR_DIMENSIONS];
        for (size_t k = 0; k < n; k++) {
            parts[k] = real_load(columns->position + k * columns->stride + first);
            parts[n + k] = real_load(columns->velocity + k * columns->stride + first);
        }
        if (many && first + AHEAD + LANES <= end)
            for (size_t lane = 0; lane < LANES; lane++)
                __builtin_prefetch(rows + 2 * n * order[first + AHEAD + lane], 1);
        Lanes zeros;
        if (!all_finite(parts, 2 * n, &zeros))
            return first;
        for (; zeros; zeros &= zeros - 1) {
            size_t lane = (size_t)__builtin_ctz(zeros);
            if (has_other_zero(rows + 2 * n * order[first + lane], parts, 2 * n, lane))
                return first;
        }
        write_lane_rows(n, order + first, rows, parts);
    }
    return first;
}

size_t PER_ISA(write_rows)(const Columns *columns, const uint32_t *order, double *rows, size_t first, size_t end) {
#define WRITE(n) write_range(columns, n, order, rows, first, end)
    return FOR_DIMENSIONS(columns->dimensions, WRITE);
}

#endif
