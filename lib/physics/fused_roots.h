// fused_roots.h: square roots and their inverses by fused multiply-add, for kernels that are limited by the divider.
//
// The results are rounded correctly, so they have the same bits as real_sqrt(x) and 1 / real_sqrt(x). The proof is in
// src/manual/physics-engine.md, and tests/proofs/roots.py checks it. It does not depend on the bits of the
// approximation with which the iteration starts, only on the bound that the manuals of the processors give.
#pragma once

#include "physics/lanes.h"

#if FUSED

// ROOT_STEPS: steps of the iteration. ROOT_MIN, ROOT_MAX: squares for which nothing overflows or underflows.
#if LANES == 8 // the relative error of the approximation is at most 2^-14
enum { ROOT_STEPS = 2 };
#define ROOT_MIN 0x1p-900
#define ROOT_MAX DBL_MAX
#else // at most 0x1.84p-12; it has the range of a float
enum { ROOT_STEPS = 3 };
#define ROOT_MIN 0x1p-120
#define ROOT_MAX 0x1p120
#endif

KERNEL Real root_approximate_inverse(Real square) {
#if LANES == 8
    return _mm512_rsqrt14_pd(square);
#else
    return _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(square)));
#endif
}

// Returns the lanes of `mask` in which fused_roots rounds correctly, which excludes NaN.
//
// The squares that are excluded for their mantissas are 4^k (1 + i 2^-51) with i from -8 to -1, and 4^k (1 + i 2^-52)
// with i from 0 to 7. Their lowest 53 bits follow each other, so that one addition makes their upper 49 bits zero.
KERNEL Mask root_is_exact_where(Mask mask, Real square) {
    const uint64_t add = 8 - (UINT64_C(1) << 52), upper = (UINT64_C(1) << 53) - (UINT64_C(1) << 4);
    Bits shifted = bits_of(square) + bits_set(add);
    mask = real_at_most_where(mask, real_set(ROOT_MIN), square);
    mask = real_at_most_where(mask, square, real_set(ROOT_MAX));
#if LANES == 8
    return _mm512_mask_test_epi64_mask(mask, (__m512i)shifted, (__m512i)bits_set(upper));
#else
    return mask & (Mask)((shifted & bits_set(upper)) != bits_set(0));
#endif
}

// Computes root[c] = sqrt(square[c]) and inverse[c] = 1 / root[c] for c below `count`, which must be a constant of at
// most 2. All are computed step by step together, because each alone would wait for its own previous operation.
KERNEL void fused_roots(size_t count, const Real *square, Real *root, Real *inverse) {
#define EACH for (size_t c = 0; c < count; c++)
    Real g[2], h[2], e[2]; // g approaches the root, and h half of its inverse
    EACH inverse[c] = root_approximate_inverse(square[c]);
    EACH g[c] = square[c] * inverse[c];
    EACH h[c] = inverse[c] * real_set(0.5);
    for (int step = 0; step < ROOT_STEPS; step++) {
        EACH e[c] = real_residue(real_set(0.5), g[c], h[c]);
        EACH g[c] = real_muladd(g[c], e[c], g[c]);
        EACH h[c] = real_muladd(h[c], e[c], h[c]);
    }
    EACH e[c] = real_residue(square[c], g[c], g[c]);
    EACH root[c] = real_muladd(e[c], h[c], g[c]);
    EACH inverse[c] = h[c] + h[c];
    for (int step = 0; step < 2; step++) { // the second step rounds correctly where the first cannot
        EACH e[c] = real_residue(real_set(1), root[c], inverse[c]);
        EACH inverse[c] = real_muladd(e[c], inverse[c], inverse[c]);
    }
#undef EACH
}

#endif // FUSED
