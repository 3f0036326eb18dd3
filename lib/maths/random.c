// random.c: see random.h.
//
// random_normals has the same bits as random_normal. Items 2k and 2k + 1 are made from the same two uniform numbers, so
// it computes whole pairs and drops those that were not requested.
#include "maths/random.h"

#include "maths/arrays.h"
#include "maths/maths.h"

#include <math.h>
#include <string.h>

// Returns x minus the nearest integer (ties to even), exactly, for x ≥ 0. Sets *quadrant to that integer modulo 4.
static double quarter_rest(double x, unsigned *quadrant) {
    *quadrant = 0;
    if (!(x < 9007199254740992.0)) {
        // x is an integer, infinite or NaN. Doubles of at least 2^63 are multiples of 4.
        if (x < 9223372036854775808.0)
            *quadrant = (uint64_t)x & 3;
        return x - x;
    }
    // Subtract a multiple of 4, so that the remainder can be rounded by adding and subtracting 2^52.
    if (x >= 2251799813685248.0)
        x -= 2251799813685248.0 * (double)((uint64_t)x >> 51);
    double whole = x + 4503599627370496.0 - 4503599627370496.0;
    *quadrant = (uint64_t)whole & 3;
    return x - whole;
}

double turns_sin(double t) {
    if (t < 0)
        return -turns_sin(-t);
    unsigned quadrant;
    double rest = quarter_rest(t * 4, &quadrant);
    double angle = rest * 1.5707963267948966;
    switch (quadrant) {
    case 0:
        return maths_sin(angle);
    case 1:
        return maths_cos(angle);
    case 2:
        return -maths_sin(angle);
    default:
        return -maths_cos(angle);
    }
}

double turns_cos(double t) {
    return turns_sin(t + 0.25);
}

double random_beta(uint64_t key, uint64_t i) {
    double a = random_uniform(key, 4 * i), b = random_uniform(key, 4 * i + 1), c = random_uniform(key, 4 * i + 2);
    double low = a < b ? a : b, high = a < b ? b : a;
    return c < low ? low : c > high ? high : c;
}

double random_normal(uint64_t key, uint64_t i) {
    uint64_t even = i & ~UINT64_C(1);
    double u1 = random_uniform(key, even), u2 = random_uniform(key, even + 1);
    if (u1 == 0) {
        u1 = u2;
        u2 = 0;
    }
    double radius = sqrt(-2 * maths_log(u1));
    return i & 1 ? radius * turns_sin(u2) : radius * turns_cos(u2);
}

enum { PAIRS_AT_ONCE = 64 };

// Computes random_normal for `count` pairs of items, starting with items 2 * pair and 2 * pair + 1.
static void normal_pairs(CpuLevel level, uint64_t key, uint64_t pair, size_t count, double *to) {
    double radius[PAIRS_AT_ONCE], turns[2 * PAIRS_AT_ONCE];
    maths_arrays(level)->uniform(key, 2 * pair, 2 * count, turns);
    for (size_t i = 0; i < count; i++) {
        double u1 = turns[2 * i], u2 = turns[2 * i + 1];
        radius[i] = u1 == 0 ? u2 : u1;
        u2 = u1 == 0 ? 0 : u2;
        turns[2 * i] = u2 + 0.25;
        turns[2 * i + 1] = u2;
    }
    maths_arrays(level)->log(radius, count, radius);
    maths_arrays(level)->turns_sin(turns, 2 * count, turns);
    for (size_t i = 0; i < count; i++) {
        double r = sqrt(-2 * radius[i]);
        to[2 * i] = r * turns[2 * i];
        to[2 * i + 1] = r * turns[2 * i + 1];
    }
}

void random_normals(CpuLevel level, uint64_t key, uint64_t first, size_t count, double *to) {
    double pairs[2 * PAIRS_AT_ONCE];
    for (size_t done = 0; done < count;) {
        uint64_t item = first + done;
        size_t odd = item & 1, wanted = count - done, fits = 2 * PAIRS_AT_ONCE - odd;
        if (wanted > fits)
            wanted = fits;
        normal_pairs(level, key, item / 2, (wanted + odd + 1) / 2, pairs);
        memcpy(to + done, pairs + odd, wanted * sizeof *to);
        done += wanted;
    }
}
