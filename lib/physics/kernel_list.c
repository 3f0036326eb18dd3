// kernel_list.c: forces of bounded range, with neighbour lists. Each lane is a target and processes its own list, in
// the order of the pass. Every pair is computed twice, once for each particle.
#include "physics/pair_geometry.h"

// Returns the index of the radius in a quad of ListView.packed. A quad holds x, y, radius or, in three dimensions, x,
// y, z, radius.
KERNEL size_t radius_component(size_t dimensions) {
    return dimensions < 3 ? 2 : 3;
}

// Returns true if ListView.packed uses PHYS_PAIR: in two dimensions, if all particles have the same radius.
KERNEL bool uses_pairs(size_t dimensions, bool one_size) {
    return dimensions == 2 && one_size;
}

KERNEL PairEnd packed_end(PairShape shape, const ListView *view, const uint32_t *offsets) {
    Real parts[4];
    PairEnd end = {.radius = real_set(view->one_radius), .mass = real_zero(), .charge = real_zero()};
    if (uses_pairs(shape.dimensions, shape.one_size))
        real_load_pairs(view->packed, offsets, parts);
    else
        real_load_quads(view->packed, offsets, parts);
    for (size_t k = 0; k < shape.dimensions; k++)
        end.position[k] = parts[k];
    if (!shape.one_size)
        end.radius = parts[radius_component(shape.dimensions)];
    if (shape.rest == REST_ANY) {
        uint32_t index[LANES];
        for (int lane = 0; lane < LANES; lane++)
            index[lane] = offsets[lane] / PHYS_QUAD * 2;
        end.mass = real_gather(view->sources, index);
        end.charge = real_gather(view->sources + 1, index);
    }
    return end;
}

// Loads an attribute of LANES particles with consecutive sorted indices, starting at `index`.
KERNEL Real load_sorted(const double *column, const ListView *view, size_t index) {
    return view->direct ? real_load(column + index) : real_gather(column, view->column + index);
}

KERNEL void block_forces(const PairPass *pass, PairShape shape, const ListView *view, size_t block) {
    const uint32_t *entries = view->entries + view->at[block], *column = view->column + block * LANES;
    size_t length = view->max_length[block], left = view->regular - block * LANES;
    if (!length)
        return;
    Mask live = mask_first(left);
    uint32_t self[LANES];
    for (uint32_t lane = 0; lane < LANES; lane++)
        self[lane] =
            ((uint32_t)(block * LANES) + lane) * (uses_pairs(shape.dimensions, shape.one_size) ? PHYS_PAIR : PHYS_QUAD);
    PairEnd target = packed_end(shape, view, self);
    Real sum[PHYS_VECTOR_DIMENSIONS];
    for (size_t m = 0; m < shape.dimensions; m++)
        sum[m] = load_sorted(pass->force + m * pass->stride, view, block * LANES);
    for (size_t k = 0; k < length; k++) {
        PairEnd partner = packed_end(shape, view, entries + k * LANES);
        PairGeometry pair;
        if (!pair_geometry(shape, &target, &partner, live, &pair))
            continue;
        if (shape.rest == REST_SPRING)
            add_spring(pass, shape, &pair, sum);
        else
            add_rest(pass, shape, &pair, &target, &partner, sum, NULL, 0);
    }
    for (size_t m = 0; m < shape.dimensions; m++) {
        double *force = pass->force + m * pass->stride;
        if (view->direct)
            real_store_where(live, force + block * LANES, sum[m]);
        else
            real_scatter_where(live, force, column, sum[m]);
    }
}

KERNEL void blocks(const PairPass *pass, PairShape shape, const ListView *view, size_t first, size_t end) {
    for (size_t block = first; block < end; block++)
        block_forces(pass, shape, view, block);
}

static bool all_powers_plain(const PairPass *pass) {
    bool plain = true;
    for (size_t t = 0; t < pass->term_count; t++)
        plain &= pow_is_plain(pass->terms[t].power);
    return plain;
}

static bool is_spring(const PairPass *pass, const ListView *view) {
    const PairTerm *term = pass->terms;
    return pass->term_count == 1 && term->kind == PHYS_COLLISION && term->power == 1 && !(term->bound < INFINITY) &&
           view->same_radii;
}

#define LIST_SHAPES(n, one_size)                                                                                       \
    do {                                                                                                               \
        if (is_spring(pass, view))                                                                                     \
            blocks(pass, (PairShape){n, LEAD_NONE, REST_SPRING, one_size}, view, first, end);                          \
        else if (all_powers_plain(pass))                                                                               \
            blocks(pass, (PairShape){n, LEAD_NONE, REST_PLAIN, one_size}, view, first, end);                           \
        else                                                                                                           \
            blocks(pass, (PairShape){n, LEAD_NONE, REST_CONTACT, one_size}, view, first, end);                         \
    } while (0)

