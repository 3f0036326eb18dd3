// power.h: displacement^power as section 4.1 defines it, for LANES at once.
#ifndef PETRI_PHYSICS_POWER_H
#define PETRI_PHYSICS_POWER_H

#include "physics/lanes.h"

// Lane by lane, where the mask says so. Not inlined: with a constant exponent compilers replace pow by other
// operations.
static __attribute__((noinline, unused)) Real power_by_lane(Mask mask, Real base, double power) {
    double lanes[LANES];
    real_store(lanes, base);
    unsigned bits = mask_bits(mask);
    for (unsigned lane = 0; lane < LANES; lane++)
        if (bits >> lane & 1)
            lanes[lane] = pow(lanes[lane], power);
    return real_load(lanes);
}

// An exponent below 0 counts as 0. What the other lanes hold is of no use.
KERNEL Real real_power(Mask mask, Real base, double power) {
    if (power == 1)
        return base;
    if (power == 2)
        return real_mul(base, base);
    return power_by_lane(mask, base, power < 0 ? 0.0 : power);
}

#endif
