// power.h: displacement^power as section 4.1 defines it, for LANES at once.
#ifndef PETRI_PHYSICS_POWER_H
#define PETRI_PHYSICS_POWER_H

#include "maths/many.h"
#include "physics/lanes.h"

// Other lanes than those of the mask might hold what takes long, such as numbers below 0.
static __attribute__((noinline, unused)) Real power_by_lane(Mask mask, Real base, double power) {
    double lanes[LANES];
    real_store(lanes, real_select(mask, base, real_set(1)));
    maths_power_many(LANES_LEVEL, lanes, power, LANES, lanes);
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
