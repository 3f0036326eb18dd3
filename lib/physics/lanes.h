// lanes.h: the vocabulary in which formulas and kernels are written, in the width for which a file is compiled.
//
// Real holds LANES doubles, Mask one truth per lane. All operations on Real are single IEEE operations, so a formula
// gives the same bits in every width. PETRI_LANES=1 is plain C (lanes_one.h); PETRI_LANES=2 is what every processor
// with vectors has: SSE2, NEON or SIMD128 (lanes_two.h); without it, it is AVX-512 or AVX2
// where the compiler may use them.
#ifndef PETRI_PHYSICS_LANES_H
#define PETRI_PHYSICS_LANES_H

#if defined(PETRI_LANES) && PETRI_LANES == 1
#include "physics/lanes_one.h"
#elif defined(PETRI_LANES) || !defined(__AVX2__)
#include "physics/lanes_two.h"
#else

#include <float.h>
#include <immintrin.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KERNEL static inline __attribute__((always_inline))

#if defined(__AVX512F__)

#define LANES 8
#define LANES_LEVEL CPU_AVX512
#define PER_ISA(name) name##_avx512
typedef __m512d Real;
typedef __mmask8 Mask;
#define SIMD(name) _mm512_##name##_pd

KERNEL Mask mask_first(size_t count) {
    return (Mask)(count >= LANES ? 0xff : (1u << count) - 1);
}
KERNEL Mask mask_and(Mask a, Mask b) {
    return a & b;
}
KERNEL Mask mask_or(Mask a, Mask b) {
    return a | b;
}
KERNEL Mask mask_not(Mask a) {
    return (Mask)~a;
}
KERNEL unsigned mask_bits(Mask a) {
    return a;
}
KERNEL Mask real_less(Real a, Real b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}
// mask and a < b, and so on
KERNEL Mask real_less_where(Mask mask, Real a, Real b) {
    return _mm512_mask_cmp_pd_mask(mask, a, b, _CMP_LT_OQ);
}
KERNEL Mask real_at_most_where(Mask mask, Real a, Real b) {
    return _mm512_mask_cmp_pd_mask(mask, a, b, _CMP_LE_OQ);
}
// NaN differs from everything.
KERNEL Mask real_differs_where(Mask mask, Real a, Real b) {
    return _mm512_mask_cmp_pd_mask(mask, a, b, _CMP_NEQ_UQ);
}
// mask ? a : b
KERNEL Real real_select(Mask mask, Real a, Real b) {
    return _mm512_mask_blend_pd(mask, b, a);
}
// mask ? a : +0.0
KERNEL Real real_keep(Mask mask, Real a) {
    return _mm512_maskz_mov_pd(mask, a);
}
// mask ? sum + a : sum
KERNEL Real real_add_where(Mask mask, Real sum, Real a) {
    return _mm512_mask_add_pd(sum, mask, sum, a);
}
// mask ? sum - a : sum
KERNEL Real real_sub_where(Mask mask, Real sum, Real a) {
    return _mm512_mask_sub_pd(sum, mask, sum, a);
}
KERNEL void real_store_where(Mask mask, double *to, Real a) {
    _mm512_mask_storeu_pd(to, mask, a);
}
KERNEL Real real_absolute(Real a) {
    return _mm512_abs_pd(a);
}

KERNEL void real_transpose(Real *r) {
    Real t[8], u[4];
    for (int i = 0; i < 8; i += 2) {
        t[i] = SIMD(unpacklo)(r[i], r[i + 1]);
        t[i + 1] = SIMD(unpackhi)(r[i], r[i + 1]);
    }
    for (int i = 0; i < 2; i++) {
        u[0] = _mm512_shuffle_f64x2(t[i], t[i + 2], 0x88);
        u[1] = _mm512_shuffle_f64x2(t[i], t[i + 2], 0xdd);
        u[2] = _mm512_shuffle_f64x2(t[i + 4], t[i + 6], 0x88);
        u[3] = _mm512_shuffle_f64x2(t[i + 4], t[i + 6], 0xdd);
        r[i] = _mm512_shuffle_f64x2(u[0], u[2], 0x88);
        r[i + 4] = _mm512_shuffle_f64x2(u[0], u[2], 0xdd);
        r[i + 2] = _mm512_shuffle_f64x2(u[1], u[3], 0x88);
        r[i + 6] = _mm512_shuffle_f64x2(u[1], u[3], 0xdd);
    }
}

