// kernel_pair_1d.c: all pairs in one dimension.
#include "physics/pair_tiles.h"

#define DIMENSIONS 1

DEFINE_PAIR_KERNELS(pair_kernels_1d)
