// arrays.h: elementary functions of arrays. Each element gets exactly the result of the scalar function in maths.h.
//
// `to` may be the same array as an input. The instruction set does not influence the results.
#pragma once

#include "base/cpu.h"

#include <stddef.h>
#include <stdint.h>

// Constants of two-dimensional noise (spec builtins.md B10.7).
typedef struct PlaneNoise {
    double skew, squish, scale;
    double gradient_x[8], gradient_y[8];
} PlaneNoise;

// The functions that arrays_isa.c provides for each instruction set.
typedef struct ArraysIsa {
    void (*exp)(const double *x, size_t count, double *to);
    void (*log)(const double *x, size_t count, double *to);
    // Computes x[i]^y[step * i]; `step` is 0 or 1.
    void (*pow)(const double *x, const double *y, size_t step, size_t count, double *to);
    // Computes the sine of t[i] full turns, like turns_sin (random.h).
    void (*turns_sin)(const double *t, size_t count, double *to);
    // Computes random_uniform(key, i) for i = first to first + count - 1.
    void (*uniform)(uint64_t key, uint64_t first, size_t count, double *to);
    // Computes the noise at the points (x[i], y[i]), with |x[i]| and |y[i]| below 2^45. `permutation` holds 0 to 255 in
    // random order.
    void (*plane_noise)(const PlaneNoise *noise, const uint8_t *permutation, const double *x, const double *y,
                        size_t count, double *to);
} ArraysIsa;

extern const ArraysIsa maths_arrays_plain, maths_arrays_pair, maths_arrays_avx2, maths_arrays_avx512;

// Returns the functions for a level. CPU_SCALAR selects two lanes, which every supported processor has. The one-lane
// variant only serves as a reference in tests.
static inline const ArraysIsa *maths_arrays(CpuLevel level) {
#if defined(__x86_64__)
    if (level == CPU_AVX512)
        return &maths_arrays_avx512;
    if (level == CPU_AVX2 && cpu_detected.fma)
        return &maths_arrays_avx2;
#endif
    (void)level;
    return &maths_arrays_pair;
}
