// kernel_pair_2d.c: all pairs in two dimensions.
#include "physics/pair_tiles.h"

#define DIMENSIONS 2

DEFINE_PAIR_KERNELS(pair_kernels_2d)
