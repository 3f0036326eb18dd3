// arrays.h: elementary functions of many numbers at once. The bits are those of maths.h, number by number.
//
// `to` may be the array that is read. `level` says which vector instructions to use; the result does not depend on it.
#ifndef PETRI_MATHS_ARRAYS_H
#define PETRI_MATHS_ARRAYS_H

#include "base/cpu.h"

#include <stddef.h>
#include <stdint.h>

void maths_exp_array(CpuLevel level, const double *x, size_t count, double *to);
void maths_log_array(CpuLevel level, const double *x, size_t count, double *to);
void maths_sin_cos_array(CpuLevel level, const double *x, size_t count, double *sines, double *cosines);
// x[i]^y[i], and x[i]^power
void maths_pow_array(CpuLevel level, const double *x, const double *y, size_t count, double *to);
void maths_power_array(CpuLevel level, const double *x, double power, size_t count, double *to);
// The sine of t full turns, as turns_sin (random.h) defines it.
void maths_turns_sin_array(CpuLevel level, const double *t, size_t count, double *to);
// Items first, first + 1, … of a stream: random_uniform.
void maths_uniform_array(CpuLevel level, uint64_t key, uint64_t first, size_t count, double *to);

// Noise of the plane (spec builtins.md B10.7) at the points x[i], y[i], which are nearer to 0 than 2^45: a permutation
// of 0 to 255, and what all have in common.
typedef struct PlaneNoise {
    double skew, squish, scale;
    double gradient_x[8], gradient_y[8];
} PlaneNoise;
void maths_plane_noise_array(CpuLevel level, const PlaneNoise *noise, const uint8_t *permutation, const double *x,
                             const double *y, size_t count, double *to);

#endif
