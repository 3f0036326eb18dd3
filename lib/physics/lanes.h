// lanes.h: SIMD operations for formulas and kernels, in addition to those of maths/lanes.h.
//
// Real holds LANES doubles, and Mask holds one boolean per lane. Masks are combined with & and |. All operations on
// Real are single IEEE operations, so a formula gives bit-identical results for every width. 8 lanes use AVX-512 and 4
// use AVX2. 2 lanes use the vector extension of gcc and clang, which compiles to SSE2, NEON or SIMD128. One lane is
// plain C, for cases without vectors: any number of dimensions, groups of a few particles, links and reflections.
#pragma once

#include "maths/arrays.h"
#include "maths/lanes.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#if LANES == 1
#define LANES_LEVEL CPU_SCALAR
#define PER_ISA(name) name##_one
#elif LANES == 2
#define LANES_LEVEL CPU_SCALAR
#define PER_ISA(name) name##_two
#elif LANES == 4
#define LANES_LEVEL CPU_AVX2
#define PER_ISA(name) name##_avx2
#define PER_FUSED_ISA(name) name##_avx2_fused
#else
#define LANES_LEVEL CPU_AVX512
#define PER_ISA(name) name##_avx512
#define PER_FUSED_ISA(name) name##_avx512_fused
#endif

// 1 in files that are compiled with fused multiply-add (fused_roots.h), else 0.
#ifndef FUSED
#define FUSED 0
#endif

// Evaluates CALL(n), where n is the number of dimensions, from 1 to 3, as a constant.
#define FOR_DIMENSIONS(dimensions, CALL) ((dimensions) == 1 ? CALL(1) : (dimensions) == 2 ? CALL(2) : CALL(3))

// Returns a mask of the first `count` lanes.
KERNEL Mask mask_first(size_t count) {
#if LANES == 1
    return count > 0;
#elif LANES == 2
    return (Mask){count > 0 ? -1 : 0, count > 1 ? -1 : 0};
#elif LANES == 4
    long long limit = count >= LANES ? LANES : (long long)count;
    return (Mask)_mm256_cmpgt_epi64(_mm256_set1_epi64x(limit), _mm256_set_epi64x(3, 2, 1, 0));
#else
    return (Mask)(count >= LANES ? 0xff : (1u << count) - 1);
#endif
}

KERNEL Mask mask_not(Mask a) {
#if LANES == 1
    return !a;
#else
    return (Mask)~a;
#endif
}

KERNEL bool mask_any(Mask a) {
    return mask_bits(a) != 0;
}

// Gives the lanes of `mask` in which the comparison holds.
#if LANES == 8
#define COMPARE(mask, a, operator, b, predicate) _mm512_mask_cmp_pd_mask(mask, a, b, predicate)
#elif LANES == 1
#define COMPARE(mask, a, operator, b, predicate) (mask && a operator b)
#else
#define COMPARE(mask, a, operator, b, predicate) (mask & (Mask)(a operator b))
#endif

KERNEL Mask real_less_where(Mask mask, Real a, Real b) {
    return COMPARE(mask, a, <, b, _CMP_LT_OQ);
}

KERNEL Mask real_at_most_where(Mask mask, Real a, Real b) {
    return COMPARE(mask, a, <=, b, _CMP_LE_OQ);
}

// Returns the lanes of `mask` in which a and b differ. NaN differs from everything.
KERNEL Mask real_differs_where(Mask mask, Real a, Real b) {
    return COMPARE(mask, a, !=, b, _CMP_NEQ_UQ);
}
#undef COMPARE

KERNEL Mask real_less(Real a, Real b) {
    return real_less_where(mask_first(LANES), a, b);
}

KERNEL Real real_zero(void) {
    return (Real){0};
}

// mask ? a : b
KERNEL Real real_select(Mask mask, Real a, Real b) {
#if LANES == 1
    return mask ? a : b;
#elif LANES == 2
    return (Real)((mask & (Mask)a) | (~mask & (Mask)b));
#elif LANES == 4
    return _mm256_blendv_pd(b, a, (__m256d)mask);
#else
    return _mm512_mask_blend_pd(mask, b, a);
#endif
}

