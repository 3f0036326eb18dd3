// limit.h: what one core of this machine can do at all, with the same bits: the yardstick of the bench.
#ifndef TESTS_BENCH_LIMIT_H
#define TESTS_BENCH_LIMIT_H

#include <stdint.h>

// Nanoseconds per unordered pair of all-pairs electrostatic forces (2 dimensions) or gravity (3) between n particles.
double limit_pair(uint32_t n, int dimensions);
// Nanoseconds per particle-step of soft discs or spheres with kept neighbour lists, a square or cube of `side`; 0
// without AVX-512.
double limit_soft(int dimensions, int side);
// The same kernel for `count` steps, without walls: how often it made lists; 0 without AVX-512. Coordinates of a
// particle are side by side.
int limit_soft_run(int dimensions, int side, double step, int count, double *position, double *velocity);

#endif
