// arrays_isa.c: the functions of arrays.h for one instruction set, LANES numbers at a time. MATHS_ISA is the name of
// the instruction set.
//
// If the fast path cannot round a lane with certainty, the scalar function recomputes that lane.
#include "maths/arrays.h"
#include "maths/fast_exp.h"
#include "maths/fast_log.h"
#include "maths/fast_noise.h"
#include "maths/fast_random.h"
#include "maths/fast_sincos.h"
#include "maths/maths.h"
#include "maths/random.h"

#define JOIN(name, instance) name##instance
#define NAMED(name, instance) JOIN(name, instance)

// Loads up to LANES numbers. The remaining lanes become 1, a valid argument of every function.
KERNEL Real load(const double *from, size_t count) {
    if (count >= LANES)
        return real_load(from);
    Real r = real_set(1);
    memcpy(&r, from, count * sizeof *from);
    return r;
}

KERNEL void store(double *to, size_t count, Real r) {
    memcpy(to, &r, count >= LANES ? sizeof r : count * sizeof *to);
}

// Returns the lanes below `count` that must still be computed. `good` is the set of lanes with a final result.
KERNEL Lanes lanes_left(Lanes good, size_t count) {
    return ~good & (count >= LANES ? ALL_LANES : (1u << count) - 1);
}

// Recomputes the lanes in `left` with the scalar function.
static __attribute__((noinline)) void recompute_lanes(double (*function)(double x), Lanes left, Real in, double *to) {
    double x[LANES];
    real_store(x, in);
    for (unsigned lane = 0; left >> lane; lane++)
        if (left >> lane & 1)
            to[lane] = function(x[lane]);
}

// Computes the sine of t turns. The quadrant only changes the table row, so all lanes evaluate the same polynomials.
KERNEL Lanes turns_sin_lanes(Real t, Real *result) {
    Real quarters = t * real_set(4);
    Bits quadrant;
    Real angle = (quarters - real_steps(quarters, 1, &quadrant)) * real_set(1.5707963267948966);
    return sin_lanes(angle, quadrant, result) & lanes_less(real_absolute(quarters), real_set(0x1p50));
}

#define ARRAY_FUNCTION(name, fast, function)                                                                           \
    static void name##_array(const double *x, size_t count, double *to) {                                              \
        for (size_t i = 0; i < count; i += LANES) {                                                                    \
            Real in = load(x + i, count - i), out;                                                                     \
            Lanes left = lanes_left(fast(in, &out), count - i);                                                        \
            store(to + i, count - i, out);                                                                             \
            if (left)                                                                                                  \
                recompute_lanes(function, left, in, to + i);                                                           \
        }                                                                                                              \
    }
ARRAY_FUNCTION(exp, exp_lanes, maths_exp)
ARRAY_FUNCTION(log, log_lanes, maths_log)
ARRAY_FUNCTION(turns_sin, turns_sin_lanes, turns_sin)

static void pow_array(const double *x, const double *y, size_t step, size_t count, double *to) {
    for (size_t i = 0; i < count; i += LANES) {
        Real base = load(x + i, count - i), power = step ? load(y + i, count - i) : real_set(*y), out;
        Lanes left = lanes_left(pow_lanes(base, power, &out), count - i);
        store(to + i, count - i, out);
        if (left) {
            double bases[LANES], powers[LANES];
            real_store(bases, base);
            real_store(powers, power);
            for (unsigned lane = 0; left >> lane; lane++)
                if (left >> lane & 1)
                    to[i + lane] = maths_pow(bases[lane], powers[lane]);
        }
    }
}

// Converts integers to the nearest doubles. The upper half of the bits is combined with the exponent of 2^84 and the
// lower half with that of 2^52, both exactly. Only their sum is rounded.
KERNEL Real lanes_to_real(Bits x) {
    Real upper = real_of(x >> 32 | bits_of(real_set(0x1p84))) - real_set(0x1p84 + 0x1p52);
    return upper + real_of((x & bits_set(UINT32_MAX)) | bits_of(real_set(0x1p52)));
}

static void uniform_array(uint64_t key, uint64_t first, size_t count, double *to) {
    static const uint64_t numbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    Bits item;
    memcpy(&item, numbers, sizeof item);
    item += bits_set(first);
    for (size_t i = 0; i < count; i += LANES, item += bits_set(LANES))
        store(to + i, count - i, lanes_to_real(raw_lanes(bits_set(key), item)) * real_set(0x1p-64));
}

static void plane_noise_array(const PlaneNoise *noise, const uint8_t *permutation, const double *x, const double *y,
                              size_t count, double *to) {
    union {
        uint64_t bits[256];
        double numbers[256]; // the same bits as doubles, for real_gather_table
    } widened;
    for (int i = 0; i < 256; i++)
        widened.bits[i] = permutation[i];
    for (size_t i = 0; i < count; i += LANES)
        store(to + i, count - i, noise_lanes(noise, widened.numbers, load(x + i, count - i), load(y + i, count - i)));
}

const ArraysIsa NAMED(maths_arrays_, MATHS_ISA) = {exp_array,       log_array,     pow_array,
                                                   turns_sin_array, uniform_array, plane_noise_array};