#else

#define LANES 4
#define LANES_LEVEL CPU_AVX2
#define PER_ISA(name) name##_avx2
typedef __m256d Real;
typedef __m256d Mask;
#define SIMD(name) _mm256_##name##_pd

KERNEL Mask mask_first(size_t count) {
    __m256i numbers = _mm256_set_epi64x(3, 2, 1, 0);
    long long limit = count >= LANES ? LANES : (long long)count;
    return _mm256_castsi256_pd(_mm256_cmpgt_epi64(_mm256_set1_epi64x(limit), numbers));
}
KERNEL Mask mask_and(Mask a, Mask b) {
    return _mm256_and_pd(a, b);
}
KERNEL Mask mask_or(Mask a, Mask b) {
    return _mm256_or_pd(a, b);
}
KERNEL Mask mask_not(Mask a) {
    return _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)));
}
KERNEL unsigned mask_bits(Mask a) {
    return (unsigned)_mm256_movemask_pd(a);
}
KERNEL Mask real_less(Real a, Real b) {
    return _mm256_cmp_pd(a, b, _CMP_LT_OQ);
}
KERNEL Mask real_less_where(Mask mask, Real a, Real b) {
    return _mm256_and_pd(mask, _mm256_cmp_pd(a, b, _CMP_LT_OQ));
}
KERNEL Mask real_at_most_where(Mask mask, Real a, Real b) {
    return _mm256_and_pd(mask, _mm256_cmp_pd(a, b, _CMP_LE_OQ));
}
KERNEL Mask real_differs_where(Mask mask, Real a, Real b) {
    return _mm256_and_pd(mask, _mm256_cmp_pd(a, b, _CMP_NEQ_UQ));
}
KERNEL Real real_select(Mask mask, Real a, Real b) {
    return _mm256_blendv_pd(b, a, mask);
}
KERNEL Real real_keep(Mask mask, Real a) {
    return _mm256_and_pd(mask, a);
}
KERNEL Real real_add_where(Mask mask, Real sum, Real a) {
    return _mm256_add_pd(sum, _mm256_blendv_pd(_mm256_set1_pd(-0.0), a, mask));
}
KERNEL Real real_sub_where(Mask mask, Real sum, Real a) {
    return _mm256_sub_pd(sum, _mm256_and_pd(mask, a));
}
KERNEL void real_store_where(Mask mask, double *to, Real a) {
    _mm256_maskstore_pd(to, _mm256_castpd_si256(mask), a);
}
KERNEL Real real_absolute(Real a) {
    return _mm256_andnot_pd(_mm256_set1_pd(-0.0), a);
}

KERNEL void real_transpose(Real *r) {
    Real a = SIMD(unpacklo)(r[0], r[1]), b = SIMD(unpackhi)(r[0], r[1]);
    Real c = SIMD(unpacklo)(r[2], r[3]), d = SIMD(unpackhi)(r[2], r[3]);
    r[0] = _mm256_permute2f128_pd(a, c, 0x20);
    r[1] = _mm256_permute2f128_pd(b, d, 0x20);
    r[2] = _mm256_permute2f128_pd(a, c, 0x31);
    r[3] = _mm256_permute2f128_pd(b, d, 0x31);
}

#endif

// Index is as many column or place numbers as there are lanes.
KERNEL Real real_gather(const double *from, const uint32_t *index) {
#if LANES == 8
    return _mm512_i32gather_pd(_mm256_loadu_si256((const __m256i *)index), from, 8);
#else
    return _mm256_i32gather_pd(from, _mm_loadu_si128((const __m128i *)index), 8);
#endif
}

KERNEL void real_scatter_where(Mask mask, double *to, const uint32_t *index, Real a) {
#if LANES == 8
    _mm512_mask_i32scatter_pd(to, mask, _mm256_loadu_si256((const __m256i *)index), a, 8);
#else
    double lanes[LANES];
    _mm256_storeu_pd(lanes, a);
    for (unsigned bits = (unsigned)_mm256_movemask_pd(mask), lane = 0; lane < LANES; lane++)
        if (bits >> lane & 1)
            to[index[lane]] = lanes[lane];
#endif
}

