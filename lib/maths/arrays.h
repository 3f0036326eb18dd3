// arrays.h: elementary functions of arrays. Each element gets exactly the result of the scalar function in maths.h.
//
// `to` may be the same array as the input. `level` selects the vector instructions; the result does not depend on it.
#pragma once

#include "base/cpu.h"

#include <stddef.h>
#include <stdint.h>

void maths_exp_array(CpuLevel level, const double *x, size_t count, double *to);
void maths_log_array(CpuLevel level, const double *x, size_t count, double *to);
void maths_sin_cos_array(CpuLevel level, const double *x, size_t count, double *sines, double *cosines);
// maths_pow_array computes x[i]^y[i], and maths_power_array computes x[i]^power.
void maths_pow_array(CpuLevel level, const double *x, const double *y, size_t count, double *to);
void maths_power_array(CpuLevel level, const double *x, double power, size_t count, double *to);
// Computes the sine of t[i] full turns, like turns_sin (random.h).
void maths_turns_sin_array(CpuLevel level, const double *t, size_t count, double *to);
// Computes random_uniform(key, i) for i = first to first + count - 1.
void maths_uniform_array(CpuLevel level, uint64_t key, uint64_t first, size_t count, double *to);

// Constants of two-dimensional noise (spec builtins.md B10.7).
typedef struct PlaneNoise {
    double skew, squish, scale;
    double gradient_x[8], gradient_y[8];
} PlaneNoise;
// Computes the noise at the points (x[i], y[i]), with |x[i]| and |y[i]| below 2^45. `permutation` holds 0 to 255 in
// random order.
void maths_plane_noise_array(CpuLevel level, const PlaneNoise *noise, const uint8_t *permutation, const double *x,
                             const double *y, size_t count, double *to);
