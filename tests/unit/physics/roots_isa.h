// roots_isa.h: fused_roots for tests, compiled once per instruction set (roots_isa.c).
#pragma once

#include <stddef.h>
#include <stdint.h>

// Compares the roots of `count` squares, a multiple of 8, and their inverses with sqrt and a division, except where
// root_is_exact_where excludes a square. Adds the number of excluded squares to *excluded. Returns the index of the
// first square with a wrong result, or `count`.
typedef size_t RootCheck(const double *squares, size_t count, uint64_t *excluded);
RootCheck check_roots_avx2, check_roots_avx512;
