// arrays_isa.h: the table of functions that arrays_isa.c provides for each instruction set.
#pragma once

#include "maths/arrays.h"

#include <stddef.h>
#include <stdint.h>

typedef struct ArraysIsa {
    void (*exp)(const double *x, size_t count, double *to);
    void (*log)(const double *x, size_t count, double *to);
    void (*sin_cos)(const double *x, size_t count, double *sines, double *cosines);
    void (*pow)(const double *x, const double *y, size_t step, size_t count,
                double *to); // computes x[i]^y[step * i]; `step` is 0 or 1
    void (*turns_sin)(const double *t, size_t count, double *to);
    void (*uniform)(uint64_t key, uint64_t first, size_t count, double *to); // random_uniform(key, first + i)
    void (*plane_noise)(const PlaneNoise *noise, const uint8_t *permutation, const double *x, const double *y,
                        size_t count, double *to);
} ArraysIsa;

extern const ArraysIsa maths_arrays_plain, maths_arrays_pair, maths_arrays_avx2, maths_arrays_avx512;
