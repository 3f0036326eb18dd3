// fast_random.h: the generator of raw random numbers (random.h), vectorised.
#pragma once

#include "maths/lanes.h"

KERNEL Bits bits_swap_halves(Bits x) {
    return x << 32 | x >> 32;
}

// Computes random_raw (random.h) in each lane.
KERNEL Bits raw_lanes(Bits key, Bits item) {
    Bits y = item * key, z = y + key, x = y;
    x = bits_swap_halves(x * x + y);
    x = bits_swap_halves(x * x + z);
    x = bits_swap_halves(x * x + y);
    Bits t = x * x + z;
    x = bits_swap_halves(t);
    return t ^ ((x * x + y) >> 32);
}
