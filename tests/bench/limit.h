// limit.h: minimal kernels that give the same bits as petri. Their times on one core are lower bounds, to which petri's
// times are compared.
#pragma once

#include <stdint.h>

// Measures the forces between all pairs of n particles: electrostatic in 2 dimensions, gravity in 3, with roots by the
// divider and by fused multiply-add. Returns the nanoseconds per unordered pair in the faster way, or 0 without AVX2.
double limit_pair(uint32_t n, int dimensions);
// Measures soft discs or spheres with neighbour lists. `side` is the number of particles along each edge of their
// square or cube. Returns the nanoseconds per particle and step, or 0 without AVX-512.
double limit_soft(int dimensions, int side);
// Runs `count` steps of length `step` with the kernel of limit_soft, but without walls. Updates the arrays `position`
// and `velocity`, in which the coordinates of each particle are adjacent. Returns the number of times that the
// neighbour lists were rebuilt, or 0 without AVX-512.
int limit_soft_run(int dimensions, int side, double step, int count, double *position, double *velocity);