// mask ? a : +0.0
KERNEL Real real_or_zero(Mask mask, Real a) {
#if LANES == 1
    return mask ? a : 0;
#elif LANES == 8
    return _mm512_maskz_mov_pd(mask, a);
#else
    return (Real)(mask & (Mask)a);
#endif
}

// mask ? sum + a : sum
KERNEL Real real_add_where(Mask mask, Real sum, Real a) {
#if LANES == 1
    return mask ? sum + a : sum;
#elif LANES == 8
    return _mm512_mask_add_pd(sum, mask, sum, a);
#else
    return sum + real_select(mask, a, real_set(-0.0));
#endif
}

// mask ? sum - a : sum
KERNEL Real real_sub_where(Mask mask, Real sum, Real a) {
#if LANES == 1
    return mask ? sum - a : sum;
#elif LANES == 8
    return _mm512_mask_sub_pd(sum, mask, sum, a);
#else
    return sum - real_or_zero(mask, a);
#endif
}

// Needs intrinsics, because the vector extension has no square root.
KERNEL Real real_sqrt(Real a) {
#if LANES == 8
    return _mm512_sqrt_pd(a);
#elif LANES == 4
    return _mm256_sqrt_pd(a);
#elif LANES == 2 && defined(__SSE2__)
    return (Real)_mm_sqrt_pd((__m128d)a);
#elif LANES == 2 && defined(__aarch64__)
    return (Real)vsqrtq_f64((float64x2_t)a);
#elif LANES == 2 && defined(__wasm_simd128__)
    return (Real)wasm_f64x2_sqrt((v128_t)a);
#elif LANES == 2
    return (Real){sqrt(a[0]), sqrt(a[1])};
#else
    return sqrt(a);
#endif
}

// a > b ? a : b
KERNEL Real real_max(Real a, Real b) {
#if LANES == 8
    return _mm512_max_pd(a, b);
#elif LANES == 4
    return _mm256_max_pd(a, b);
#else
    return real_select(real_less(b, a), a, b);
#endif
}

// Computes base^power with a function call. In lanes outside the mask, uses 1 instead of the base, because pow is slow
// for some numbers, such as negative ones.
static __attribute__((noinline, unused)) Real pow_by_lane(Mask mask, Real base, double power) {
    double lanes[LANES];
    real_store(lanes, real_select(mask, base, real_set(1)));
    maths_arrays(LANES_LEVEL)->pow(lanes, &power, 0, LANES, lanes);
    return real_load(lanes);
}

// Returns true if the exponent needs no function call.
static inline bool pow_is_plain(double power) {
    return power == 1 || power == 2 || power <= 0;
}

// Returns base^power in the lanes of the mask; other lanes are undefined. A negative exponent counts as 0. `plain` may
// be true only if pow_is_plain(power). In loops `plain` should be a compile-time constant: even a call that never
// happens makes the compiler spill registers.
KERNEL Real real_pow(bool plain, Mask mask, Real base, double power) {
    if (power == 1)
        return base;
    if (power == 2)
        return base * base;
    return plain || power <= 0 ? real_set(1) : pow_by_lane(mask, base, power);
}

// Returns the integral of factor · x^power from 0 to `end`, like real_pow.
KERNEL Real real_pow_integral(double factor, Mask mask, Real end, double power) {
    double next = (power > 0 ? power : 0) + 1;
    return real_set(factor) * real_pow(false, mask, end, next) / real_set(next);
}

#if LANES > 1

KERNEL void real_store_where(Mask mask, double *to, Real a) {
#if LANES == 8
    _mm512_mask_storeu_pd(to, mask, a);
#elif LANES == 4
    _mm256_maskstore_pd(to, (__m256i)mask, a);
#else
    for (int lane = 0; lane < LANES; lane++)
        if (mask[lane])
            to[lane] = a[lane];
#endif
}

