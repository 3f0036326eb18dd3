// pair_formulas.h: formulas of the forces between two particles (spec physics.md 4.1), for LANES pairs at once.
//
//   d_k = to_k − from_k;  l = sqrt(d_0² + d_1² + …);  inv = 1 / l;  u_k = d_k · inv;  f_k = u_k · K
//
// K is the signed size of the force: a positive K attracts. Each kind of force has two formulas below: for K, and for
// the potential U with dU/dl = K, which is 0 where the force ends. S is the strength times the sign in the force's row
// (force_list.h). Instead of a potential there may be NO_POTENTIAL(Pair, name).
//
// The target (`from`) receives + f and the partner − f, whichever of the two comes first in the pass. Every K is
// symmetric: if the two are exchanged, d, u and f change only their signs, and K stays the same.
#pragma once

#include "physics/forces.h"
#include "physics/kernels.h"
#include "physics/lanes.h"

// One particle of each of LANES pairs.
typedef struct PairEnd {
    Real position[PHYS_VECTOR_DIMENSIONS];
    Real radius;
    Real mass;
    Real charge;
} PairEnd;

// Geometry of LANES pairs.
typedef struct PairGeometry {
    Real unit[PHYS_VECTOR_DIMENSIONS];
    Real length;
    Real reach; // sum of the radii
    Mask valid; // lanes in which l is positive and finite
} PairGeometry;

// Inputs of a formula.
typedef struct Pairs {
    const PairTerm *term;
    const PairGeometry *geometry;
    const PairEnd *target;
    const PairEnd *partner;
    Mask contact; // lanes with l < r₁+r₂ where neither radius is 0
    bool plain;   // no exponent in the pass needs a function call (pow_is_plain)
    bool linear;  // all exponents are 1
} Pairs;

// Potentials of pair forces and links. energy.c chooses them by the force's row.
typedef Real PairPotential(const Pairs *pairs);
typedef Real LinkPotential(const PhysForce *link, double strength, Real length);

// S · (a · b) / (D · D),  D = max(r₁+r₂, l)
KERNEL Real inverse_square(const Pairs *pairs, Real a, Real b) {
    Real distance = real_max(pairs->geometry->reach, pairs->geometry->length);
    return real_set(pairs->term->strength) * (a * b) / (distance * distance);
}

// U = − S · (a · b) / l;  if l < r₁+r₂ = R, where K is constant:  U = − S · (a · b) · (1/R + (R − l)/R²)
KERNEL Real inverse_square_potential(const Pairs *pairs, Real a, Real b) {
    Real reach = pairs->geometry->reach, length = pairs->geometry->length;
    Real k = real_set(pairs->term->strength) * (a * b);
    Real touching = -k / reach - k / (reach * reach) * (reach - length);
    return real_select(real_less(length, reach), touching, -k / length);
}

// K = S · (m₁ · m₂) / (D · D)
KERNEL Real pair_gravity(const Pairs *pairs) {
    return inverse_square(pairs, pairs->target->mass, pairs->partner->mass);
}

KERNEL Real potential_gravity(const Pairs *pairs) {
    return inverse_square_potential(pairs, pairs->target->mass, pairs->partner->mass);
}

// K = S · (q₁ · q₂) / (D · D)
KERNEL Real pair_electrostatic(const Pairs *pairs) {
    return inverse_square(pairs, pairs->target->charge, pairs->partner->charge);
}

KERNEL Real potential_electrostatic(const Pairs *pairs) {
    return inverse_square_potential(pairs, pairs->target->charge, pairs->partner->charge);
}

// K = (r₁+r₂ − l)^power · S
KERNEL Real pair_collision(const Pairs *pairs) {
    Real depth = pairs->geometry->reach - pairs->geometry->length;
    Real power = pairs->linear ? depth : real_pow(pairs->plain, pairs->contact, depth, pairs->term->power);
    return power * real_set(pairs->term->strength);
}

KERNEL Real potential_collision(const Pairs *pairs) {
    Real depth = pairs->geometry->reach - pairs->geometry->length;
    return -real_pow_integral(pairs->term->strength, pairs->contact, depth, pairs->term->power);
}

// a = |r₁−r₂| · overlap + (r₁+r₂) · (1 − overlap)
KERNEL Real adhesion_rest(const Pairs *pairs) {
    double overlap = pairs->term->overlap;
    Real difference = real_absolute(pairs->target->radius - pairs->partner->radius);
    return difference * real_set(overlap) + pairs->geometry->reach * real_set(1 - overlap);
}

