// kernel_pair_3d.c: all pairs in three dimensions.
#include "physics/pair_tiles.h"

#define DIMENSIONS 3

DEFINE_PAIR_KERNELS(pair_kernels_3d)
