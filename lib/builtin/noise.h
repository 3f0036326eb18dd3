// noise.h: a cache of the permutations that noise draws from seeds.
//
// A script asks for the same few seeds in every frame, often one point at a time; shuffling 256 numbers for each would
// cost more than the noise. A context without a cache works too.
#ifndef PETRI_BUILTIN_NOISE_H
#define PETRI_BUILTIN_NOISE_H

#include "builtin/builtin.h"

// Lives until freed; for one thread at a time.
NoiseCache *noise_cache_new(void);
void noise_cache_free(NoiseCache *cache);

// What noise gives for each of `count` points of the plane.
void builtin_noise_points(BuiltinContext *context, Value seed, const double *x, const double *y, uint32_t count,
                          double *to);

#endif
