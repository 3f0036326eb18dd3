// random.c: see random.h.
#include "base/random.h"

#include "base/number.h"

#include <math.h>
#include <string.h>

// remquo(x, 1.0) for an x that is not below 0: the rest after the nearest whole number (the even one of two), and that
// number's low bits. Adding and taking away 2^52 rounds in just that way; larger numbers are rare and left to remquo.
static double quarter_rest(double x, int *quadrant) {
    if (!(x > 0 && x < 1073741824.0)) {
        *quadrant = 0; // remquo leaves it alone for nan and infinities
        return remquo(x, 1.0, quadrant);
    }
    double whole = x + 4503599627370496.0 - 4503599627370496.0;
    *quadrant = (int)whole;
    return x - whole;
}

double turns_sin(double t) {
    if (t < 0)
        return -turns_sin(-t);
    int quadrant;
    double rest = quarter_rest(t * 4, &quadrant);
    double angle = rest * 1.5707963267948966;
    switch (quadrant & 3) {
    case 0:
        return sin(angle);
    case 1:
        return cos(angle);
    case 2:
        return -sin(angle);
    default:
        return -cos(angle);
    }
}

double turns_cos(double t) {
    return turns_sin(t + 0.25);
}

uint64_t random_hash_number(double x) {
    double whole = isfinite(x) ? number_floor(x) : x;
    uint64_t bits;
    memcpy(&bits, &whole, sizeof bits);
    return bits;
}

static uint64_t swap_halves(uint64_t x) {
    return x << 32 | x >> 32;
}

uint64_t random_raw(uint64_t key, uint64_t i) {
    uint64_t y = i * key, z = y + key, x = y;
    x = swap_halves(x * x + y);
    x = swap_halves(x * x + z);
    x = swap_halves(x * x + y);
    uint64_t t = x * x + z;
    x = swap_halves(t);
    return t ^ ((x * x + y) >> 32);
}

double random_uniform(uint64_t key, uint64_t i) {
    return (double)random_raw(key, i) / 18446744073709551616.0;
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
    double radius = sqrt(-2 * log(u1));
    return i & 1 ? radius * turns_sin(u2) : radius * turns_cos(u2);
}
