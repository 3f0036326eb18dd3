// lanes.h: SIMD types and operations for the fast paths, LANES doubles at a time.
//
// The including file defines LANES as 1, 2, 4 or 8 (default: 1). With one lane a Real is a double, so the same source
// also compiles to the scalar functions. Arithmetic is written with C operators; each is one IEEE operation per lane.
#pragma once

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#ifndef LANES
#define LANES 1
#endif

// Hook for tests. Every call of lanes_decide passes its arguments to this macro.
#ifndef LANES_WATCH
#define LANES_WATCH(high, low, error) (void)0
#endif

#define KERNEL static inline __attribute__((always_inline))

#if LANES == 1
typedef double Real;
typedef uint64_t Bits;
#else
typedef double Real __attribute__((vector_size(8 * LANES)));
typedef uint64_t Bits __attribute__((vector_size(8 * LANES)));
#endif

// The result of a comparison: one boolean per lane.
#if LANES == 1
typedef bool Mask;
#elif LANES == 8
typedef __mmask8 Mask;
#else
typedef int64_t Mask __attribute__((vector_size(8 * LANES))); // a lane has all bits set or none
#endif

// A set of lanes as a bit mask; bit 0 is the first lane.
typedef unsigned Lanes;
#define ALL_LANES ((1u << LANES) - 1)

// Intersection of two sets. A single lane uses &&, because its branch is well predicted.
#if LANES == 1
#define LANES_BOTH(a, b) ((a) && (b))
#else
#define LANES_BOTH(a, b) ((a) & (b))
#endif

// 1 if the instruction set has a fused multiply-add, else 0. Final results do not depend on it. petri.c defines it
// where one file has code for several instruction sets.
#ifndef HAS_FMA
#if defined(__FMA__) || defined(__aarch64__)
#define HAS_FMA 1
#else
#define HAS_FMA 0
#endif
#endif

KERNEL Bits bits_of(Real a) {
    Bits b;
    memcpy(&b, &a, sizeof b);
    return b;
}

KERNEL Real real_of(Bits a) {
    Real b;
    memcpy(&b, &a, sizeof b);
    return b;
}

KERNEL Real real_set(double a) {
#if LANES == 1
    return a;
#else
    return a - (Real){0};
#endif
}

KERNEL Bits bits_set(uint64_t a) {
#if LANES == 1
    return a;
#else
    return a - (Bits){0};
#endif
}

KERNEL Real real_absolute(Real a) {
#if LANES == 1
    return __builtin_fabs(a);
#else
    return real_of(bits_of(a) & bits_set(UINT64_MAX >> 1));
#endif
}

// Returns a * b + c, rounded once (fused) or twice. Use only where the error bound covers both cases.
KERNEL Real real_muladd(Real a, Real b, Real c) {
#if !HAS_FMA
    return a * b + c;
#elif LANES == 1
    return __builtin_fma(a, b, c);
#elif LANES == 2 && defined(__aarch64__)
    return (Real)vfmaq_f64((float64x2_t)c, (float64x2_t)a, (float64x2_t)b);
#elif LANES == 2
    return _mm_fmadd_pd(a, b, c);
#elif LANES == 4
    return _mm256_fmadd_pd(a, b, c);
#else
    return _mm512_fmadd_pd(a, b, c);
#endif
}

#if !HAS_FMA
// Returns the upper 26 bits of a for |a| < 2^996. The difference from a also has at most 26 bits (Veltkamp).
KERNEL Real real_split_high(Real a) {
    Real c = a * real_set(134217729.0);
    return c - (c - a);
}
#endif

// Returns the exact rounding error a * b - p of the product p, by a fused operation or by Dekker's method (1971). No
// operand or result may be subnormal.
KERNEL Real real_two_product_error(Real a, Real b, Real p) {
#if HAS_FMA
    return real_muladd(a, b, -p);
#else
    Real ah = real_split_high(a), bh = real_split_high(b), al = a - ah, bl = b - bh;
    return ((ah * bh - p) + ah * bl + al * bh) + al * bl;
#endif
}

// Returns c - a * b, the residue of a quotient or a root. Exact if the residue fits a double and a * b is near c.
KERNEL Real real_residue(Real c, Real a, Real b) {
#if HAS_FMA
    return real_muladd(-a, b, c);
#else
    Real p = a * b;
    return (c - p) - real_two_product_error(a, b, p);
#endif
}

// Returns the exact rounding error of s = a + b for |a| ≥ |b| or a = 0 (Dekker).
KERNEL Real real_fast_two_sum_error(Real a, Real b, Real s) {
    return b - (s - a);
}

// Returns the exact rounding error of s = a + b for any a and b (Knuth).
KERNEL Real real_two_sum_error(Real a, Real b, Real s) {
    Real t = s - a;
    return (a - (s - t)) + (b - t);
}

// Returns table[index] for each lane of `index`.
KERNEL Real real_gather_table(const double *table, Bits index) {
#if LANES == 1
    return table[index];
#elif LANES == 4
    return _mm256_i64gather_pd(table, (__m256i)index, 8);
#elif LANES == 8
    return _mm512_i64gather_pd((__m512i)index, table, 8);
#else
    Real r;
    for (int i = 0; i < LANES; i++)
        r[i] = table[index[i]];
    return r;
#endif
}

KERNEL Real real_load(const double *from) {
    Real r;
    memcpy(&r, from, sizeof r);
    return r;
}

KERNEL void real_store(double *to, Real a) {
    memcpy(to, &a, sizeof a);
}

#if LANES >= 4
typedef double Quad __attribute__((vector_size(32)));