KERNEL void real_transpose(Real *r) {
#if LANES == 2
    Real first = {r[0][0], r[1][0]}, second = {r[0][1], r[1][1]};
    r[0] = first;
    r[1] = second;
#elif LANES == 4
    quads_transpose(r);
#else
    Real t[8], u[4];
    for (int i = 0; i < 8; i += 2) {
        t[i] = _mm512_unpacklo_pd(r[i], r[i + 1]);
        t[i + 1] = _mm512_unpackhi_pd(r[i], r[i + 1]);
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
#endif
}

// Loads from[index[lane]] for LANES indices.
KERNEL Real real_gather(const double *from, const uint32_t *index) {
#if LANES == 8
    return _mm512_i32gather_pd(_mm256_loadu_si256((const __m256i *)index), from, 8);
#elif LANES == 4
    return _mm256_i32gather_pd(from, _mm_loadu_si128((const __m128i *)index), 8);
#else
    return (Real){from[index[0]], from[index[1]]};
#endif
}

KERNEL void real_scatter_where(Mask mask, double *to, const uint32_t *index, Real a) {
#if LANES == 8
    _mm512_mask_i32scatter_pd(to, mask, _mm256_loadu_si256((const __m256i *)index), a, 8);
#else
    Lanes bits = mask_bits(mask);
    for (int lane = 0; lane < LANES; lane++)
        if (bits >> lane & 1)
            to[index[lane]] = a[lane];
#endif
}

#if LANES > 2
// Loads two doubles for every second lane.
KERNEL Real load_half(const double *from, const uint32_t *index) {
    Quad low = _mm256_castpd128_pd256(_mm_loadu_pd(from + index[0]));
    low = _mm256_insertf128_pd(low, _mm_loadu_pd(from + index[2]), 1);
#if LANES == 8
    Quad high = _mm256_castpd128_pd256(_mm_loadu_pd(from + index[4]));
    high = _mm256_insertf128_pd(high, _mm_loadu_pd(from + index[6]), 1);
    return _mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
#else
    return low;
#endif
}
#endif

// The next two functions load two or four doubles per lane: columns[m] receives from[index[lane] + m]. They have
// neither loops nor an array of addresses, because gcc -O2 would keep the loops, and compute the addresses in vectors.
KERNEL void real_load_pairs(const double *from, const uint32_t *index, Real *columns) {
#if LANES == 2
    columns[0] = (Real){from[index[0]], from[index[1]]};
    columns[1] = (Real){from[index[0] + 1], from[index[1] + 1]};
#else
    Real even = load_half(from, index), odd = load_half(from, index + 1);
#if LANES == 8
    columns[0] = _mm512_unpacklo_pd(even, odd);
    columns[1] = _mm512_unpackhi_pd(even, odd);
#else
    columns[0] = _mm256_unpacklo_pd(even, odd);
    columns[1] = _mm256_unpackhi_pd(even, odd);
#endif
#endif
}

KERNEL void real_load_quads(const double *from, const uint32_t *index, Real *columns) {
#if LANES == 8
    const Real pairs[] = {
        real_of_rows(from + index[0], from + index[4]), real_of_rows(from + index[1], from + index[5]),
        real_of_rows(from + index[2], from + index[6]), real_of_rows(from + index[3], from + index[7])};
    rows_transpose(pairs, columns);
#elif LANES == 4
    columns[0] = real_load(from + index[0]);
    columns[1] = real_load(from + index[1]);
    columns[2] = real_load(from + index[2]);
    columns[3] = real_load(from + index[3]);
    quads_transpose(columns);
#else
    const double *first = from + index[0], *second = from + index[1];
    columns[0] = (Real){first[0], second[0]};
    columns[1] = (Real){first[1], second[1]};
    columns[2] = (Real){first[2], second[2]};
    columns[3] = (Real){first[3], second[3]};
#endif
}

// Stores LANES pairs contiguously. parts[m] holds element m of each pair.
KERNEL void real_store_pairs(double *pairs, const Real *parts) {
#if LANES == 2
    for (int lane = 0; lane < LANES; lane++)
        for (int m = 0; m < 2; m++)
            pairs[2 * lane + m] = parts[m][lane];
#elif LANES == 4
    Quad even = _mm256_unpacklo_pd(parts[0], parts[1]), odd = _mm256_unpackhi_pd(parts[0], parts[1]);
    real_store(pairs, _mm256_permute2f128_pd(even, odd, 0x20));
    real_store(pairs + 4, _mm256_permute2f128_pd(even, odd, 0x31));
#else
    Real even = _mm512_unpacklo_pd(parts[0], parts[1]), odd = _mm512_unpackhi_pd(parts[0], parts[1]);
    __m512i low = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0), high = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
    real_store(pairs, _mm512_permutex2var_pd(even, low, odd));
    real_store(pairs + 8, _mm512_permutex2var_pd(even, high, odd));
#endif
}

