// pair_terms.h: the formulas of force_pair.c for LANES pairs at once: a vector of targets and one partner, or a vector
// of partners.
//
//   d_k = to_k − from_k;  l = sqrt(d_0² + d_1² + …);  inv = 1 / l;  u_k = d_k · inv;  f_k = u_k · K
//   gravity        K =   (strength · (m₁ · m₂)) / (D · D),  D = max(r₁+r₂, l)
//   electrostatic  K = −((strength · (q₁ · q₂)) / (D · D))
//   collision      l < r₁+r₂: K = −((r₁+r₂ − l)^power · strength)
//   adhesion       l < r₁+r₂: K = strength · o · (l − a),  o = r₁+r₂ − l,
//                  a = |r₁−r₂| · overlap + (r₁+r₂) · (1 − overlap)
//
// The target gets + f, the partner − f, whichever of the two comes first in the pass: with the ends exchanged d, u and
// f change their signs exactly and K stays the same.
#ifndef PETRI_PHYSICS_PAIR_TERMS_H
#define PETRI_PHYSICS_PAIR_TERMS_H

#include "maths/many.h"
#include "physics/kernels.h"
#include "physics/simd.h"

// What kernels are specialised on: a force without bound that comes first, and what follows it.
typedef enum PairLead { LEAD_NONE, LEAD_GRAVITY, LEAD_ELECTROSTATIC } PairLead;
typedef enum PairRest {
    REST_NONE,
    REST_TOUCH, // collision and adhesion only
    REST_ANY,
} PairRest;

typedef struct PairShape {
    size_t dimensions;
    PairLead lead;
    PairRest rest;
} PairShape;

// One end of LANES pairs.
typedef struct PairEnd {
    Real place[PHYS_VECTOR_DIMENSIONS];
    Real radius;
    Real mass;
    Real charge;
} PairEnd;

// What is known of LANES pairs.
typedef struct PairGeometry {
    Real unit[PHYS_VECTOR_DIMENSIONS];
    Real length;
    Real reach; // sum of the radii
    Mask valid; // l is neither 0 nor not finite
} PairGeometry;

KERNEL bool needs_mass(PairShape shape) {
    return shape.lead == LEAD_GRAVITY || shape.rest == REST_ANY;
}

KERNEL bool needs_charge(PairShape shape) {
    return shape.lead == LEAD_ELECTROSTATIC || shape.rest == REST_ANY;
}

// LANES targets from column i on.
KERNEL PairEnd pair_targets(const PairPass *pass, PairShape shape, size_t i) {
    PairEnd end;
    for (size_t k = 0; k < shape.dimensions; k++)
        end.place[k] = real_load(pass->position + k * pass->stride + i);
    end.radius = real_load(pass->radius + i);
    end.mass = needs_mass(shape) ? real_load(pass->mass + i) : real_zero();
    end.charge = needs_charge(shape) ? real_load(pass->charge + i) : real_zero();
    return end;
}

// The partner j in every lane.
KERNEL PairEnd pair_partner(const PairPass *pass, PairShape shape, size_t j) {
    PairEnd end;
    for (size_t k = 0; k < shape.dimensions; k++)
        end.place[k] = real_set(pass->position[k * pass->stride + j]);
    end.radius = real_set(pass->radius[j]);
    end.mass = needs_mass(shape) ? real_set(pass->mass[j]) : real_zero();
    end.charge = needs_charge(shape) ? real_set(pass->charge[j]) : real_zero();
    return end;
}

// Forces that need contact: pairs that surely have none are dropped before the square root. The filter is a hair too
// wide, so that rounding cannot drop a pair with l < r₁+r₂, however small the numbers are.
KERNEL Mask pair_near(Mask live, Real square, Real reach) {
    Real wide = real_mul(real_mul(reach, reach), real_set(1 + 0x1p-48));
    return real_less_where(live, square, real_add(wide, real_set(DBL_MIN)));
}

