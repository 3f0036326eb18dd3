// limit.h: what one core of this machine can do at all, with the same bits: the yardstick of the bench.
#ifndef TESTS_BENCH_LIMIT_H
#define TESTS_BENCH_LIMIT_H

#include <stdint.h>

// Nanoseconds per unordered pair of all-pairs electrostatic forces (2 dimensions) or gravity (3) between n particles.
double limit_pair(uint32_t n, int dimensions);
// Nanoseconds per particle-step of soft discs with kept neighbour lists, side * side of them; 0 without AVX-512.
double limit_discs(int side);

#endif
