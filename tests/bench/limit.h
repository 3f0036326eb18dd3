// limit.h: minimal kernels that give the same bits as petri. Their times on one core are lower bounds, to which petri's
// times are compared.
#ifndef TESTS_BENCH_LIMIT_H
#define TESTS_BENCH_LIMIT_H

#include <stdint.h>

// Returns the nanoseconds per unordered pair of forces between all pairs of n particles: electrostatic in 2 dimensions,
// gravity in 3. Returns 0 without AVX2.
double limit_pair(uint32_t n, int dimensions);
// Returns the nanoseconds per particle and step of soft discs or spheres with neighbour lists. There are `side`
// particles along each edge of a square or cube. Returns 0 without AVX-512.
double limit_soft(int dimensions, int side);
// Runs `count` steps of the kernel of limit_soft without walls. Updates position and velocity, in which the coordinates
// of each particle are adjacent. Returns the number of list rebuilds, or 0 without AVX-512.
int limit_soft_run(int dimensions, int side, double step, int count, double *position, double *velocity);

#endif