// K = S · o · (l − a),  o = r₁+r₂ − l
KERNEL Real pair_adhesion(const Pairs *pairs) {
    Real depth = pairs->geometry->reach - pairs->geometry->length;
    return real_set(pairs->term->strength) * depth * (pairs->geometry->length - adhesion_rest(pairs));
}

// U = − S · o² · ((r₁+r₂ − a)/2 − o/3)
KERNEL Real potential_adhesion(const Pairs *pairs) {
    Real reach = pairs->geometry->reach, depth = reach - pairs->geometry->length;
    Real factor = (reach - adhesion_rest(pairs)) / real_set(2) - depth / real_set(3);
    return -real_set(pairs->term->strength) * depth * depth * factor;
}

// Sets *k to K of a link with this length. Returns false if there is no force.
//   l < min:       K = − ((min − l)^power · S)
//   else l > max:  K = (l − max)^power · S
KERNEL bool link_distance(const PhysForce *link, double strength, Real length, Real *k) {
    bool near = link->has_minimum && mask_any(real_less(length, real_set(link->minimum)));
    if (!near && !(link->has_maximum && mask_any(real_less(real_set(link->maximum), length))))
        return false;
    Real beyond = near ? real_set(link->minimum) - length : length - real_set(link->maximum);
    *k = real_pow(false, mask_first(LANES), beyond, link->power) * real_set(near ? -strength : strength);
    return true;
}

KERNEL Real potential_distance(const PhysForce *link, double strength, Real length) {
    if (link->has_minimum && mask_any(real_less(length, real_set(link->minimum))))
        return real_pow_integral(strength, mask_first(LANES), real_set(link->minimum) - length, link->power);
    if (link->has_maximum && mask_any(real_less(real_set(link->maximum), length)))
        return real_pow_integral(strength, mask_first(LANES), length - real_set(link->maximum), link->power);
    return real_zero();
}

// Returns the quantity of one particle that `need` names, or 1 if the force needs nothing.
KERNEL Real pair_source(ForceNeed need, const PairEnd *end) {
    if (need == NEED_MASS)
        return end->mass;
    return need == NEED_CHARGE ? end->charge : need == NEED_RADIUS ? end->radius : real_set(1);
}

// Returns the lanes of `mask` in which neither of two quantities is 0.
KERNEL Mask both_nonzero(Mask mask, Real a, Real b) {
    return real_differs_where(real_differs_where(mask, a, real_zero()), b, real_zero());
}

// Returns the lanes in which a force applies if its `bound` is ignored.
KERNEL Mask pair_where(PairReach reach, ForceNeed need, const Pairs *pairs) {
    if (reach == REACH_CONTACT)
        return pairs->contact;
    return both_nonzero(pairs->geometry->valid, pair_source(need, pairs->target), pair_source(need, pairs->partner));
}

#if LANES == 1
// Returns the geometry of one pair, without a direction.
KERNEL PairGeometry lone_geometry(double length, const PairEnd *target, const PairEnd *partner) {
    return (PairGeometry){
        .length = length, .reach = target->radius + partner->radius, .valid = length > 0 && length <= DBL_MAX};
}

// Returns the inputs of the formulas for one pair. The caller sets the term.
KERNEL Pairs lone_pair(const PairGeometry *geometry, const PairEnd *target, const PairEnd *partner) {
    bool contact = both_nonzero(geometry->length < geometry->reach, target->radius, partner->radius);
    return (Pairs){.geometry = geometry, .target = target, .partner = partner, .contact = contact};
}
#endif

// Sets *k to K of one force and returns the lanes in which the force applies. `contact_only`: all forces of the pass
// need contact.
KERNEL Mask pair_apply(const Pairs *pairs, bool contact_only, Real *k) {
    Mask applies = mask_first(0);
    *k = real_zero();
    switch (pairs->term->kind) {
#define PAIR(KIND, name, SIGN, SOURCE, REACH)                                                                          \
    case PHYS_##KIND:                                                                                                  \
        if (contact_only && REACH_##REACH != REACH_CONTACT)                                                            \
            __builtin_unreachable();                                                                                   \
        *k = pair_##name(pairs);                                                                                       \
        applies = pair_where(REACH_##REACH, NEED_##SOURCE, pairs);                                                     \
        break;
#define OTHER(KIND, ...) case PHYS_##KIND:
        PHYS_FORCES(PAIR, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)
        PHYS_FORCES(PHYS_NO_ROW, OTHER, OTHER, OTHER)
#undef PAIR
#undef OTHER
    case PHYS_FORCE_KINDS:
        __builtin_unreachable(); // a pass contains only pair forces
    }
    double bound = pairs->term->bound;
    return bound < INFINITY ? real_less_where(applies, pairs->geometry->length, real_set(bound)) : applies;
}
