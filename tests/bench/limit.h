// limit.h: minimal kernels that give the same bits as petri. Their times on one core are the limit for comparison.
#ifndef TESTS_BENCH_LIMIT_H
#define TESTS_BENCH_LIMIT_H

#include <stdint.h>

// Returns nanoseconds per unordered pair of all-pairs electrostatic forces (2 dimensions) or gravity (3) between n
// particles. Returns 0 without AVX2.
double limit_pair(uint32_t n, int dimensions);
// Returns nanoseconds per particle-step of soft discs or spheres with neighbour lists, in a square or cube of `side`
// particles per edge. Returns 0 without AVX-512.
double limit_soft(int dimensions, int side);
// Runs the kernel of limit_soft for `count` steps without walls. Updates position and velocity, with the coordinates of
// a particle adjacent. Returns how often it rebuilt the lists; 0 without AVX-512.
int limit_soft_run(int dimensions, int side, double step, int count, double *position, double *velocity);

#endif
