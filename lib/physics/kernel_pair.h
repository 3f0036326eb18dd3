// kernel_pair.h: tables of the kernels that compute all pairs, for each number of dimensions. The kernels of a number
// are in a separate file, such as kernel_pair_2d.c, so that they compile at the same time.
#pragma once

#include "physics/pair_geometry.h"

typedef PairKernel *PairKernelTable[LEAD_NONE + 1][REST_ANY + 1]; // by lead and rest; NULL: no kernel

extern const PairKernelTable PER_ISA(pair_kernels_1d);
extern const PairKernelTable PER_ISA(pair_kernels_2d);
extern const PairKernelTable PER_ISA(pair_kernels_3d);
#if LANES > 2
extern const PairKernelTable PER_FUSED_ISA(pair_kernels_2d);
extern const PairKernelTable PER_FUSED_ISA(pair_kernels_3d);
#endif
