// many_instance.h: what many_instance.c offers for each instruction set.
#ifndef PETRI_MATHS_MANY_INSTANCE_H
#define PETRI_MATHS_MANY_INSTANCE_H

#include "maths/many.h"

#include <stddef.h>
#include <stdint.h>

typedef struct ManyInstance {
    void (*exp)(const double *x, size_t count, double *to);
    void (*log)(const double *x, size_t count, double *to);
    void (*sin_cos)(const double *x, size_t count, double *sines, double *cosines);
    void (*pow)(const double *x, const double *y, size_t step, size_t count, double *to); // y[step i]
    void (*turns_sin)(const double *t, size_t count, double *to);
    void (*uniform)(uint64_t key, uint64_t first, size_t count, double *to); // items of a stream: random_uniform
    void (*plane_noise)(const PlaneNoise *noise, const uint8_t *permutation, const double *x, const double *y,
                        size_t count, double *to);
} ManyInstance;

extern const ManyInstance maths_many_plain, maths_many_pair, maths_many_avx2, maths_many_avx512;

#endif
