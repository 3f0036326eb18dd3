// pow_lanes.h: displacement^power as section 4.1 defines it, for LANES at once.
#ifndef PETRI_PHYSICS_POW_LANES_H
#define PETRI_PHYSICS_POW_LANES_H

#include "maths/arrays.h"
#include "physics/lanes.h"

// Other lanes than those of the mask might hold what takes long, such as numbers below 0.
static __attribute__((noinline, unused)) Real pow_by_lane(Mask mask, Real base, double power) {
    double lanes[LANES];
    real_store(lanes, real_select(mask, base, real_set(1)));
    maths_power_array(LANES_LEVEL, lanes, power, LANES, lanes);
    return real_load(lanes);
}

// Exponents that need no function.
static inline bool pow_is_plain(double power) {
    return power == 1 || power == 2 || power <= 0;
}

// An exponent below 0 counts as 0. What the other lanes hold is of no use. `plain`: it is known that the exponent is.
// A loop should know, as a call in it, even one that is never made, takes the registers away from the rest.
KERNEL Real real_pow(bool plain, Mask mask, Real base, double power) {
    if (power == 1)
        return base;
    if (power == 2)
        return base * base;
    return plain || power <= 0 ? real_set(1) : pow_by_lane(mask, base, power);
}

#endif
