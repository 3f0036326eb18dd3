// allocations.h: how many blocks libpetri has asked the heap for.
//
// The bench is linked with --wrap for malloc and its kin, so every call from libpetri's own code is counted; what the C
// library and the OpenMP run-time take for themselves is not.
#ifndef TESTS_BENCH_ALLOCATIONS_H
#define TESTS_BENCH_ALLOCATIONS_H

#include <stdint.h>

uint64_t allocations_so_far(void);

#endif
