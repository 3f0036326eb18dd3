// noise.h: a cache, indexed by seed, of the permutations from which noise is computed.
//
// A script uses the same few seeds in every frame, often for one point at a time. Shuffling 256 numbers in each call
// would take longer than computing the noise. The cache is optional.
#pragma once

#include "builtin/builtin.h"

// The caller frees it with noise_cache_free. Not thread-safe.
NoiseCache *noise_cache_new(void);
void noise_cache_free(NoiseCache *cache);

// Sets to[i] to the noise at the point (x[i], y[i]) of the plane, for each i below `count`.
void builtin_noise_points(BuiltinContext *context, Value seed, const double *x, const double *y, uint32_t count,
                          double *to);
