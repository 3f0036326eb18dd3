// support.h: small helpers for the tests of lib/physics.
#pragma once

#include "groups.h"
#include "physics/system.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define VEC(...) ((const double[]){__VA_ARGS__})
#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

// Returns a force with the default attributes of the language.
static inline PhysForce force_of(PhysForceKind kind) {
    return (PhysForce){.kind = kind, .strength = 1, .power = 1, .overlap = 0.25, .density = 1, .restitution = 1};
}

// Returns a particle of mass 1 at a position.
static inline PhysParticle particle_at(PhysVector position) {
    return (PhysParticle){.position = position, .mass = 1};
}

static inline PhysTime time_until(double now, double resolution) {
    return (PhysTime){.now = now, .resolution = resolution, .lockstep = true, .performance = 1};
}

// Simulates from time 0 to `now` in steps of `resolution`.
static inline PhysResult run_until(PhysSystem *system, double now, double resolution) {
    PhysTime time = time_until(now, resolution);
    return phys_simulate(system, &time);
}

// Takes one step of length 1 at clock 0. Afterwards, the velocity of a resting particle of mass 1 equals the force on
// it.
static inline void one_step(PhysSystem *system) {
    PhysResult result = run_until(system, 1, 1);
    assert_int_equal(result.status, PHYS_OK);
    assert_int_equal(result.steps, 1);
}

// Checks that two numbers are equal or both NaN. Zeros of either sign are equal.
static inline void check_equal(double found, double wanted, const char *file, int line) {
    if (found == wanted || (isnan(found) && isnan(wanted)))
        return;
    print_error("%s:%d: found %.17g, wanted %.17g\n", file, line, found, wanted);
    fail();
}

static inline void check_near(double found, double wanted, double tolerance, const char *file, int line) {
    if (fabs(found - wanted) <= tolerance)
        return;
    print_error("%s:%d: found %.17g, wanted %.17g within %g\n", file, line, found, wanted, tolerance);
    fail();
}

#define assert_same(found, wanted) check_equal(found, wanted, __FILE__, __LINE__)
#define assert_near(found, wanted, tolerance) check_near(found, wanted, tolerance, __FILE__, __LINE__)

// A deterministic xorshift generator for test data.
typedef struct Dice {
    uint64_t state;
} Dice;

static inline uint64_t dice_next(Dice *dice) {
    uint64_t x = dice->state;
    x ^= x << 13;
    x ^= x >> 7;
    x ^= x << 17;
    dice->state = x;
    return x * UINT64_C(0x2545f4914f6cdd1d);
}

static inline uint32_t dice_below(Dice *dice, uint32_t limit) {
    return (uint32_t)((dice_next(dice) >> 32) % limit);
}

static inline double dice_between(Dice *dice, double low, double high) {
    return low + (high - low) * ((double)(dice_next(dice) >> 11) * 0x1p-53);
}
