// pow_lanes.h: displacement^power as spec physics.md 4.1 defines it, for LANES numbers at once.
#pragma once

#include "maths/arrays.h"
#include "physics/lanes.h"

// Computes base^power with a function call. In lanes outside the mask, uses 1 instead of the base, because pow is slow
// for some numbers, such as negative ones.
static __attribute__((noinline, unused)) Real pow_by_lane(Mask mask, Real base, double power) {
    double lanes[LANES];
    real_store(lanes, real_select(mask, base, real_set(1)));
    maths_arrays(LANES_LEVEL)->pow(lanes, &power, 0, LANES, lanes);
    return real_load(lanes);
}

// Returns true if the exponent needs no function call.
static inline bool pow_is_plain(double power) {
    return power == 1 || power == 2 || power <= 0;
}

// Returns base^power in the lanes of the mask; other lanes are undefined. A negative exponent counts as 0. `plain` may
// be true only if pow_is_plain(power). In loops `plain` should be a compile-time constant: even a call that never
// happens makes the compiler spill registers.
KERNEL Real real_pow(bool plain, Mask mask, Real base, double power) {
    if (power == 1)
        return base;
    if (power == 2)
        return base * base;
    return plain || power <= 0 ? real_set(1) : pow_by_lane(mask, base, power);
}
