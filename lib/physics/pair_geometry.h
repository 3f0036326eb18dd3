// pair_geometry.h: distances and directions of LANES pairs, and the sums of their forces. Each lane has its own target.
// The partner is the same in all lanes, or each lane has its own.
#pragma once

#include "physics/pair_formulas.h"

// The lead of a pass, if there is one, is its first force, whose range is unlimited. The rest is all other forces of
// the pass. Kernels are specialised on both.
enum { LEAD_NONE = PHYS_FORCE_KINDS }; // value of PairShape.lead if there is no lead; other values are a PhysForceKind
typedef enum PairRest {
    REST_NONE,
    REST_SPRING,  // one collision force with power 1; no radius is 0
    REST_PLAIN,   // contact forces only, and no exponent needs a function call (pow_is_plain)
    REST_CONTACT, // contact forces only
    REST_ANY,
} PairRest;

typedef struct PairShape {
    size_t dimensions;
    int lead;
    PairRest rest;
    bool one_size; // all particles have the same radius
} PairShape;

KERNEL bool rest_needs_contact(PairShape shape) {
    return shape.rest == REST_SPRING || shape.rest == REST_PLAIN || shape.rest == REST_CONTACT;
}

// Returns the quantity that the leading force needs from both particles.
KERNEL ForceNeed lead_need(PairShape shape) {
#define PAIR(KIND, name, SIGN, SOURCE, REACH)                                                                          \
    if (shape.lead == PHYS_##KIND)                                                                                     \
        return NEED_##SOURCE;
    PHYS_FORCES(PAIR, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)
#undef PAIR
    return NEED_NOTHING;
}

KERNEL bool needs_mass(PairShape shape) {
    return lead_need(shape) == NEED_MASS || shape.rest == REST_ANY;
}

KERNEL bool needs_charge(PairShape shape) {
    return lead_need(shape) == NEED_CHARGE || shape.rest == REST_ANY;
}

// Returns K of the leading force.
KERNEL Real lead_coefficient(PairShape shape, const Pairs *pairs) {
#define PAIR(KIND, name, ...)                                                                                          \
    if (shape.lead == PHYS_##KIND)                                                                                     \
        return pair_##name(pairs);
    PHYS_FORCES(PAIR, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)
#undef PAIR
    return real_zero();
}

// Loads LANES targets, starting at column i.
KERNEL PairEnd pair_targets(const PairPass *pass, PairShape shape, size_t i) {
    PairEnd end;
    for (size_t k = 0; k < shape.dimensions; k++)
        end.position[k] = real_load(pass->position + k * pass->stride + i);
    end.radius = real_load(pass->radius + i);
    end.mass = needs_mass(shape) ? real_load(pass->mass + i) : real_zero();
    end.charge = needs_charge(shape) ? real_load(pass->charge + i) : real_zero();
    return end;
}

// Loads partner j into every lane.
KERNEL PairEnd pair_partner(const PairPass *pass, PairShape shape, size_t j) {
    PairEnd end;
    for (size_t k = 0; k < shape.dimensions; k++)
        end.position[k] = real_set(pass->position[k * pass->stride + j]);
    end.radius = real_set(pass->radius[j]);
    end.mass = needs_mass(shape) ? real_set(pass->mass[j]) : real_zero();
    end.charge = needs_charge(shape) ? real_set(pass->charge[j]) : real_zero();
    return end;
}

// For contact forces: excludes pairs that are certainly not in contact, before their square roots are computed. The
// limit is slightly too large, so that rounding cannot exclude a pair with l < r₁+r₂, however small the numbers are.
KERNEL Mask pair_near(Mask live, Real square, Real reach) {
    Real wide = reach * reach * real_set(1 + 0x1p-48);
    return real_less_where(live, square, wide + real_set(DBL_MIN));
}

// Sets the differences of position in pair->unit, and pair->reach. Returns the squares of the distances.
KERNEL Real pair_square(PairShape shape, const PairEnd *target, const PairEnd *partner, PairGeometry *pair) {
    Real square = real_zero();
    for (size_t k = 0; k < shape.dimensions; k++) {
        pair->unit[k] = partner->position[k] - target->position[k];
        Real part = pair->unit[k] * pair->unit[k];
        square = k ? square + part : part; // 0 + part equals part, because a square is never -0
    }
    pair->reach = target->radius + partner->radius;
    return square;
}

// Divides the differences in pair->unit by the distances.
KERNEL void pair_direct(PairShape shape, Real inverse, PairGeometry *pair) {
    for (size_t k = 0; k < shape.dimensions; k++)
        pair->unit[k] *= inverse;
}

// Computes the geometry of the pairs in `live`. Returns false if no force can act on any of them.
KERNEL bool pair_geometry(PairShape shape, const PairEnd *target, const PairEnd *partner, Mask live,
                          PairGeometry *pair) {
    Real square = pair_square(shape, target, partner, pair);
    bool contact_only = shape.lead == LEAD_NONE && rest_needs_contact(shape);
    if (contact_only) {
        live = pair_near(live, square, pair->reach);
        if (!mask_any(live))
            return false;
    }
    pair->length = real_sqrt(square);
    pair->valid = real_less_where(live, real_zero(), square);
    if (!contact_only) // pairs that passed pair_near are finite
        pair->valid = real_at_most_where(pair->valid, square, real_set(DBL_MAX));
    pair_direct(shape, real_set(1) / pair->length, pair);
    return true;
}

// Returns the lanes whose pairs are in contact. Pairs with a radius of 0 are not excluded here but later, by
// both_nonzero, when few pairs are left.
KERNEL Mask pair_in_contact(const PairGeometry *pair) {
    return real_less_where(pair->valid, pair->length, pair->reach);
}

// The terms that a tile (pair_tiles.h) subtracts from the sums of its columns, by component and column. Each lane is a
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

KERNEL void clear_terms(size_t dimensions, Real (*column)[LANES]) {
    for (size_t m = 0; m < dimensions; m++)
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
            clear_terms(shape.dimensions, tile->rest[t]);
            tile->hits |= 1u << t;
        }
        add_term(shape, pair, applies, coefficient, sum, tile ? tile->rest[t] : NULL, k);
    }
}
