// pair_sum.h: adds the terms of pairs to the sums of forces.
#pragma once

#include "physics/pair_geometry.h"

// The terms that a tile (kernel_pair.c) subtracts from the sums of its columns, by component and column. Each lane is a
// row of the tile.
typedef struct Tile {
    Real lead[PHYS_VECTOR_DIMENSIONS][LANES];
    Real rest[PHYS_MAX_TERMS][PHYS_VECTOR_DIMENSIONS][LANES];
    unsigned hits; // bit set of the forces that have written to `rest`
} Tile;

// Adds a force to `sum` in the lanes where it applies. Unless `column` is NULL, also stores component m of the force in
// column[m][k], with +0.0 in the lanes where the force does not apply.
KERNEL void add_term(PairShape shape, const PairGeometry *pair, Mask applies, Real coefficient, Real *sum,
                     Real (*column)[LANES], size_t k) {
    for (size_t m = 0; m < shape.dimensions; m++) {
        Real f = pair->unit[m] * coefficient;
        sum[m] = real_add_where(applies, sum[m], f);
        if (column)
            column[m][k] = real_or_zero(applies, f);
    }
}

static void clear_terms(Real (*column)[LANES]) {
    for (size_t m = 0; m < PHYS_VECTOR_DIMENSIONS; m++)
        for (size_t k = 0; k < LANES; k++)
            column[m][k] = real_zero();
}

// Adds the single force of REST_SPRING.
KERNEL void add_spring(const PairPass *pass, PairShape shape, const PairGeometry *pair, Real *sum) {
    Pairs pairs = {.term = pass->terms, .geometry = pair, .linear = true};
    add_term(shape, pair, pair_in_contact(pair), pair_collision(&pairs), sum, NULL, 0);
}

// Adds the forces after the lead, or all forces if there is no lead. `tile` and `k` are as in add_column.
KERNEL void add_rest(const PairPass *pass, PairShape shape, const PairGeometry *pair, const PairEnd *target,
                     const PairEnd *partner, Real *sum, Tile *tile, size_t k) {
    Mask contact = pair_in_contact(pair);
    if (mask_any(contact))
        contact = both_nonzero(contact, target->radius, partner->radius);
    else if (rest_needs_contact(shape))
        return;
    for (size_t t = shape.lead != LEAD_NONE; t < pass->term_count; t++) {
        Real coefficient;
        Pairs pairs = {&pass->terms[t], pair, target, partner, contact, shape.rest == REST_PLAIN, false};
        Mask applies = pair_apply(&pairs, rest_needs_contact(shape), &coefficient);
        if (!mask_any(applies))
            continue;
        if (tile && !(tile->hits >> t & 1)) {
            clear_terms(tile->rest[t]);
            tile->hits |= 1u << t;
        }
        add_term(shape, pair, applies, coefficient, sum, tile ? tile->rest[t] : NULL, k);
    }
}