// Transposes a 4 x 4 matrix.
KERNEL void quads_transpose(Quad *r) {
    Quad a = _mm256_unpacklo_pd(r[0], r[1]), b = _mm256_unpackhi_pd(r[0], r[1]);
    Quad c = _mm256_unpacklo_pd(r[2], r[3]), d = _mm256_unpackhi_pd(r[2], r[3]);
    r[0] = _mm256_permute2f128_pd(a, c, 0x20);
    r[1] = _mm256_permute2f128_pd(b, d, 0x20);
    r[2] = _mm256_permute2f128_pd(a, c, 0x31);
    r[3] = _mm256_permute2f128_pd(b, d, 0x31);
}
#endif

#if LANES == 8
// Returns a row of four numbers, followed by another one.
KERNEL Real real_of_rows(const double *low, const double *high) {
    return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low)), _mm256_loadu_pd(high), 1);
}

// Transposes eight rows into four columns. pairs[i] has the rows i and i + 4.
KERNEL void rows_transpose(const Real *pairs, Real *columns) {
    Real even_ab = _mm512_unpacklo_pd(pairs[0], pairs[1]), odd_ab = _mm512_unpackhi_pd(pairs[0], pairs[1]);
    Real even_cd = _mm512_unpacklo_pd(pairs[2], pairs[3]), odd_cd = _mm512_unpackhi_pd(pairs[2], pairs[3]);
    __m512i low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0), high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
    columns[0] = _mm512_permutex2var_pd(even_ab, low, even_cd);
    columns[1] = _mm512_permutex2var_pd(odd_ab, low, odd_cd);
    columns[2] = _mm512_permutex2var_pd(even_ab, high, even_cd);
    columns[3] = _mm512_permutex2var_pd(odd_ab, high, odd_cd);
}
#endif

// Loads a row of four numbers per lane and transposes them into four columns. One load per lane and a transposition are
// faster than four gathers.
KERNEL void real_load_rows(const double *const *rows, Real *columns) {
#if LANES == 1
    for (int m = 0; m < 4; m++)
        columns[m] = rows[0][m];
#elif LANES == 4
    for (int lane = 0; lane < LANES; lane++)
        columns[lane] = real_load(rows[lane]);
    quads_transpose(columns);
#elif LANES == 8
    Real pairs[4];
    for (int lane = 0; lane < 4; lane++)
        pairs[lane] = real_of_rows(rows[lane], rows[lane + 4]);
    rows_transpose(pairs, columns);
#else
    for (int m = 0; m < 4; m++) {
        double lanes[LANES];
        for (int lane = 0; lane < LANES; lane++)
            lanes[lane] = rows[lane][m];
        columns[m] = real_load(lanes);
    }
#endif
}

// Like real_load_rows for rows of a table: each lane of `index` is the number of a row.
KERNEL void real_gather_table_row(const double (*table)[4], Bits index, Real *columns) {
#if LANES == 1
    const double *rows[] = {table[index]};
#else
    const double *rows[LANES];
    for (int lane = 0; lane < LANES; lane++)
        rows[lane] = table[index[lane]];
#endif
    real_load_rows(rows, columns);
}

// Returns the upper 12 bits of each lane as a signed number.
KERNEL Real lanes_exponent(Bits a) {
#if LANES == 1
    return (double)((int64_t)a >> 52);
#else
    // Add 2048, so that the numbers are positive, and insert them into the mantissa of 2^52.
    Bits above = (a ^ bits_set(UINT64_C(1) << 63)) >> 52;
    return real_of(above | bits_set(UINT64_C(0x4330000000000000))) - real_set(4503599627370496.0 + 2048);
#endif
}

KERNEL Lanes mask_bits(Mask a) {
#if LANES == 4
    return (Lanes)_mm256_movemask_pd((__m256d)a);
#elif LANES == 2 && defined(__SSE2__)
    return (Lanes)_mm_movemask_pd((__m128d)a);
#elif LANES == 2
    return (Lanes)(a[0] & 1) | (Lanes)(a[1] & 2);
#else
    return a;
#endif
}

// Compares two Reals. The result is false for NaN.
#if LANES == 8
#define LANES_COMPARE(a, operator, b, predicate) _mm512_cmp_pd_mask(a, b, predicate)
#else
#define LANES_COMPARE(a, operator, b, predicate) ((Mask)(a operator b))
#endif

KERNEL Lanes lanes_equal(Real a, Real b) {
    return mask_bits(LANES_COMPARE(a, ==, b, _CMP_EQ_OQ));
}

KERNEL Lanes lanes_less(Real a, Real b) {
    return mask_bits(LANES_COMPARE(a, <, b, _CMP_LT_OQ));
}

// Ziv's rounding test (ACM TOMS 17, 1991). The exact value must be within `error` of high + low. Returns the lanes in
// which *result is certainly the exact value rounded to nearest.
KERNEL Lanes lanes_decide(Real high, Real low, Real error, Real *result) {
    LANES_WATCH(high, low, error);
    *result = high + (low + error);
    return lanes_equal(*result, high + (low - error));
}

// Returns x times `step`, rounded to the nearest integer. Sets *number to the same number in integer format. Requires
// |x step| < 2^51.
#define REAL_ROUNDER 6755399441055744.0 // 1.5 2^52
KERNEL Real real_steps(Real x, double step, Bits *number) {
    Real shifted = x * real_set(step) + real_set(REAL_ROUNDER);
    *number = bits_of(shifted) - bits_of(real_set(REAL_ROUNDER));
    return shifted - real_set(REAL_ROUNDER);
}