// Stores lane `lane` of parts[m] in element m of row `lane`. The inverse of real_load_quads.
KERNEL void real_store_rows(double *const *rows, const Real *parts) {
#if LANES == 2
    for (int lane = 0; lane < LANES; lane++)
        for (int m = 0; m < 4; m++)
            rows[lane][m] = parts[m][lane];
#elif LANES == 4
    Real r[4] = {parts[0], parts[1], parts[2], parts[3]};
    quads_transpose(r);
    for (int lane = 0; lane < LANES; lane++)
        real_store(rows[lane], r[lane]);
#else
    Real even[2], odd[2];
    for (int m = 0; m < 2; m++) {
        even[m] = _mm512_unpacklo_pd(parts[2 * m], parts[2 * m + 1]);
        odd[m] = _mm512_unpackhi_pd(parts[2 * m], parts[2 * m + 1]);
    }
    __m512i low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0), high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
    Real r[4] = {_mm512_permutex2var_pd(even[0], low, even[1]), _mm512_permutex2var_pd(odd[0], low, odd[1]),
                 _mm512_permutex2var_pd(even[0], high, even[1]), _mm512_permutex2var_pd(odd[0], high, odd[1])};
    for (int lane = 0; lane < 4; lane++) {
        _mm256_storeu_pd(rows[lane], _mm512_castpd512_pd256(r[lane]));
        _mm256_storeu_pd(rows[lane + 4], _mm512_extractf64x4_pd(r[lane], 1));
    }
#endif
}

// Stores LANES groups of 4 doubles contiguously. parts[m] holds element m of each group.
KERNEL void real_store_quads(double *quads, const Real *parts) {
    double *rows[LANES];
    for (int lane = 0; lane < LANES; lane++)
        rows[lane] = quads + 4 * lane;
    real_store_rows(rows, parts);
}

// Writes base + lane for each lane of the mask contiguously, and returns how many there are. `to` must have space for
// LANES elements.
KERNEL size_t mask_indices(Mask mask, uint32_t base, uint32_t *to) {
    Lanes bits = mask_bits(mask);
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

// Copies the elements of `from` whose lanes are in the mask and that differ from `except`. Stores them contiguously and
// returns their number. Both arrays must have space for LANES elements.
KERNEL size_t mask_compress(Mask mask, const uint32_t *from, uint32_t except, uint32_t *to) {
#if LANES == 8
    __m256i numbers = _mm256_loadu_si256((const __m256i *)from);
    mask = _mm256_mask_cmpneq_epu32_mask(mask, numbers, _mm256_set1_epi32((int)except));
    _mm256_storeu_si256((__m256i *)to, _mm256_maskz_compress_epi32(mask, numbers));
    return (size_t)__builtin_popcount(mask);
#else
    size_t count = 0;
    for (Lanes bits = mask_bits(mask); bits; bits &= bits - 1) {
        to[count] = from[__builtin_ctz(bits)];
        count += to[count] != except;
    }
    return count;
#endif
}

#endif // LANES > 1