// False if none of the pairs `live` can have a force.
KERNEL bool pair_geometry(PairShape shape, const PairEnd *target, const PairEnd *partner, Mask live,
                          PairGeometry *pair) {
    Real square = real_zero();
    for (size_t k = 0; k < shape.dimensions; k++) {
        pair->unit[k] = real_sub(partner->place[k], target->place[k]);
        Real part = real_mul(pair->unit[k], pair->unit[k]);
        square = k ? real_add(square, part) : part; // 0 + part is part: a square is never -0
    }
    pair->reach = real_add(target->radius, partner->radius);
    if (shape.lead == LEAD_NONE && shape.rest == REST_TOUCH) {
        live = pair_near(live, square, pair->reach);
        if (!mask_any(live))
            return false;
    }
    pair->length = real_sqrt(square);
    pair->valid = real_at_most_where(real_less_where(live, real_zero(), square), square, real_set(DBL_MAX));
    Real inverse = real_div(real_set(1), pair->length);
    for (size_t k = 0; k < shape.dimensions; k++)
        pair->unit[k] = real_mul(pair->unit[k], inverse);
    return true;
}

// Lanes in which neither of two quantities is 0.
KERNEL Mask both_there(Mask mask, Real a, Real b) {
    return real_differs_where(real_differs_where(mask, a, real_zero()), b, real_zero());
}

// gravity, electrostatic
KERNEL Real inverse_square(const PairTerm *term, const PairGeometry *pair, Real a, Real b) {
    Real distance = real_larger(pair->reach, pair->length);
    return real_div(real_mul(real_set(term->strength), real_mul(a, b)), real_mul(distance, distance));
}

// Lanes with contact. Radii of 0 are left to both_there: few pairs get so far.
KERNEL Mask pair_touch(const PairGeometry *pair) {
    return real_less_where(pair->valid, pair->length, pair->reach);
}

// base^power in the lanes of the mask; 1 elsewhere.
static __attribute__((noinline)) Real real_power(Mask mask, Real base, double power) {
    double lanes[LANES];
    real_store(lanes, real_select(mask, base, real_set(1)));
    maths_power_many(LANES_LEVEL, lanes, power, LANES, lanes);
    return real_load(lanes);
}

KERNEL Real collision(const PairTerm *term, const PairGeometry *pair, Mask touch) {
    Real depth = real_sub(pair->reach, pair->length);
    if (term->power == 2)
        depth = real_mul(depth, depth);
    else if (term->power != 1)
        depth = real_power(touch, depth, term->power < 0 ? 0.0 : term->power);
    return real_mul(depth, real_set(term->strength));
}

KERNEL Real adhesion(const PairTerm *term, const PairGeometry *pair, const PairEnd *target, const PairEnd *partner) {
    Real depth = real_sub(pair->reach, pair->length);
    Real difference = real_absolute(real_sub(target->radius, partner->radius));
    Real rest =
        real_add(real_mul(difference, real_set(term->overlap)), real_mul(pair->reach, real_set(1 - term->overlap)));
    return real_mul(real_mul(real_set(term->strength), depth), real_sub(pair->length, rest));
}

// What the force that leads works on.
KERNEL Real lead_source(PairShape shape, const PairEnd *end) {
    return shape.lead == LEAD_GRAVITY ? end->mass : end->charge;
}

// Coefficient of one of the other forces, and where it applies. `touch` has the lanes with contact.
KERNEL Mask pair_term(const PairTerm *term, const PairGeometry *pair, const PairEnd *target, const PairEnd *partner,
                      PairShape shape, Mask touch, Real *coefficient) {
    Mask applies = touch;
    if (term->kind == TERM_COLLISION) {
        *coefficient = collision(term, pair, touch);
    } else if (term->kind == TERM_ADHESION || shape.rest == REST_TOUCH) {
        *coefficient = adhesion(term, pair, target, partner);
    } else {
        bool gravity = term->kind == TERM_GRAVITY;
        Real a = gravity ? target->mass : target->charge, b = gravity ? partner->mass : partner->charge;
        *coefficient = inverse_square(term, pair, a, b);
        applies = both_there(pair->valid, a, b);
    }
    return term->bound < INFINITY ? real_less_where(applies, pair->length, real_set(term->bound)) : applies;
}

#endif
