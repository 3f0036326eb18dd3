// allocations.h: the number of heap allocations by libpetri.
//
// The bench is linked with --wrap for malloc and similar functions, so every call by libpetri is counted. Allocations
// by the C library, including those for new threads, are not counted.
#pragma once

#include <stdint.h>

// Returns the number of allocations since the start of the process.
uint64_t allocations_so_far(void);
