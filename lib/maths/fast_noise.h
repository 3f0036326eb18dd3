// fast_noise.h: vectorised two-dimensional noise (arrays.h). The operations and their order are those of
// lib/builtin/noise_point.c, but values are selected by masks instead of branches.
#pragma once

#include "maths/arrays.h"
#include "maths/lanes.h"

// Converts the result of a comparison to a mask: all bits of a lane are 1 where it is true, else 0.
#if LANES == 1
#define LANES_MASK(claim) (-(Bits)(claim))
#else
#define LANES_MASK(claim) ((Bits)(claim))
#endif

KERNEL Bits bits_choose(Bits mask, Bits yes, Bits no) {
    return (yes & mask) | (no & ~mask);
}

KERNEL Real real_choose(Bits mask, double yes, double no) {
    return real_of(bits_choose(mask, bits_of(real_set(yes)), bits_of(real_set(no))));
}

// Returns floor(x) for |x| < 2^50, and sets *whole to the same number as an integer.
KERNEL Real real_floor(Real x, Bits *whole) {
    Real near = real_steps(x, 1, whole);
    Bits above = LANES_MASK(near > x);
    *whole += above;
    return near - real_of(above & bits_of(real_set(1)));
}

typedef struct NoiseLanes {
    const PlaneNoise *noise;
    const double *permutation; // integers, stored in the bits of doubles
    Real x, y;                 // position relative to the base vertex
    Bits base_x, base_y;
} NoiseLanes;

// Adds the contribution of the vertex (a, b), relative to the base vertex, to `value`. whole_a and whole_b are a and b
// as integers.
KERNEL Real noise_vertex(const NoiseLanes *p, Real value, Real a, Real b, Bits whole_a, Bits whole_b, Real squish) {
    const Bits byte = bits_set(255);
    Real dx = (p->x - a) - squish, dy = (p->y - b) - squish, reach = (real_set(2) - dx * dx) - dy * dy;
    Bits at = bits_of(real_gather_table(p->permutation, (p->base_x + whole_a) & byte));
    at = bits_of(real_gather_table(p->permutation, (at + p->base_y + whole_b) & byte)) & bits_set(7);
    Real slope = real_gather_table(p->noise->gradient_x, at) * dx + real_gather_table(p->noise->gradient_y, at) * dy;
    Real squared = reach * reach, sum = value + (squared * squared) * slope;
    return real_of(bits_choose(LANES_MASK(reach > real_set(0)), bits_of(sum), bits_of(value)));
}

KERNEL Real noise_lanes(const PlaneNoise *noise, const double *permutation, Real x, Real y) {
    const Bits zero = bits_set(0), one = bits_set(1);
    const double squish = noise->squish;
    NoiseLanes p = {.noise = noise, .permutation = permutation};
    Real skew = (x + y) * real_set(noise->skew), skewed_x = x + skew, skewed_y = y + skew;
    Real whole_x = real_floor(skewed_x, &p.base_x), whole_y = real_floor(skewed_y, &p.base_y);
    Real fx = skewed_x - whole_x, fy = skewed_y - whole_y, sum = fx + fy, q = (whole_x + whole_y) * real_set(squish);
    p.x = x - (whole_x + q);
    p.y = y - (whole_y + q);
    Real value = noise_vertex(&p, real_set(0), real_set(1), real_set(0), one, zero, real_set(squish));
    value = noise_vertex(&p, value, real_set(0), real_set(1), zero, one, real_set(squish));
    // the nearer of the vertices (0, 0) and (1, 1)
    Bits far = LANES_MASK(sum > real_set(1)), right = LANES_MASK(fx > fy);
    Real corner = real_choose(far, 1, 0), u = real_choose(far, 2, 1) - sum, side = real_choose(right, 1, -1);
    value = noise_vertex(&p, value, corner, corner, far & one, far & one, real_choose(far, 2 * squish, 0));
    // the last vertex: either a neighbour of that vertex outside the cell, or the farther of (0, 0) and (1, 1)
    Bits beyond = bits_choose(far, LANES_MASK(u < fx) | LANES_MASK(u < fy), LANES_MASK(u > fx) | LANES_MASK(u > fy));
    Bits other = ~far & one, step = (right & bits_set(2)) - one;
    Real rest = real_set(1) - corner;
    Real a = real_of(bits_choose(beyond, bits_of(corner + side), bits_of(rest)));
    Real b = real_of(bits_choose(beyond, bits_of(corner - side), bits_of(rest)));
    value = noise_vertex(&p, value, a, b, bits_choose(beyond, (far & one) + step, other),
                         bits_choose(beyond, (far & one) - step, other), real_choose(~(beyond ^ far), 2 * squish, 0));
    return value / real_set(noise->scale);
}
