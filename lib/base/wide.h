// wide.h: products of 64-bit integers, also for processors and compilers without integers of 128 bits.
#pragma once

#include <stdint.h>

typedef struct Wide {
    uint64_t low, high;
} Wide;

// Returns a * b + c. It never overflows.
static inline Wide wide_multiply_add(uint64_t a, uint64_t b, uint64_t c) {
#ifdef __SIZEOF_INT128__
    __extension__ unsigned __int128 product = a;
    product = product * b + c;
    return (Wide){(uint64_t)product, (uint64_t)(product >> 64)};
#else
    uint64_t a_low = a & UINT32_MAX, a_high = a >> 32, b_low = b & UINT32_MAX, b_high = b >> 32;
    uint64_t low = a_low * b_low + (c & UINT32_MAX), middle = a_high * b_low + (low >> 32) + (c >> 32);
    uint64_t other = a_low * b_high + (middle & UINT32_MAX);
    return (Wide){other << 32 | (low & UINT32_MAX), a_high * b_high + (middle >> 32) + (other >> 32)};
#endif
}
