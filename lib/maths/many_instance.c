// many_instance.c: the functions of many.h for one instruction set: LANES numbers at a time, named by INSTANCE.
//
// Lanes that the fast path cannot decide are asked for once more, by the scalar function.
#include "maths/many_instance.h"

#include "maths/maths.h"
#include "maths/random.h"

#include "maths/fast_exp.h"
#include "maths/fast_log.h"
#include "maths/fast_turn.h"

#define JOIN(name, instance) name##instance
#define NAMED(name, instance) JOIN(name, instance)

// Up to LANES numbers; what is missing is 1, which each function takes.
KERNEL Real load(const double *from, size_t count) {
    Real r;
    if (count >= LANES) {
        memcpy(&r, from, sizeof r);
        return r;
    }
    r = real_set(1);
    memcpy(&r, from, count * sizeof *from);
    return r;
}

KERNEL void store(double *to, size_t count, Real r) {
    memcpy(to, &r, count >= LANES ? sizeof r : count * sizeof *to);
}

// The lanes that are left over, of those that count.
KERNEL Lanes lanes_left(Lanes good, size_t count) {
    return ~good & (count >= LANES ? ALL_LANES : (1u << count) - 1);
}

// For each lane of a set, lowest first.
#define FOR_EACH_LANE(lane, left)                                                                                      \
    for (unsigned lane = 0; left >> lane; lane++)                                                                      \
        if (left >> lane & 1)

static void exp_many(const double *x, size_t count, double *to) {
    for (size_t i = 0; i < count; i += LANES) {
        Real in = load(x + i, count - i), out;
        Lanes left = lanes_left(exp_lanes(in, &out), count - i);
        store(to + i, count - i, out);
        if (left) {
            double again[LANES];
            memcpy(again, &in, sizeof in);
            FOR_EACH_LANE(lane, left) to[i + lane] = maths_exp(again[lane]);
        }
    }
}

static void log_many(const double *x, size_t count, double *to) {
    for (size_t i = 0; i < count; i += LANES) {
        Real in = load(x + i, count - i), out;
        Lanes left = lanes_left(log_lanes(in, &out), count - i);
        store(to + i, count - i, out);
        if (left) {
            double again[LANES];
            memcpy(again, &in, sizeof in);
            FOR_EACH_LANE(lane, left) to[i + lane] = maths_log(again[lane]);
        }
    }
}

static void sin_cos_many(const double *x, size_t count, double *sines, double *cosines) {
    for (size_t i = 0; i < count; i += LANES) {
        Real in = load(x + i, count - i), sine, cosine;
        Lanes left = lanes_left(sin_cos_lanes(in, &sine, &cosine), count - i);
        store(sines + i, count - i, sine);
        store(cosines + i, count - i, cosine);
        if (left) {
            double again[LANES];
            memcpy(again, &in, sizeof in);
            FOR_EACH_LANE(lane, left) {
                sines[i + lane] = maths_sin(again[lane]);
                cosines[i + lane] = maths_cos(again[lane]);
            }
        }
    }
}

static void pow_many(const double *x, const double *y, size_t step, size_t count, double *to) {
    for (size_t i = 0; i < count; i += LANES) {
        Real base = load(x + i, count - i), power = step ? load(y + i, count - i) : real_set(*y), out;
        Lanes left = lanes_left(pow_lanes(base, power, &out), count - i);
        store(to + i, count - i, out);
        if (left) {
            double bases[LANES], powers[LANES];
            memcpy(bases, &base, sizeof base);
            memcpy(powers, &power, sizeof power);
            FOR_EACH_LANE(lane, left) to[i + lane] = maths_pow(bases[lane], powers[lane]);
        }
    }
}

// The quarters go to the row of the table, so that no lane needs another function than the others.
static void turns_sin_many(const double *t, size_t count, double *to) {
    for (size_t i = 0; i < count; i += LANES) {
        Real in = load(t + i, count - i), quarters = in * real_set(4), out;
        Bits quadrant;
        Real angle = (quarters - real_steps(quarters, 1, &quadrant)) * real_set(1.5707963267948966);
        Lanes good = sin_lanes(angle, quadrant, &out) & lanes_less(real_absolute(quarters), real_set(0x1p50));
        Lanes left = lanes_left(good, count - i);
        store(to + i, count - i, out);
        if (left) {
            double again[LANES];
            memcpy(again, &in, sizeof in);
            FOR_EACH_LANE(lane, left) to[i + lane] = turns_sin(again[lane]);
        }
    }
}

KERNEL Bits swap_halves(Bits x) {
    return x << 32 | x >> 32;
}

// random_raw (random.c) for LANES items
KERNEL Bits raw_lanes(Bits key, Bits item) {
    Bits y = item * key, z = y + key, x = y;
    x = swap_halves(x * x + y);
    x = swap_halves(x * x + z);
    x = swap_halves(x * x + y);
    Bits t = x * x + z;
    x = swap_halves(t);
    return t ^ ((x * x + y) >> 32);
}

// A whole number to the nearest double: the upper half behind the exponent of 2^84, the lower one behind that of 2^52.
// The only rounding is that of their sum.
KERNEL Real lanes_to_real(Bits x) {
    Real upper = real_of(x >> 32 | bits_of(real_set(0x1p84))) - real_set(0x1p84 + 0x1p52);
    return upper + real_of((x & bits_set(UINT32_MAX)) | bits_of(real_set(0x1p52)));
}

static void uniform_many(uint64_t key, uint64_t first, size_t count, double *to) {
    static const uint64_t numbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    Bits item;
    memcpy(&item, numbers, sizeof item);
    item += bits_set(first);
    for (size_t i = 0; i < count; i += LANES, item += bits_set(LANES))
        store(to + i, count - i, lanes_to_real(raw_lanes(bits_set(key), item)) * real_set(0x1p-64));
}

const ManyInstance NAMED(maths_many_, INSTANCE) = {exp_many, log_many,       sin_cos_many,
                                                   pow_many, turns_sin_many, uniform_many};