// Element m of quad `index[lane]` to lane of parts[m]. Quads are four doubles each, side by side: one load per lane.
KERNEL void real_load_quads(const double *quads, const uint32_t *index, Real *parts) {
#define QUAD(lane) _mm256_loadu_pd(quads + 4 * (size_t)index[lane])
#if LANES == 8
#define PAIR(lane) _mm512_insertf64x4(_mm512_castpd256_pd512(QUAD(lane)), QUAD(lane + 4), 1)
    Real a = PAIR(0), b = PAIR(1), c = PAIR(2), d = PAIR(3);
    Real even_ab = SIMD(unpacklo)(a, b), even_cd = SIMD(unpacklo)(c, d);
    Real odd_ab = SIMD(unpackhi)(a, b), odd_cd = SIMD(unpackhi)(c, d);
    __m512i low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0), high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
    parts[0] = _mm512_permutex2var_pd(even_ab, low, even_cd);
    parts[1] = _mm512_permutex2var_pd(odd_ab, low, odd_cd);
    parts[2] = _mm512_permutex2var_pd(even_ab, high, even_cd);
    parts[3] = _mm512_permutex2var_pd(odd_ab, high, odd_cd);
#undef PAIR
#else
    for (int lane = 0; lane < LANES; lane++)
        parts[lane] = QUAD(lane);
    real_transpose(parts);
#endif
#undef QUAD
}

// LANES quads from their parts.
KERNEL void real_store_quads(double *quads, const Real *parts) {
    double lanes[4][LANES];
    for (int m = 0; m < 4; m++)
        SIMD(storeu)(lanes[m], parts[m]);
    for (int half = 0; half < LANES; half += 4) {
        __m256d x = _mm256_loadu_pd(lanes[0] + half), y = _mm256_loadu_pd(lanes[1] + half);
        __m256d z = _mm256_loadu_pd(lanes[2] + half), w = _mm256_loadu_pd(lanes[3] + half);
        __m256d a = _mm256_unpacklo_pd(x, y), b = _mm256_unpackhi_pd(x, y);
        __m256d c = _mm256_unpacklo_pd(z, w), d = _mm256_unpackhi_pd(z, w);
        _mm256_storeu_pd(quads + 4 * half, _mm256_permute2f128_pd(a, c, 0x20));
        _mm256_storeu_pd(quads + 4 * half + 4, _mm256_permute2f128_pd(b, d, 0x20));
        _mm256_storeu_pd(quads + 4 * half + 8, _mm256_permute2f128_pd(a, c, 0x31));
        _mm256_storeu_pd(quads + 4 * half + 12, _mm256_permute2f128_pd(b, d, 0x31));
    }
}

// Writes base + lane for the lanes of a mask side by side and returns how many. `to` has room for LANES.
KERNEL size_t mask_numbers(Mask mask, uint32_t base, uint32_t *to) {
    unsigned bits = mask_bits(mask);
#if LANES == 8
    __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32((int)base), _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0));
    _mm256_storeu_si256((__m256i *)to, _mm256_maskz_compress_epi32(mask, numbers));
    return (size_t)__builtin_popcount(bits);
#else
    size_t count = 0;
    for (; bits; bits &= bits - 1)
        to[count++] = base + (uint32_t)__builtin_ctz(bits);
    return count;
#endif
}

KERNEL bool mask_any(Mask a) {
    return mask_bits(a) != 0;
}
KERNEL Real real_load(const double *from) {
    return SIMD(loadu)(from);
}
KERNEL void real_store(double *to, Real a) {
    SIMD(storeu)(to, a);
}
KERNEL Real real_set(double a) {
    return SIMD(set1)(a);
}
KERNEL Real real_zero(void) {
    return SIMD(setzero)();
}
KERNEL Real real_add(Real a, Real b) {
    return SIMD(add)(a, b);
}
KERNEL Real real_sub(Real a, Real b) {
    return SIMD(sub)(a, b);
}
KERNEL Real real_mul(Real a, Real b) {
    return SIMD(mul)(a, b);
}
KERNEL Real real_div(Real a, Real b) {
    return SIMD(div)(a, b);
}
KERNEL Real real_sqrt(Real a) {
    return SIMD(sqrt)(a);
}
// a > b ? a : b
KERNEL Real real_larger(Real a, Real b) {
    return SIMD(max)(a, b);
}

#endif // PETRI_LANES

#endif