#define LIST_KERNEL(n)                                                                                                 \
    static void forces_##n(const PairPass *pass, const ListView *view, size_t first, size_t end) {                     \
        if (view->sources)                                                                                             \
            blocks(pass, (PairShape){n, LEAD_NONE, REST_ANY, false}, view, first, end);                                \
        else if (view->one_radius > 0)                                                                                 \
            LIST_SHAPES(n, true);                                                                                      \
        else                                                                                                           \
            LIST_SHAPES(n, false);                                                                                     \
    }
LIST_KERNEL(1)
LIST_KERNEL(2)
LIST_KERNEL(3)

void PER_ISA(list_forces)(const PairPass *pass, const ListView *view, size_t first, size_t end) {
#define FORCES(n) forces_##n(pass, view, first, end)
    FOR_DIMENSIONS(pass->dimensions, FORCES);
}

KERNEL bool refresh_range(const PairPass *pass, const ListView *view, size_t dimensions, size_t first, size_t end) {
    bool one_size = view->one_radius > 0, hold = !one_size || view->same_radii,
         pairs = uses_pairs(dimensions, one_size);
    for (size_t s = first; s < end; s += LANES) {
        Mask live = mask_first(end - s);
        Real parts[4] = {real_zero(), real_zero(), real_zero(), real_zero()}, square = real_zero();
        for (size_t k = 0; k < dimensions; k++) {
            parts[k] = load_sorted(pass->position + k * pass->stride, view, s);
            Real d = parts[k] - real_load(view->built[k] + s);
            square += d * d;
        }
        Real radius = real_zero(), built = radius;
        if (!pairs || !view->same_radii)
            radius = built = real_load(view->radius + s);
        if (!view->same_radii)
            radius = load_sorted(pass->radius, view, s);
        parts[radius_component(dimensions)] = radius;
        if (pairs)
            real_store_pairs(view->packed + PHYS_PAIR * s, parts);
        else
            real_store_quads(view->packed + PHYS_QUAD * s, parts);
        // If the distance is NaN, the particle counts as moved too far.
        Mask still = real_at_most_where(live, square, real_set(view->max_move_squared));
        still = real_at_most_where(still, radius, built);
        hold &= mask_bits(still) == mask_bits(live);
    }
    return hold;
}

static void refresh_sources(const PairPass *pass, const ListView *view, size_t first, size_t end) {
    for (size_t s = first; s < end; s++) {
        size_t column = view->direct ? s : view->column[s];
        view->sources[2 * s] = pass->mass[column];
        view->sources[2 * s + 1] = pass->charge[column];
    }
}

bool PER_ISA(list_refresh)(const PairPass *pass, const ListView *view, size_t first, size_t end) {
    if (view->sources)
        refresh_sources(pass, view, first, end);
#define REFRESH(n) refresh_range(pass, view, n, first, end)
    return FOR_DIMENSIONS(pass->dimensions, REFRESH);
}

KERNEL void apply_range(const PairPass *pass, PairShape shape, const uint32_t *targets, size_t count, size_t first,
                        size_t end) {
    Mask live = mask_first(count);
    PairEnd target;
    Real sum[PHYS_VECTOR_DIMENSIONS];
    for (size_t m = 0; m < shape.dimensions; m++) {
        target.position[m] = real_gather(pass->position + m * pass->stride, targets);
        sum[m] = real_gather(pass->force + m * pass->stride, targets);
    }
    target.radius = real_gather(pass->radius, targets);
    target.mass = real_gather(pass->mass, targets);
    target.charge = real_gather(pass->charge, targets);
    for (size_t j = first; j < end; j++) {
        // If j is itself a target, the distance in its lane is 0, and pair_geometry marks the pair as invalid.
        PairEnd partner = pair_partner(pass, shape, j);
        PairGeometry pair;
        if (pair_geometry(shape, &target, &partner, live, &pair))
            add_rest(pass, shape, &pair, &target, &partner, sum, NULL, 0);
    }
    for (size_t m = 0; m < shape.dimensions; m++)
        real_scatter_where(live, pass->force + m * pass->stride, targets, sum[m]);
}

void PER_ISA(range_forces)(const PairPass *pass, const uint32_t *targets, size_t count, size_t first, size_t end) {
#define APPLY(n) apply_range(pass, (PairShape){n, LEAD_NONE, REST_ANY, false}, targets, count, first, end)
    FOR_DIMENSIONS(pass->dimensions, APPLY);
}
