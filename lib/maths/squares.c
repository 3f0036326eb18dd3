// squares.c: the generator of random.h, which libraries other than libpetri also use.
#include "base/number.h"
#include "maths/fast_random.h"
#include "maths/random.h"

#include <math.h>
#include <string.h>

uint64_t random_hash_number(double x) {
    double whole = isfinite(x) ? number_floor(x) : isnan(x) ? (double)NAN : x; // processors differ in the bits of NaN
    uint64_t bits;
    memcpy(&bits, &whole, sizeof bits);
    return bits;
}

uint64_t random_raw(uint64_t key, uint64_t i) {
    return raw_lanes(key, i);
}

double random_uniform(uint64_t key, uint64_t i) {
    return (double)random_raw(key, i) / 18446744073709551616.0;
}
